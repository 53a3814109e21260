#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What is missing is told before it is asked for, in the words of the refusals, on readiness and on diagnostics."""
import threading
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import OccupancyGrid

import support
from external_command.msg import (ActionCommand, Chassis, CommandStatus, LaneFollowCommand, PlanningCommand, Pose,
                                  Readiness)
from external_command.srv import Action, LaneFollow
from localization import Localization

EAST_END = Pose(x=300.0, y=195.0)
MOTIONS = ["free_space", "lane_follow", "path_follow", "precise_parking", "valet_parking", "zone_cover"]


def letters(words):
    """What is said, whatever numbers are in it: how old something is, for example."""
    return "".join(c for c in words if not c.isdigit() and c != ".")


class PlayedChassis:
    """Reports while it runs."""

    def __init__(self):
        self._publisher = rospy.Publisher("canbus/chassis", Chassis, queue_size=10)
        self._runs = threading.Event()
        threading.Thread(target=self._report, daemon=True).start()

    def start(self):
        self._runs.set()

    def stop(self):
        self._runs.clear()

    def _report(self):
        while not rospy.is_shutdown():
            rospy.sleep(0.05)
            if self._runs.is_set():
                self._publisher.publish(Chassis(driving_mode=Chassis.COMPLETE_MANUAL))


def lane_follow(ns="/apollo/", **fields):
    call = support.service(ns + "external_command/lane_follow", LaneFollow)
    return call(LaneFollowCommand(end_pose=EAST_END, **fields)).status


def switch_to_auto():
    call = support.service("external_command/action", Action)
    return call(ActionCommand(command=ActionCommand.SWITCH_TO_AUTO)).status


class ReadinessTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.localization = Localization(100.0, 195.0, child="played")
        cls.chassis = PlayedChassis()

    def setUp(self):
        self.readiness = support.Collector("external_command/readiness", Readiness)
        support.wait_until(lambda: self.readiness.messages, "the readiness is latched")

    def tearDown(self):
        self.readiness.close()

    def now(self, name):
        """The condition `name` as it was told last."""
        return next(c for c in self.readiness.messages[-1].conditions if c.name == name)

    def wait_for(self, name, is_met):
        support.wait_until(lambda: self.now(name).is_met == is_met, "%s is %smet" % (name, "" if is_met else "not "))
        return self.now(name)

    def assert_refused_in_the_words_of(self, name, refuse, readiness=None):
        def agree():
            told = self.now(name) if readiness is None else readiness(name)
            status = refuse()
            return status.error_code == CommandStatus.NOT_READY and letters(told.message) == letters(status.message)

        support.wait_until(agree, "%s and its refusal agree" % name, 10.0)

    def test_names_who_needs_what(self):
        self.assertEqual({c.name for c in self.readiness.messages[-1].conditions},
                         {"chassis", "map", "obstacle_grid", "planner", "planning", "pose"})
        self.assertEqual(self.now("chassis").needed_by, ["action", "chassis"])
        self.assertEqual(self.now("map").needed_by, ["lane_follow", "precise_parking", "valet_parking", "zone_cover"])
        self.assertEqual(self.now("pose").needed_by, [name for name in MOTIONS if name != "path_follow"])
        self.assertEqual(self.now("planner").needed_by, MOTIONS)
        self.assertEqual(self.now("obstacle_grid").needed_by, ["zone_cover"])

    def test_without_a_map(self):
        told = support.Collector("/without_map/external_command/readiness", Readiness)
        support.wait_until(lambda: told.messages, "the readiness is latched")
        conditions = {c.name: c for c in told.messages[-1].conditions}
        self.assertFalse(told.messages[-1].is_ready)
        self.assertFalse(conditions["map"].is_met)
        self.assert_refused_in_the_words_of("map", lambda: lane_follow("/without_map/"), conditions.get)
        self.assertTrue(self.now("map").is_met)
        self.assertIn("208 lanes", self.now("map").message)

    def test_as_the_pose_comes_and_goes(self):
        self.wait_for("pose", False)
        self.assert_refused_in_the_words_of("pose", lane_follow)
        self.localization.start()
        self.wait_for("pose", True)
        self.assertEqual(lane_follow(dry_run=True).status, CommandStatus.FINISHED)
        self.localization.stop()
        self.assertIn("old", self.wait_for("pose", False).message)
        self.assert_refused_in_the_words_of("pose", lane_follow)

    def test_as_the_chassis_comes_and_goes(self):
        self.wait_for("chassis", False)
        self.assert_refused_in_the_words_of("chassis", switch_to_auto)
        self.chassis.start()
        self.assertIn("COMPLETE_MANUAL", self.wait_for("chassis", True).message)
        self.assertNotEqual(switch_to_auto().error_code, CommandStatus.NOT_READY)
        self.chassis.stop()
        self.wait_for("chassis", False)
        self.assert_refused_in_the_words_of("chassis", switch_to_auto)

    def test_as_the_grid_comes_and_goes(self):
        self.assertIn("no obstacle grid", self.wait_for("obstacle_grid", False).message)
        publisher = rospy.Publisher("obstacles", OccupancyGrid, queue_size=1)
        grid = OccupancyGrid(data=[0] * 4)
        grid.header.frame_id = "map"
        grid.info.width = grid.info.height = 2
        grid.info.resolution = 1.0
        grid.info.origin.orientation.w = 1.0

        def is_met():
            publisher.publish(grid)
            return self.now("obstacle_grid").is_met

        support.wait_until(is_met, "the grid is there")
        self.assertIn("old", self.wait_for("obstacle_grid", False).message)

    def test_as_the_planner_comes_says_nothing_and_speaks(self):
        self.assertIn("nobody listens to /apollo/planning/command", self.wait_for("planner", False).message)
        commands = support.Collector("planning/command", PlanningCommand)
        self.wait_for("planner", True)
        self.localization.start()
        self.wait_for("pose", True)
        motion = lane_follow()
        self.assertEqual(motion.status, CommandStatus.RUNNING, support.describe(motion))
        words = self.wait_for("planner", False).message.split(": ", 1)[1]
        support.wait_until(lambda: words in support.command_status(motion.command_id).message, "its status says it too")

        reports = rospy.Publisher("planning/command_status", CommandStatus, queue_size=10)

        def is_met():
            reports.publish(CommandStatus(command_id=motion.command_id, status=CommandStatus.RUNNING))
            return self.now("planner").is_met

        support.wait_until(is_met, "the planner speaks")
        self.assertIn("reports", self.now("planner").message)
        commands.close()
        self.wait_for("planner", False)
        self.localization.stop()

    def test_is_ready_when_nothing_is_missing_and_tells_changes_only(self):
        self.localization.start()
        self.chassis.start()
        commands = support.Collector("planning/command", PlanningCommand)
        publisher = rospy.Publisher("obstacles", OccupancyGrid, queue_size=1)
        grid = OccupancyGrid(data=[0])
        grid.info.width = grid.info.height = 1
        grid.info.resolution = grid.info.origin.orientation.w = 1.0
        support.service("external_command/action", Action)(ActionCommand(command=ActionCommand.CLEAR_PLANNING))

        def is_ready():
            publisher.publish(grid)
            return self.readiness.messages[-1].is_ready

        support.wait_until(is_ready, "all is there")
        already = len(self.readiness.messages)
        for _ in range(15):
            publisher.publish(grid)
            rospy.sleep(0.1)
        self.assertEqual(len(self.readiness.messages), already)
        commands.close()
        self.localization.stop()
        self.chassis.stop()
        self.wait_for("pose", False)
        self.assertFalse(self.readiness.messages[-1].is_ready)
        self.wait_for("chassis", False)

    def test_diagnostics_tell_the_same(self):
        refused = lane_follow()
        diagnostics = support.Collector("/diagnostics", DiagnosticArray)

        def statuses():
            """By their names, the newest of this vehicle."""
            found = {}
            for message in diagnostics.messages:
                for status in message.status:
                    vehicle, name = status.name.split(": ")
                    if vehicle == "apollo/external_command":
                        found[name] = status
            return found

        def agree():
            found = statuses()
            return all(c.name in found and letters(c.message) == letters(found[c.name].message) and
                       (found[c.name].level == DiagnosticStatus.OK) == c.is_met
                       for c in self.readiness.messages[-1].conditions)

        self.assertEqual(refused.error_code, CommandStatus.NOT_READY, support.describe(refused))
        support.wait_until(agree, "diagnostics and readiness agree")
        support.wait_until(lambda: str(refused.command_id) in statuses()["commands"].message, "the last one is told")
        values = {value.key: value.value for value in statuses()["commands"].values}
        self.assertGreaterEqual(int(values["refused NOT_READY"]), 1)
        self.assertIn("needed by", [value.key for value in statuses()["pose"].values])
        self.assertIn("commands that wait", [value.key for value in statuses()["planning"].values])
        diagnostics.close()


if __name__ == "__main__":
    rospy.init_node("readiness_test")
    rostest.rosrun("external_command", "readiness", ReadinessTest)
