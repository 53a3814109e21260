#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manager dies and comes back; the gateway with it."""
import os
import signal
import unittest

import rospy
import rostest

import support
from external_command.msg import CommandStatus, LaneFollowCommand, PlanningCommand, Pose
from external_command.srv import LaneFollow

MANAGER = "/apollo/external_command_manager"


def answers():
    try:
        call = rospy.ServiceProxy("/apollo/external_command/lane_follow", LaneFollow)
        command = LaneFollowCommand(is_start_pose_set=True, way_point=[Pose(x=100.0, y=195.0)], dry_run=True)
        command.end_pose = Pose(x=300.0, y=195.0)
        return call(command).status.status == CommandStatus.FINISHED
    except (rospy.ServiceException, OSError):
        return False


class RespawnTest(unittest.TestCase):
    def test_comes_back_after_the_manager_was_killed_and_replays_nothing(self):
        support.wait_until(answers, "the first answer")
        pid = support.pid_of(MANAGER)
        os.kill(pid, signal.SIGKILL)
        support.wait_until(lambda: support.pid_of(MANAGER) not in (None, pid), "the manager is respawned", 60.0)
        support.wait_until(answers, "an answer of the new one", 60.0)
        sent = support.Collector("/apollo/planning/command", PlanningCommand)
        self.assertTrue(answers())
        self.assertEqual(sent.messages, [])


if __name__ == "__main__":
    rospy.init_node("respawn_test")
    rostest.rosrun("external_command", "respawn", RespawnTest)
