#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far a motion command has come, with a planner that reports and without, and what runs now."""
import unittest

import rospy
import rostest

import support
from external_command.msg import ActionCommand, CommandStatus, PathFollowCommand, SpeedCommand
from external_command.srv import Action, GetCurrentCommand, LaneFollow, PathFollow, Speed
from geometry_msgs.msg import Point
from localization import Localization
from vehicle import Vehicle

SILENT = "/silent/external_command/"
LENGTH = 40.0  # of the ways [m]


def current(prefix):
    return support.service(prefix + "current_command", GetCurrentCommand)()


class ProgressTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()
        cls.silent = Localization(0.0, 0.0, child="silent_base")
        cls.at_first = current(SILENT)

    def assert_is_progress(self, statuses, command_id):
        """Of one command from its begin to its end, monotone; the messages before the first pose apart."""
        statuses = [status for status in statuses if status.command_id == command_id]
        self.assertEqual({status.service for status in statuses}, {"path_follow"})
        known = [status for status in statuses if status.has_progress]
        self.assertGreater(len(known), 3)
        for before, after in zip(known, known[1:]):
            self.assertLessEqual(before.share_done, after.share_done)
            self.assertGreaterEqual(before.distance_left, after.distance_left)
        for status in known:
            self.assertAlmostEqual(status.distance_left, (1.0 - status.share_done) * LENGTH, delta=0.01)
            self.assertEqual(status.time_left > 0.0, status.distance_left > 0.0, status)
        self.assertLess(known[0].share_done, 0.5)
        self.assertGreater(known[0].time_left, known[-2].time_left)
        last = statuses[-1]
        self.assertEqual(last.status, CommandStatus.FINISHED, support.describe(last))
        self.assertEqual((last.has_progress, last.share_done, last.distance_left, last.time_left), (True, 1.0, 0.0, 0.0))
        self.assertEqual([status.status for status in statuses[:-1]], [CommandStatus.RUNNING] * (len(statuses) - 1))

    def send_to_silent_vehicle(self):
        """A way straight on, from where it is; the id of the command."""
        x, y = self.silent.x, self.silent.y
        command = PathFollowCommand(way_point=[Point(x, y, 0.0), Point(x + LENGTH, y, 0.0)])
        answers = []

        def is_sent():
            answers.append(support.service(SILENT + "path_follow", PathFollow)(command).status)
            return answers[-1].error_code != CommandStatus.NOT_READY

        support.wait_until(is_sent, "the pose is known")
        self.assertEqual(answers[-1].status, CommandStatus.RUNNING, support.describe(answers[-1]))
        return answers[-1].command_id

    def silent_status(self, command_id):
        return support.command_status(command_id, SILENT + "command_status")

    def test_of_a_planner_that_reports(self):
        progress = support.Collector("external_command/progress", CommandStatus)
        changes = support.Collector("external_command/status", CommandStatus)
        command_id = self.vehicle.drive_straight(length=LENGTH)
        support.wait_until(lambda: support.command_status(command_id).share_done > 0.3, "the vehicle is on its way")
        running = current("external_command/")
        self.assertEqual(running.motion.command_id, command_id)
        self.assertIn(command_id, [status.command_id for status in running.running])
        support.wait_for_status(command_id, CommandStatus.FINISHED)
        progress.wait_for(lambda m: m.command_id == command_id and m.status == CommandStatus.FINISHED, "the end")
        self.assert_is_progress(progress.messages, command_id)
        told = [(m.status, m.message) for m in changes.messages if m.command_id == command_id]
        self.assertEqual(len(told), len(set(told)), "the status topic tells changes only")
        support.wait_until(lambda: not current("external_command/").running, "nothing runs")
        self.assertEqual(current("external_command/").motion.status, CommandStatus.FINISHED)
        progress.close()
        changes.close()

    def test_of_a_planner_that_says_nothing_and_of_a_pose_that_is_lost(self):
        self.assertEqual(self.at_first.motion.status, CommandStatus.UNKNOWN, support.describe(self.at_first.motion))
        self.assertEqual(self.at_first.running, [])
        self.silent.start()
        progress = support.Collector("/silent/external_command/progress", CommandStatus)
        command_id = self.send_to_silent_vehicle()
        begin = self.silent.x
        for metres in range(0, 21, 2):
            self.silent.x = begin + metres
            support.wait_until(lambda: abs(self.silent_status(command_id).distance_left - LENGTH + metres) < 0.1,
                               "%d m are driven" % metres)
        self.assert_knows_the_speed(command_id)
        half = self.silent_status(command_id)
        self.assertAlmostEqual(half.share_done, 0.5, delta=0.01)

        self.silent.stop()
        support.wait_until(lambda: not self.silent_status(command_id).has_progress, "the pose is lost")
        lost = self.silent_status(command_id)
        self.assertEqual((lost.distance_left, lost.share_done, lost.time_left), (0.0, 0.0, 0.0))
        self.silent.start()
        support.wait_until(lambda: self.silent_status(command_id).has_progress, "the pose is there again")

        for metres in range(22, int(LENGTH) + 1, 2):
            self.silent.x = begin + metres
            rospy.sleep(0.15)
        support.wait_for_status(command_id, CommandStatus.FINISHED, SILENT + "command_status")
        progress.wait_for(lambda m: m.command_id == command_id and m.status == CommandStatus.FINISHED, "the end")
        self.assert_is_progress(progress.messages, command_id)
        self.silent.stop()
        progress.close()

    def assert_knows_the_speed(self, command_id):
        """Half-way: slower takes longer, until the speed is restored; to halt is nothing to count with."""
        before = self.silent_status(command_id).time_left
        for fields, least in ((dict(kind=SpeedCommand.TARGET_SPEED, target_speed=0.5), LENGTH),
                              (dict(kind=SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=0.5), 2.0 * LENGTH),
                              (dict(kind=SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=0.0), 2.0 * LENGTH),
                              (dict(kind=SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=1e-9), 40.0 * LENGTH)):
            self.change_speed(**fields)
            support.wait_until(lambda: self.silent_status(command_id).time_left > 0.9 * least, "the time is longer")
            self.assertLess(self.silent_status(command_id).time_left, 100.0 * LENGTH, fields)
        self.change_speed(kind=SpeedCommand.RESTORE_TARGET_SPEED)
        support.wait_until(lambda: self.silent_status(command_id).time_left < before + 5.0, "the time is as before")

    @staticmethod
    def change_speed(**fields):
        command = SpeedCommand(**fields)
        command.header.stamp = rospy.Time.now()
        status = support.service(SILENT + "speed", Speed)(command).status
        assert status.status == CommandStatus.FINISHED, support.describe(status)

    def test_is_none_of_what_drives_nothing(self):
        follow = ActionCommand(command=ActionCommand.FOLLOW)
        status = support.service(SILENT + "action", Action)(follow).status
        self.assertEqual(status.service, "action")
        running = [s for s in current(SILENT).running if s.command_id == status.command_id]
        self.assertEqual([(s.service, s.has_progress) for s in running], [("action", False)])
        ended = support.service("external_command/action", Action)(follow).status
        ended = support.wait_for_status(ended.command_id, CommandStatus.FINISHED)
        self.assertFalse(ended.has_progress)
        refused = support.service("external_command/lane_follow", LaneFollow)().status
        self.assertEqual((refused.status, refused.service), (CommandStatus.ERROR, "lane_follow"))


if __name__ == "__main__":
    rospy.init_node("progress_test")
    rostest.rosrun("external_command", "progress", ProgressTest)
