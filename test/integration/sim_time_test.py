#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Simulated time, as a bag plays it that begins again at its end."""
import threading
import time
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point
from rosgraph_msgs.msg import Clock

import support
from external_command.msg import (
    ActionCommand,
    CommandStatus,
    LaneFollowCommand,
    PathFollowCommand,
    PlanningCommand,
    PlanningPad,
    Pose,
    Readiness,
)
from external_command.srv import Action, CancelCommand, GetCommandStatus, LaneFollow, PathFollow
from goals import BareClient
from localization import Localization


class SimulatedTime:
    def __init__(self, seconds):
        self.now = seconds
        self.passes = True
        self._publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while not rospy.is_shutdown():
            self._publisher.publish(Clock(rospy.Time.from_sec(self.now)))
            time.sleep(0.02)
            self.now += 0.02 if self.passes else 0.0

    def jump(self, seconds):
        self.now = seconds
        support.wait_until(lambda: abs(rospy.get_time() - seconds) < 100.0, "time has jumped")


class SimTimeTest(unittest.TestCase):
    _time = None

    @classmethod
    def time_from(cls, seconds):
        """The simulated time, which the first that asks for it lets begin."""
        cls._time = cls._time or SimulatedTime(seconds)
        cls._time.jump(seconds)
        return cls._time

    def test_before_time_begins_it_is_told_what_is_missing(self):
        self.assertEqual(rospy.get_time(), 0.0, "nobody publishes a clock yet")
        readiness = support.Collector("external_command/readiness", Readiness)
        support.wait_until(lambda: readiness.messages, "the readiness is told")
        conditions = {condition.name: condition for condition in readiness.messages[-1].conditions}
        self.assertTrue(conditions["map"].is_met)
        self.assertFalse(conditions["pose"].is_met)
        diagnostics = support.Collector("/diagnostics", DiagnosticArray)
        support.wait_until(lambda: len(diagnostics.messages) > 3, "diagnostics go on")
        unknown = support.service("external_command/cancel_command", CancelCommand)(command_id=1)
        self.assertEqual(unknown.status.error_code, CommandStatus.UNKNOWN_ID)

    def test_goals_end_whether_time_jumps_back_or_stands_still(self):
        simulated = self.time_from(5000.0)
        client = BareClient("path_follow")
        command = PathFollowCommand(way_point=[Point(0.0, 0.0, 0.0), Point(10.0, 0.0, 0.0)], dry_run=True)

        def assert_succeeds(goal_id):
            client.send(goal_id, command, rospy.Time.now())
            self.assertEqual(client.end(goal_id).status.status, GoalStatus.SUCCEEDED)

        assert_succeeds("before")
        client.cancel("all that was sent before", rospy.Time.now())
        client.wait_until_known("all that was sent before", GoalStatus.RECALLING)
        client.send("late", command, rospy.Time(4500.0))
        self.assertEqual(client.end("late").status.status, GoalStatus.RECALLED)
        simulated.jump(10.0)
        support.wait_until(lambda: client.states.messages[-1].header.stamp.to_sec() < 4000.0, "states after the jump")
        assert_succeeds("after the jump")
        simulated.passes = False
        assert_succeeds("while time stands still")
        simulated.passes = True
        client.close()

    def test_stops_are_later_than_the_commands_before_them_though_time_stands_still(self):
        simulated = self.time_from(5000.0)
        commands = support.Collector("planning/command", PlanningCommand)
        pads = support.Collector("planning/pad", PlanningPad)
        follow = support.service("external_command/path_follow", PathFollow)
        act = support.service("external_command/action", Action)
        path = PathFollowCommand(way_point=[Point(0.0, 0.0, 0.0), Point(10.0, 0.0, 0.0)])
        looked_up = support.service("external_command/command_status", GetCommandStatus)
        support.wait_until(lambda: looked_up(1).status.header.stamp.to_sec() > 4000.0, "the gateway hears the time")
        simulated.passes = False
        try:
            self.assertEqual(follow(path).status.status, CommandStatus.RUNNING)
            act(ActionCommand(command=ActionCommand.STOP))
            self.assertEqual(follow(path).status.status, CommandStatus.RUNNING)
            act(ActionCommand(command=ActionCommand.CLEAR_PLANNING))

            def motions():
                return [command.header.stamp for command in commands.messages if command.is_motion_command]

            support.wait_until(lambda: len(motions()) == 2 and len(pads.messages) == 2, "all is heard")
            stamps = [motions()[0], pads.messages[0].header.stamp, motions()[1], pads.messages[1].header.stamp]
            for earlier, later in zip(stamps, stamps[1:]):
                self.assertLess(earlier, later)
            self.assertLess(stamps[-1] - stamps[0], rospy.Duration(1.0))
        finally:
            simulated.passes = True

    def test_the_pose_is_known_again_after_time_jumped_back(self):
        simulated = self.time_from(5000.0)
        localization = Localization(100.0, 195.0)
        localization.start()
        call = support.service("external_command/lane_follow", LaneFollow)

        def start():
            response = call(LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True))
            return response.path.points[0].x if response.status.status == CommandStatus.FINISHED else 0.0

        support.wait_until(lambda: abs(start() - 100.0) < 0.5, "the pose is known")
        localization.x = 120.0
        simulated.jump(10.0)
        support.wait_until(lambda: abs(start() - 120.0) < 0.5, "the pose after the jump is known", 5.0)


if __name__ == "__main__":
    rospy.init_node("sim_time_test")
    rostest.rosrun("external_command", "sim_time", SimTimeTest)
