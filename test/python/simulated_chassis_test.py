# SPDX-License-Identifier: Apache-2.0
import unittest

from external_command.msg import Chassis, ChassisCommand, ControlPad, VehicleSignal
from external_command.simulated_chassis import ChassisSettings, SimulatedChassis


class SimulatedChassisTest(unittest.TestCase):
    def test_switches_the_mode_after_a_delay(self):
        chassis = SimulatedChassis(ChassisSettings(mode_switch_delay=0.2))
        self.assertEqual((chassis.mode, chassis.obstacle), (Chassis.COMPLETE_AUTO_DRIVE, ""))
        for action, mode in ((ControlPad.RESET, Chassis.COMPLETE_MANUAL),
                             (ControlPad.START, Chassis.COMPLETE_AUTO_DRIVE)):
            before = chassis.mode
            chassis.accept_pad(action)
            chassis.step(0.1)
            self.assertEqual((chassis.mode, chassis.is_switching), (before, True))
            chassis.step(0.11)
            self.assertEqual((chassis.mode, chassis.is_switching), (mode, False))

    def test_a_repeated_request_does_not_begin_the_delay_anew(self):
        chassis = SimulatedChassis(ChassisSettings(mode_switch_delay=0.2))
        chassis.accept_pad(ControlPad.RESET)
        chassis.step(0.15)
        chassis.accept_pad(ControlPad.RESET)
        chassis.step(0.1)
        self.assertEqual(chassis.mode, Chassis.COMPLETE_MANUAL)

    def test_can_ignore_requests(self):
        for ignored, needed in ((0, 1), (2, 3)):
            chassis = SimulatedChassis(ChassisSettings(ignored_mode_switches=ignored, mode_switch_delay=0.0))
            requests = 0
            while chassis.mode != Chassis.COMPLETE_MANUAL:
                chassis.accept_pad(ControlPad.RESET)
                chassis.step(0.02)
                requests += 1
            self.assertEqual(requests, needed)
        chassis = SimulatedChassis(ChassisSettings(ignored_mode_switches=-1))
        chassis.accept_pad(ControlPad.RESET)
        self.assertFalse(chassis.is_switching)

    def test_says_why_it_does_not_drive(self):
        self.assertIn("manual", SimulatedChassis(ChassisSettings(driving_mode="manual")).obstacle)
        chassis = SimulatedChassis(ChassisSettings())
        chassis.accept_pad(ControlPad.STOP)
        self.assertIn("stopped", chassis.obstacle)
        chassis.accept_pad(ControlPad.START)
        chassis.step(1.0)
        self.assertEqual(chassis.obstacle, "")

    def test_tells_its_vin_when_asked(self):
        chassis = SimulatedChassis(ChassisSettings(vin="V1"))
        self.assertEqual(chassis.vin, "")
        chassis.accept_pad(ControlPad.VIN_REQ)
        self.assertEqual(chassis.vin, "V1")

    def test_reflects_signals_and_keeps_what_is_not_named(self):
        chassis = SimulatedChassis(ChassisSettings())
        chassis.accept_command(ChassisCommand(basic_signal=VehicleSignal(turn_signal=VehicleSignal.TURN_LEFT)))
        chassis.accept_command(ChassisCommand(basic_signal=VehicleSignal(horn=VehicleSignal.ON)))
        self.assertEqual(chassis.signal, VehicleSignal(turn_signal=VehicleSignal.TURN_LEFT, horn=VehicleSignal.ON,
                                                       high_beam=VehicleSignal.OFF, low_beam=VehicleSignal.OFF,
                                                       emergency_light=VehicleSignal.OFF))

    def test_an_unknown_mode_is_refused(self):
        with self.assertRaisesRegex(ValueError, "driving_mode is fast"):
            ChassisSettings(driving_mode="fast")


if __name__ == "__main__":
    unittest.main()
