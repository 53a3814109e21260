#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Simulated time, as a bag plays it that begins again at its end."""
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Clock

import support
from external_command.msg import CommandStatus, LaneFollowCommand, Pose, Readiness
from external_command.srv import CancelCommand, LaneFollow
from localization import Localization


class SimulatedTime:
    def __init__(self, seconds):
        self.now = seconds
        self._publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while not rospy.is_shutdown():
            self._publisher.publish(Clock(rospy.Time.from_sec(self.now)))
            time.sleep(0.02)
            self.now += 0.02


class SimTimeTest(unittest.TestCase):
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

    def test_the_pose_is_known_again_after_time_jumped_back(self):
        simulated = SimulatedTime(5000.0)
        support.wait_until(lambda: rospy.get_time() >= 5000.0, "time goes on")
        localization = Localization(100.0, 195.0)
        localization.start()
        call = support.service("external_command/lane_follow", LaneFollow)

        def start():
            response = call(LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True))
            return response.path.points[0].x if response.status.status == CommandStatus.FINISHED else 0.0

        support.wait_until(lambda: abs(start() - 100.0) < 0.5, "the pose is known")
        localization.x = 120.0
        simulated.now = 10.0
        support.wait_until(lambda: abs(start() - 120.0) < 0.5, "the pose after the jump is known", 5.0)


if __name__ == "__main__":
    rospy.init_node("sim_time_test")
    rostest.rosrun("external_command", "sim_time", SimTimeTest)
