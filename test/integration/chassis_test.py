#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Chassis commands: lights and horn as the vehicle reports them, and operations of others passed on."""
import unittest

import rospy
import rostest

import support
from external_command import any_message
from external_command.msg import Any, ChassisCommand, CommandStatus, SpeedCommand, VehicleSignal
from external_command.srv import ChassisControl
from vehicle import Vehicle


def control(age=None, custom_operation=None, **signals):
    """`age` [s] of the stamp; None: no stamp."""
    command = ChassisCommand(basic_signal=VehicleSignal(**signals), custom_operation=custom_operation or Any())
    if age is not None:
        command.header.stamp = rospy.Time.now() - rospy.Duration(age)
    return support.service("external_command/chassis", ChassisControl)(command).status


class ChassisTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()

    def setUp(self):
        self.sent = support.Collector("canbus/chassis_control", ChassisCommand)

    def tearDown(self):
        self.sent.close()

    def assert_carried_out(self, **signals):
        status = control(**signals)
        self.assertEqual(status.status, CommandStatus.RUNNING, support.describe(status))
        support.wait_for_status(status.command_id, CommandStatus.FINISHED)
        reported = self.vehicle.chassis.signal
        support.wait_until(lambda: all(getattr(self.vehicle.chassis.signal, name) == value
                                       for name, value in signals.items()), "%s in %s" % (signals, reported))

    def assert_refused(self, status, error_code, *words):
        self.assertEqual(status.status, CommandStatus.ERROR, support.describe(status))
        self.assertEqual(status.error_code, error_code, support.describe(status))
        for word in words:
            self.assertIn(word, status.message)

    def test_switches_signals_and_keeps_the_others(self):
        self.assert_carried_out(turn_signal=VehicleSignal.TURN_LEFT, low_beam=VehicleSignal.ON)
        self.assert_carried_out(horn=VehicleSignal.ON)
        self.assertEqual(self.vehicle.chassis.signal.turn_signal, VehicleSignal.TURN_LEFT)
        self.assert_carried_out(turn_signal=VehicleSignal.TURN_NONE, low_beam=VehicleSignal.OFF,
                                horn=VehicleSignal.OFF)

    def test_a_command_that_changes_no_signal_is_finished_when_sent(self):
        status = control()
        self.assertEqual(status.status, CommandStatus.FINISHED, support.describe(status))
        sent = self.sent.wait_for(lambda m: m.command_id == status.command_id, "the chassis command on its topic")
        self.assertFalse(sent.header.stamp.is_zero(), "it goes on with the stamp of its sending")

    def test_passes_custom_operations_on_untouched(self):
        packed = any_message.pack(SpeedCommand(kind=SpeedCommand.TARGET_SPEED, target_speed=3.5))
        status = control(custom_operation=packed)
        self.assertEqual(status.status, CommandStatus.FINISHED, support.describe(status))
        sent = self.sent.wait_for(lambda m: m.command_id == status.command_id, "the chassis command on its topic")
        self.assertEqual(sent.custom_operation, packed)
        self.assertEqual(any_message.unpack(sent.custom_operation, SpeedCommand).target_speed, 3.5)
        unknown = Any(type="nobodys_package/Unknown", md5sum="0123456789abcdef" * 2, data=b"\x00\xff")
        status = control(custom_operation=unknown)
        sent = self.sent.wait_for(lambda m: m.command_id == status.command_id, "the chassis command on its topic")
        self.assertEqual(sent.custom_operation, unknown)

    def test_refuses_malformed_custom_operations(self):
        invalid = CommandStatus.INVALID_REQUEST
        md5 = "0" * 32
        for type_name in ("NoPackage", "a/b/c", "/Type", "package/", "1a/B", "a b/C", "x" * 1000):
            self.assert_refused(control(custom_operation=Any(type=type_name, md5sum=md5)), invalid,
                                "custom_operation.type", "package/Type")
        self.assert_refused(control(custom_operation=Any(type="x" * 200000, md5sum=md5)), invalid,
                            "custom_operation.type has 200000 bytes", "the limit is 1000 (~requests/max_text)")
        for bad in ("", "*", "0" * 31, "g" * 32):
            self.assert_refused(control(custom_operation=Any(type="package/Type", md5sum=bad)), invalid,
                                "custom_operation.md5sum")
        self.assert_refused(control(custom_operation=Any(data=b"1234")), invalid, "custom_operation.type")

    def test_refuses_signals_out_of_range(self):
        invalid = CommandStatus.INVALID_REQUEST
        self.assert_refused(control(turn_signal=5), invalid, "basic_signal.turn_signal is 5", "0 to 4")
        for name in ("high_beam", "low_beam", "horn", "emergency_light"):
            self.assert_refused(control(**{name: 3}), invalid, "basic_signal.%s is 3" % name, "0 to 2")

    def test_refuses_stale_requests(self):
        self.assert_refused(control(age=3.0, horn=VehicleSignal.ON), CommandStatus.STALE_REQUEST, "old")
        self.assertEqual(control(age=0.5).status, CommandStatus.FINISHED)


if __name__ == "__main__":
    rospy.init_node("chassis_test")
    rostest.rosrun("external_command", "chassis", ChassisTest)
