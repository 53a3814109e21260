#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Python client: the examples of doc/python_client.md, what it raises, what it waits for."""
import contextlib
import io
import os
import sys
import threading

import rospkg
import rospy
import rostest

import support
from external_command import client as client_module
from external_command.client import CommandClient
from external_command.msg import CommandStatus, LaneFollowCommand
from vehicle import Vehicle

PACKAGE = rospkg.RosPack().get_path("external_command")
sys.path.insert(0, os.path.join(PACKAGE, "test", "python"))
import doc_examples  # noqa: E402  (lies there)

FAR = {"x": 480.0, "y": 338.25}
DEADLINE = 120.0  # [s]


class PythonClientTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.client = CommandClient("apollo", timeout=support.DEADLINE)
        support.wait_until_ready(cls.client)
        cls.vehicle = Vehicle("/apollo/")

    def setUp(self):
        """As far from every goal as the tests need, however long those before this one took."""
        self.vehicle.wait_until_standing()
        self.vehicle.place(90.0, 194.75)

    def tearDown(self):
        self.client.clear()

    def test_every_example_of_the_page_works(self):
        blocks = doc_examples.blocks("python_client.md", "python")
        self.assertGreater(len(blocks), 6)
        names, printed = {}, io.StringIO()
        for block in blocks:
            with contextlib.redirect_stdout(printed):
                exec(compile(block, block, "exec"), names)
        self.assertIn("nothing has changed: command", printed.getvalue())
        self.assertIn("(CANCELLED)", printed.getvalue())

    def test_every_method_of_the_class_is_on_the_page(self):
        page = doc_examples.page("python_client.md")
        missing = [name for name in vars(CommandClient) if not name.startswith("_") and name + "(" not in page]
        self.assertEqual([], missing)

    def test_a_command_is_waited_for(self):
        shown = []
        command = self.client.lane_follow(x=360.0, y=195.0)
        self.assertEqual(command.status.status, CommandStatus.RUNNING)
        self.assertGreater(command.report.path_length, 100.0)
        status = command.wait(DEADLINE, shown.append)
        self.assertEqual((status.status, command.status), (CommandStatus.FINISHED, status))
        self.assertEqual({one.command_id for one in shown}, {command.id})
        self.assertTrue(any(one.has_progress for one in shown))
        self.assertEqual(command.wait(0.0), status, "that it has ended is known")

    def test_a_dry_run_has_a_path_and_is_over_at_once(self):
        plan = self.client.lane_follow(dry_run=True, **FAR)
        self.assertGreater(len(plan.path.points), 100)
        self.assertEqual(plan.wait(0.0).status, CommandStatus.FINISHED)
        self.assertNotIn(plan.id, [status.command_id for status in self.client.current().running])

    def assert_refused(self, name, send):
        with self.assertRaises(client_module.RefusedCommand) as caught:
            send()
        self.assertEqual(type(caught.exception).__name__, name, caught.exception)
        self.assertEqual(caught.exception.status.error_code, caught.exception.code)
        return caught.exception

    def test_each_refusal_has_its_exception(self):
        running = self.client.lane_follow(**FAR)
        for name, send in (
                ("OffMap", lambda: self.client.lane_follow(x=9000.0, y=0.0)),
                ("InvalidRequest", lambda: self.client.lane_follow(x=300.0, y=195.0, speed=-1.0)),
                ("InvalidRequest", lambda: self.client.valet_parking("no_such_space")),
                ("NoRoute", lambda: self.client.lane_follow(x=300.0, y=195.0, avoid_roads=["main_2"])),
                ("DuplicateId", lambda: self.client.lane_follow(x=300.0, y=195.0, id=running.id)),
                ("StaleRequest", self.send_stale)):
            with self.subTest(name):
                self.assert_refused(name, send)
        self.assertEqual(running.refresh().status, CommandStatus.RUNNING, "a refusal disturbs nothing")

    def send_stale(self):
        command = client_module.commands.speed(3.0)
        command.header.stamp = rospy.Time.now() - rospy.Duration(60.0)
        self.client.send(command)

    def test_a_command_that_others_end_fails_by_its_own_exception(self):
        for end, expected in ((lambda command: command.cancel(), client_module.CommandCancelled),
                              (lambda command: self.client.clear(), client_module.CommandCancelled),
                              (lambda command: self.client.lane_follow(x=300.0, y=195.0),
                               client_module.CommandSuperseded)):
            command = self.client.lane_follow(**FAR)
            end(command)
            with self.assertRaises(expected) as caught:
                command.wait(DEADLINE)
            self.assertEqual(caught.exception.command_id, command.id)

    def test_cancel_tells_whether_the_command_ran(self):
        command = self.client.lane_follow(**FAR)
        self.assertTrue(command.cancel())
        self.assertEqual(command.status.error_code, CommandStatus.CANCELLED)
        self.assertFalse(command.cancel())
        self.assertEqual(self.client.cancel(4711).status.status, CommandStatus.UNKNOWN)

    def test_who_waits_too_short_is_told_and_may_wait_again(self):
        command = self.client.lane_follow(**FAR)
        with self.assertRaises(client_module.StillRunning):
            command.wait(0.3)
        self.assertEqual(command.status.status, CommandStatus.RUNNING)
        threading.Timer(0.5, command.cancel).start()
        with self.assertRaises(client_module.CommandCancelled):
            command.wait(DEADLINE)

    def test_call_returns_refusals_too(self):
        response = self.client.call("lane_follow", LaneFollowCommand())
        self.assertFalse(client_module.accepted(response.status))

    def test_what_runs_is_told(self):
        command = self.client.lane_follow(**FAR)
        current = self.client.current()
        self.assertEqual((current.motion.command_id, current.motion.service), (command.id, "lane_follow"))
        self.assertIn(command.id, [status.command_id for status in current.running])

    def test_objects_of_the_map_are_found(self):
        spaces = self.client.map_objects("spaces", near=(120.0, 160.0), radius=30.0, max_count=3)
        self.assertEqual(len(spaces), 3)
        self.assertGreater(spaces.total_count, 3)
        self.assertEqual(self.client.map_objects("spaces").total_count, 132)
        self.assertEqual([area.id for area in self.client.map_objects("areas", id="yard")], ["yard"])
        self.assertEqual(self.client.map_objects("areas", near=(-9000.0, 0.0), radius=1.0), [])
        self.assert_refused("UnknownId", lambda: self.client.map_objects("areas", id="nowhere"))
        self.assert_refused("InvalidRequest", lambda: self.client.map_objects("areas", near=(float("nan"), 0.0)))

    def test_everything_is_there_while_all_runs(self):
        support.wait_until(lambda: self.client.unmet("lane_follow") == [], "lane following lacks nothing")
        self.assertGreater(len(self.client.readiness().conditions), 2)

    def test_nobody_there_is_an_exception_of_its_own(self):
        nobody = CommandClient("nobody", timeout=0.3)
        for ask in (nobody.current, nobody.readiness, lambda: nobody.lane_follow(x=1.0, y=2.0),
                    lambda: nobody.status(1), lambda: nobody.cancel(1), lambda: nobody.map_objects()):
            with self.assertRaisesRegex(client_module.ServiceUnavailable, "in namespace nobody"):
                ask()

    def test_several_threads_may_use_one_client(self):
        plans = []
        threads = [threading.Thread(target=lambda: plans.append(self.client.lane_follow(dry_run=True, **FAR)))
                   for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(DEADLINE)
        self.assertEqual(len({plan.id for plan in plans}), 2)


if __name__ == "__main__":
    rospy.init_node("my_program")  # as the page says; rostest gives it a name of its own
    rostest.rosrun("external_command", "python_client", PythonClientTest)
