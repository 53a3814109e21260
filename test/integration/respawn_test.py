#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What dies comes back, and what helps it to start is not needed afterwards."""
import os
import signal
import time
import unittest

import rospy
import rostest

import support
from external_command.msg import CommandStatus, LaneFollowCommand, PlanningCommand, Pose
from external_command.srv import GetCommandStatus, LaneFollow
from processes import Node

BACK = 3.0  # from the death of the process to its answers, at most [s]
BOND = 8.0  # a nodelet's bond breaks after less [s]


def answers(ns):
    try:
        call = rospy.ServiceProxy(ns + "/external_command/lane_follow", LaneFollow)
        command = LaneFollowCommand(is_start_pose_set=True, way_point=[Pose(x=100.0, y=195.0)], dry_run=True)
        command.end_pose = Pose(x=300.0, y=195.0)
        return call(command).status.status == CommandStatus.FINISHED
    except (rospy.ServiceException, OSError):
        return False


def status_answers(ns):
    try:
        rospy.ServiceProxy(ns + "/external_command/command_status", GetCommandStatus)(command_id=1)
        return True
    except (rospy.ServiceException, OSError):
        return False


class RespawnTest(unittest.TestCase):
    @staticmethod
    def killed(node):
        """Kills the process of `node`; its id."""
        pid = support.pid_of(node)
        os.kill(pid, signal.SIGKILL)
        return pid

    def test_is_back_in_time_after_it_was_killed_and_replays_nothing(self):
        support.wait_until(lambda: answers("/apollo"), "the first answer")
        pid = self.killed("/apollo/external_command")
        begin = time.monotonic()
        support.wait_until(lambda: answers("/apollo"), "an answer of the new one", BACK)
        print("back after %.2f s" % (time.monotonic() - begin))
        self.assertNotEqual(support.pid_of("/apollo/external_command"), pid)
        sent = support.Collector("/apollo/planning/command", PlanningCommand)
        self.assertTrue(answers("/apollo"))
        self.assertEqual(sent.messages, [])

    def test_is_loaded_again_after_its_manager_was_killed(self):
        support.wait_until(lambda: status_answers("/managed"), "the first answer")
        self.killed("/managed/external_command_manager")
        begin = time.monotonic()
        support.wait_until(lambda: status_answers("/managed"), "an answer of the new one", BACK)
        print("back in its manager after %.2f s" % (time.monotonic() - begin))

    def test_goes_on_while_what_loaded_it_is_suspended_or_dead(self):
        support.wait_until(lambda: status_answers("/managed"), "the first answer")
        helper = support.pid_of("/managed/external_command")
        manager = support.pid_of("/managed/external_command_manager")
        os.kill(helper, signal.SIGSTOP)
        self.assert_answers_for(BOND)
        os.kill(helper, signal.SIGKILL)
        support.wait_until(lambda: support.pid_of("/managed/external_command") not in (None, helper), "the helper is back")
        self.assert_answers_for(1.0)
        self.assertEqual(support.pid_of("/managed/external_command_manager"), manager)

    def test_a_second_manager_or_loader_of_the_same_name_gives_up(self):
        support.wait_until(lambda: status_answers("/managed"), "the first answer")
        had = [support.pid_of("/managed/" + name) for name in ("external_command_manager", "external_command")]
        component = "external_command/ExternalCommandProcessComponent"
        for name, *command in (("external_command_manager", "external_command_process", "--manager"),
                               ("external_command", "keep_nodelet_loaded", component, "external_command_manager")):
            with Node(*command, "__ns:=/managed", "__name:=" + name) as second:
                support.wait_until(lambda: "there is a node /managed/%s already" % name in second.output, "it gives up")
        self.assertEqual([support.pid_of("/managed/" + name) for name in ("external_command_manager", "external_command")], had)
        self.assertTrue(status_answers("/managed"))

    def assert_answers_for(self, duration):
        end = time.monotonic() + duration
        while time.monotonic() < end:
            self.assertTrue(status_answers("/managed"))
            time.sleep(0.1)


if __name__ == "__main__":
    rospy.init_node("respawn_test")
    rostest.rosrun("external_command", "respawn", RespawnTest)
