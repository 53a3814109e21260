#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The progress of a sweep, whatever happens to the commands and to its file."""
import os
import re
import shutil
import threading
import unittest

import rospy
import rostest

import support
from external_command.msg import ActionCommand, CommandStatus, FreeSpaceCommand, Pose
from external_command.srv import FreeSpace
from zone_yard import Sweeper, box, percent_of, polygon, swath_of, wait_until_kept

FOLDER = rospy.get_param("/courtyard/zone_cover_command_processor/progress_folder")
YARD = box(13, 11)


def zone_files(ending=".zone"):
    return sorted(os.path.join(FOLDER, name) for name in os.listdir(FOLDER) if name.endswith(ending))


def content_of(path):
    with open(path, encoding="ascii") as file:
        return file.read()


class ZoneCoverFilesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clear_folder()
        cls.courtyard = Sweeper("courtyard")
        cls.courtyard.wait_until_ready(YARD)

    @classmethod
    def tearDownClass(cls):
        cls.clear_folder()

    @staticmethod
    def clear_folder():
        def is_gone():  # what is still being written may come back once
            shutil.rmtree(FOLDER, ignore_errors=True)
            if os.path.isfile(FOLDER):
                os.remove(FOLDER)
            return not os.path.exists(FOLDER)
        support.wait_until(is_gone, "the folder is gone")

    def setUp(self):
        """Every test begins in the middle, and with no file."""
        self.clear_folder()
        self.courtyard.wait_until_standing()
        self.drive_to(0.0)

    def send_to(self, x, command_id=0):
        goal = Pose(x=x, heading=0.0, has_heading=True)
        command = FreeSpaceCommand(command_id=command_id, parking_spot_pose=goal, drivable_roi=polygon(box(40, 40)))
        statuses = []

        def is_answered():
            """Sent again, as the answer asks for, where the vehicle drove on for too long while the path was planned."""
            statuses.append(support.service(self.courtyard.ns + "free_space", FreeSpace)(command).status)
            return statuses[-1].error_code != CommandStatus.PLANNING_TIMEOUT
        support.wait_until(is_answered, "a path that begins where the vehicle is")
        self.assertEqual(statuses[-1].status, CommandStatus.RUNNING, support.describe(statuses[-1]))
        return statuses[-1].command_id

    def drive_to(self, x, command_id=0):
        self.courtyard.finish(self.send_to(x, command_id))

    def assert_refused(self, answer, *words):
        self.assertEqual(answer.status.error_code, CommandStatus.INVALID_REQUEST, support.describe(answer.status))
        for word in words:
            self.assertIn(word, answer.status.message)

    def first_progress(self, statuses, answer):
        self.assertEqual(answer.status.status, CommandStatus.RUNNING, support.describe(answer.status))
        return statuses.wait_for(lambda m: m.command_id == answer.status.command_id and swath_of(m.message),
                                 "progress of the resumed sweep").message

    def test_goes_on_in_a_lap_that_was_broken_off(self):
        last = self.courtyard.sweep_until(YARD, lambda m: percent_of(m) >= 14, ActionCommand.CLEAR_PLANNING)[-1]
        self.assertRegex(last, r"^swath \d+ of \d+, \d+ % covered \(lap \d+ of \d+\)$")
        statuses = self.courtyard.collect()
        first = self.first_progress(statuses, self.courtyard.cover(YARD, resume=True))
        statuses.close()
        self.assertGreaterEqual(percent_of(first), percent_of(last) - 1)
        self.assertEqual(swath_of(first), swath_of(last))
        self.courtyard.stop()  # thirty times as fast as real it is elsewhere by the time that the next plan arrives

    def test_knows_the_sweep_from_a_later_command_with_its_id(self):
        last = self.courtyard.sweep_until(YARD, lambda m: percent_of(m) >= 10, None, command_id=71)[-1]
        self.send_to(5.0, command_id=72)
        self.courtyard.stop()
        self.courtyard.wait_until_standing()
        self.drive_to(-5.0, command_id=71)
        again = self.courtyard.cover(YARD, resume=True, dry_run=True)
        self.assertEqual(again.status.status, CommandStatus.FINISHED, support.describe(again.status))
        whole = self.courtyard.cover(YARD, dry_run=True)
        self.assertGreater(again.report.path_length, 0.5 * whole.report.path_length, last)

    def test_a_sweep_that_is_not_sent_leaves_the_file_of_the_one_before(self):
        self.courtyard.sweep_until(YARD, lambda m: percent_of(m) >= 10, ActionCommand.CLEAR_PLANNING)
        wait_until_kept(FOLDER)
        kept, = zone_files()
        before = content_of(kept)
        answers = []
        call = threading.Thread(target=lambda: answers.append(self.courtyard.cover(YARD)))
        planning = self.courtyard.collect()
        call.start()
        planning.wait_for(lambda m: m.status == CommandStatus.RUNNING, "the sweep is being planned")
        self.courtyard.stop()
        call.join()
        planning.close()
        self.assertEqual(answers[0].status.error_code, CommandStatus.CANCELLED, support.describe(answers[0].status))
        self.assertEqual(content_of(kept), before)
        support.wait_until(lambda: os.listdir(FOLDER) == [os.path.basename(kept)], "temporary files are removed")

    def test_two_vehicles_share_no_file(self):
        self.courtyard.sweep_until(YARD, lambda m: percent_of(m) >= 5)
        garden = Sweeper("garden")
        garden.wait_until_ready(YARD)
        self.assert_refused(garden.cover(YARD, resume=True), "no earlier run")
        garden.sweep_until(YARD, lambda m: percent_of(m) >= 1)
        wait_until_kept(FOLDER)
        names = [os.path.basename(path) for path in zone_files()]
        self.assertEqual([re.sub("[0-9a-f]{16}", "*", name) for name in names],
                         ["courtyard-polygon-*.zone", "garden-polygon-*.zone"])

    def test_says_that_a_file_is_damaged_and_keeps_it_aside(self):
        self.courtyard.sweep_until(YARD, lambda m: percent_of(m) >= 5, ActionCommand.CLEAR_PLANNING)
        wait_until_kept(FOLDER)
        kept, = zone_files()
        content = content_of(kept)
        with open(kept, "w", encoding="ascii") as file:
            file.write(re.sub(r"line 0 -?\d", "line 0 7", content, count=1))
        self.assert_refused(self.courtyard.cover(YARD, resume=True, dry_run=True), "damaged", kept)
        self.assertEqual(zone_files(), [kept])
        self.assert_refused(self.courtyard.cover(YARD, resume=True), "damaged", kept + ".damaged", "without resume")
        self.assertEqual(zone_files(".damaged"), [kept + ".damaged"])
        self.assert_refused(self.courtyard.cover(YARD, resume=True), "no earlier run", kept + ".damaged")
        self.courtyard.sweep_until(YARD, lambda m: percent_of(m) >= 1)

    def test_sweeps_without_a_folder_and_says_that_nothing_is_kept(self):
        self.clear_folder()
        with open(FOLDER, "w", encoding="ascii") as file:
            file.write("stands where the folder should be")
        statuses = self.courtyard.collect()
        answer = self.courtyard.cover(YARD)
        self.assertIn("not kept", " ".join(answer.report.warnings))
        self.assertIn("Not a directory", " ".join(answer.report.warnings))
        command_id = answer.status.command_id
        statuses.wait_for(lambda m: m.command_id == command_id and "not kept" in m.message and swath_of(m.message),
                          "the status tells it too")
        os.remove(FOLDER)
        support.wait_until(lambda: os.path.isdir(FOLDER) and zone_files(), "it is kept once that is possible")
        count = len(statuses.messages)
        support.wait_until(lambda: any(percent_of(m.message) >= 0 and "not kept" not in m.message
                                       for m in statuses.messages[count:]), "the status tells no more of it")
        statuses.close()
        self.courtyard.stop()


if __name__ == "__main__":
    rospy.init_node("zone_cover_files_test")
    rostest.rosrun("external_command", "zone_cover_files", ZoneCoverFilesTest)
