#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Speed commands: what the vehicle makes of them, and what is refused."""
import math
import unittest

import rospy
import rostest

import support
from external_command.msg import CommandStatus, SpeedCommand
from external_command.srv import Speed
from vehicle import Vehicle


def change_speed(kind, age=None, **fields):
    """`age` [s] of the stamp; None: no stamp."""
    command = SpeedCommand(kind=kind, **fields)
    if age is not None:
        command.header.stamp = rospy.Time.now() - rospy.Duration(age)
    return support.service("external_command/speed", Speed)(command).status


class SpeedTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()

    def setUp(self):
        self.sent = support.Collector("planning/speed_command", SpeedCommand)

    def tearDown(self):
        self.sent.close()

    def assert_sent(self, status):
        self.assertEqual(status.status, CommandStatus.FINISHED, support.describe(status))
        return self.sent.wait_for(lambda m: m.command_id == status.command_id, "the speed command on its topic")

    def assert_refused(self, status, error_code, *words):
        self.assertEqual(status.status, CommandStatus.ERROR, support.describe(status))
        self.assertEqual(status.error_code, error_code, support.describe(status))
        for word in words:
            self.assertIn(word, status.message)

    def wait_for_speed(self, speed):
        support.wait_until(lambda: abs(self.vehicle.speed - speed) < 0.05, "a speed of %.1f m/s" % speed)

    def test_changes_the_speed_and_restores_it(self):
        self.vehicle.drive_straight(target_speed=4.0)
        self.wait_for_speed(4.0)
        self.assert_sent(change_speed(SpeedCommand.TARGET_SPEED, target_speed=2.0))
        self.wait_for_speed(2.0)
        self.assert_sent(change_speed(SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=0.5))
        self.wait_for_speed(1.0)
        self.assert_sent(change_speed(SpeedCommand.TARGET_SPEED_FACTOR))
        self.wait_for_speed(0.0)
        self.assert_sent(change_speed(SpeedCommand.RESTORE_TARGET_SPEED))
        self.wait_for_speed(4.0)

    def test_the_vehicles_maximum_caps_the_target_speed(self):
        status = change_speed(SpeedCommand.TARGET_SPEED, target_speed=99.0)
        self.assertEqual(self.assert_sent(status).target_speed, 15.0)
        self.assertIn("99", status.message)
        self.assertIn("15", status.message)

    def test_a_fresh_stamp_is_fine(self):
        sent = self.assert_sent(change_speed(SpeedCommand.RESTORE_TARGET_SPEED, age=0.5))
        self.assertGreater((rospy.Time.now() - sent.header.stamp).to_sec(), 0.5, "it goes on as it came")

    def test_a_command_without_a_stamp_goes_on_with_that_of_its_sending(self):
        before = rospy.Time.now()
        sent = self.assert_sent(change_speed(SpeedCommand.RESTORE_TARGET_SPEED))
        self.assertGreaterEqual(sent.header.stamp, before)

    def test_refuses_stale_stamps_and_those_of_the_future(self):
        self.assert_refused(change_speed(SpeedCommand.RESTORE_TARGET_SPEED, age=3.0), CommandStatus.STALE_REQUEST,
                            "old", "the limit is 2.00 s")
        self.assert_refused(change_speed(SpeedCommand.RESTORE_TARGET_SPEED, age=-10.0), CommandStatus.STALE_REQUEST,
                            "future")

    def test_refuses_what_is_out_of_range(self):
        invalid = CommandStatus.INVALID_REQUEST
        self.assert_refused(change_speed(0), invalid, "kind is 0", "TARGET_SPEED")
        self.assert_refused(change_speed(4), invalid, "kind is 4")
        self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED, target_speed=-1.0), invalid, "target_speed is -1")
        self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED), invalid, "target_speed is 0")
        for speed in (math.nan, math.inf):
            self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED, target_speed=speed), invalid, "finite")
        self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED, target_speed=1e-200), invalid,
                            "target_speed is 1e-200 m/s", "0.01 m/s at least")
        for factor in (-0.1, 1.1, math.nan):
            self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=factor), invalid,
                                "target_speed_factor", "[0, 1]")
        for unused in (-1.0, math.nan):
            self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED_FACTOR, target_speed=unused), invalid,
                                "target_speed is")
            self.assert_refused(change_speed(SpeedCommand.TARGET_SPEED, target_speed=1.0, target_speed_factor=unused),
                                invalid, "target_speed_factor")
        sent = self.assert_sent(change_speed(SpeedCommand.RESTORE_TARGET_SPEED))
        self.assertEqual([m.command_id for m in self.sent.messages], [sent.command_id])


if __name__ == "__main__":
    rospy.init_node("speed_test")
    rostest.rosrun("external_command", "speed", SpeedTest)
