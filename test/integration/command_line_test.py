#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The command line as a person types it: what is printed, and the exit codes."""
import json
import os
import pty
import re
import select
import signal
import subprocess
import time

import rospy
import rostest

import support
from external_command.client import CommandClient
from vehicle import Vehicle

CLIENT = ["rosrun", "external_command", "external_command_client"]
TIMEOUT = 120.0  # [s]; a command that takes longer hangs


def run(line):
    """(exit code, stdout, stderr) of `external_command_client LINE`."""
    result = subprocess.run(CLIENT + line.split(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                            timeout=TIMEOUT)
    return result.returncode, result.stdout.decode(), result.stderr.decode()


def run_json(line):
    """(exit code, the objects that are printed)."""
    code, out, _ = run(line + " --json")
    return code, [json.loads(text) for text in out.splitlines()]


class CommandLineTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.client = CommandClient("apollo", support.DEADLINE)
        support.wait_until_ready(cls.client)
        cls.vehicle = Vehicle("/apollo/")

    def setUp(self):
        """As far from every goal as the tests need, however long those before this one took."""
        self.vehicle.wait_until_standing()
        self.vehicle.place(90.0, 194.75)

    def tearDown(self):
        self.client.clear()

    def test_watch_shows_how_far_a_command_has_come_and_its_end(self):
        code, (answer,) = run_json("lane-follow --to 480 338.25")  # so far that `watch` has begun before
        self.assertEqual((code, answer["status"]["status_name"]), (0, "RUNNING"))
        command_id = answer["status"]["command_id"]
        code, shown = run_json("watch")
        self.assertEqual(code, 0, shown)
        self.assertEqual({one["status"]["command_id"] for one in shown}, {command_id})
        self.assertEqual(shown[-1]["status"]["status_name"], "FINISHED")
        shares = [one["status"]["share_done"] for one in shown[:-1] if one["status"]["has_progress"]]
        self.assertGreater(len(shares), 1, shown)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(run("watch %d" % command_id)[0], 0)

    def test_watch_draws_a_bar_on_a_terminal(self):
        run("lane-follow --to 480 338.25")
        parent, child = pty.openpty()
        watching = subprocess.Popen(CLIENT + ["watch"], stdout=child, stderr=child)
        os.close(child)
        shown, end = "", time.monotonic() + TIMEOUT
        while "\r[" not in shown:
            self.assertLess(time.monotonic(), end, shown)
            if select.select([parent], [], [], 1.0)[0]:
                shown += os.read(parent, 4096).decode()
        self.assertRegex(shown, r"\r\[[#.]{5,}\] \d+ %, [\d.]+ m and \d+ s left, command \d+")
        watching.send_signal(signal.SIGINT)  # rosrun has become the client
        self.assertEqual(watching.wait(TIMEOUT), 4)
        os.close(parent)
        self.assertEqual(run("status %s" % re.search(r"command (\d+)", shown).group(1))[0], 0, "it goes on")

    def test_watch_tells_that_others_ended_the_command(self):
        first = run_json("lane-follow --to 480 338.25")[1][0]["status"]["command_id"]
        run("lane-follow --to 300 195")
        code, shown = run_json("watch %d" % first)
        self.assertEqual((code, shown[-1]["status"]["error_name"]), (5, "SUPERSEDED"))

    def test_cancel_ends_one_command_and_says_whether_it_ran(self):
        command_id = run_json("lane-follow --to 480 338.25")[1][0]["status"]["command_id"]
        code, (answer,) = run_json("cancel %d" % command_id)
        self.assertEqual((code, answer["was_running"], answer["status"]["error_name"]), (0, True, "CANCELLED"))
        code, out, _ = run("cancel %d" % command_id)
        self.assertEqual(code, 0)
        self.assertIn("it was not running", out)
        self.assertEqual(run("cancel 4711")[0], 6)

    def test_current_names_what_is_driven(self):
        run("lane-follow --to 480 338.25 --id 31")
        code, (answer,) = run_json("current")
        self.assertEqual((code, answer["motion"]["command_id"], answer["motion"]["service"]), (0, 31, "lane_follow"))
        self.assertIn(31, [status["command_id"] for status in answer["running"]])
        self.assertIn("driven: command 31 RUNNING", run("current")[1])

    def test_a_refusal_is_told_in_words_and_ends_with_1(self):
        code, out, _ = run("lane-follow --to 9000 0")
        self.assertEqual(code, 1)
        self.assertIn("(OFF_MAP)", out)
        self.assertEqual(run("lane-follow --to 300 195 --speed -3")[0], 1)

    def test_who_waits_in_vain_is_told_so(self):
        code, _, told = run("lane-follow --to 480 338.25 --wait 0.5")
        self.assertEqual(code, 4)
        self.assertIn("is still running after 0.5 s", told)
        self.assertEqual(run("status 4711")[0], 6)

    def test_spaces_are_listed_by_their_distance(self):
        code, (answer,) = run_json("list spaces --near 120,160 --radius 30 --max 5")
        self.assertEqual((code, len(answer["objects"])), (0, 5))
        self.assertGreater(answer["total_count"], 5)
        distances = [found["distance"] for found in answer["objects"]]
        self.assertEqual(distances, sorted(distances))
        self.assertEqual({found["kind_name"] for found in answer["objects"]}, {"space"})
        out = run("list spaces --near 120,160 --radius 30 --max 5")[1].splitlines()
        self.assertEqual(len(out), 6)
        self.assertRegex(out[4], r"^space \w+   at [\d.]+ [\d.]+ -?[\d.]+   [\d.]+ m away   5.5 x 2.8 m")
        self.assertIn("5 of %d" % answer["total_count"], out[-1])

    def test_an_id_that_is_not_there_is_told(self):
        code, out, told = run("list areas --id nowhere")
        self.assertEqual((code, out, told), (1, "", "UNKNOWN_ID: the map has no area 'nowhere'\n"))
        code, out, _ = run("list areas --near -9000,0 --radius 1")
        self.assertEqual((code, out), (0, "there is none\n"))

    def test_the_map_is_told_as_a_whole(self):
        code, (info,) = run_json("map info")
        self.assertEqual((code, info["lanes"], info["spaces"], info["areas"]), (0, 208, 132, 2))
        self.assertTrue(info["file"].endswith("base_map.bin"))

    def test_nothing_is_missing_while_all_runs(self):
        code, (answer,) = run_json("why-not valet-parking")
        self.assertEqual((code, answer["unmet"]), (0, []))

    def test_nobody_there_ends_with_3(self):
        for line in ("--ns nobody --timeout 0.5 current", "why-not --ns nobody --timeout 0.5"):
            code, _, told = run(line)
            self.assertEqual(code, 3)
            self.assertIn("is the gateway running in namespace nobody?", told)
            code, (answer,) = run_json(line)
            self.assertEqual((code, list(answer)), (3, ["error"]))

    def test_tells_where_its_output_cannot_be_written_and_not_where_nobody_reads_on(self):
        for words in ("lane-follow --to 300 195 --dry-run", "list lanes", "status 4711 --json", "map info"):
            with self.subTest(words):
                with open("/dev/full", "wb") as full:
                    told = subprocess.run(CLIENT + words.split(), stdout=full, stderr=subprocess.PIPE, check=False,
                                          timeout=TIMEOUT)
                self.assertEqual((told.returncode, told.stderr.decode().splitlines()[-1:]),
                                 (7, ["the output could not be written: [Errno 28] No space left on device"]))
                self.assertNotIn(b"Traceback", told.stderr)
                reader, writer = os.pipe()
                os.close(reader)
                told = subprocess.run(CLIENT + words.split(), stdout=writer, stderr=subprocess.PIPE, check=False,
                                      timeout=TIMEOUT)
                os.close(writer)
                self.assertEqual((told.returncode, told.stderr), (7, b""))

    def test_an_address_of_the_master_that_is_none_is_told(self):
        for address in ("nonsense", "", "http://localhost:1"):
            with self.subTest(address):
                told = subprocess.run(CLIENT + ["status", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                                      timeout=TIMEOUT, env=dict(os.environ, ROS_MASTER_URI=address))
                self.assertEqual((told.returncode, told.stderr.decode()),
                                 (3, "no ROS master at '%s' (ROS_MASTER_URI)\n" % address))


if __name__ == "__main__":
    rospy.init_node("command_line_test")
    rostest.rosrun("external_command", "command_line", CommandLineTest)
