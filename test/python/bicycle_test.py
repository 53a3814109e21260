# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import unittest

from external_command import bicycle
from paths import DT, LIMITS


class BicycleTest(unittest.TestCase):
    def drive(self, state, speed, steering, seconds):
        for _ in range(round(seconds / DT)):
            state = bicycle.step(state, LIMITS, speed, steering, LIMITS.max_deceleration, DT)
        return state

    def test_a_constant_steering_angle_gives_a_circle_of_the_right_radius(self):
        for gear in (1.0, -1.0):
            start = bicycle.VehicleState(3.0, 4.0, 0.7, gear, LIMITS.steering_for(0.1))
            radius = 10.0
            center = (3.0 - radius * math.sin(0.7), 4.0 + radius * math.cos(0.7))
            state = start
            for _ in range(3000):
                state = bicycle.step(state, LIMITS, gear, start.steering, 1.0, DT)
                self.assertAlmostEqual(math.hypot(state.x - center[0], state.y - center[1]), radius, places=6)

    def test_reversing_the_same_steering_leads_back(self):
        there = self.drive(bicycle.VehicleState(steering=0.3), 0.0, 0.3, 1.0)
        state = dataclasses.replace(there, speed=1.0)
        for speed in (1.0, -1.0):
            state = dataclasses.replace(state, speed=speed)
            for _ in range(500):
                state = bicycle.step(state, LIMITS, speed, 0.3, 1.0, DT)
        self.assertAlmostEqual(state.x, there.x, places=6)
        self.assertAlmostEqual(state.y, there.y, places=6)

    def test_speeding_up_and_braking_keep_their_limits(self):
        state = self.drive(bicycle.VehicleState(), 100.0, 0.0, 2.0)
        self.assertAlmostEqual(state.speed, 2.0 * LIMITS.max_acceleration, places=6)
        state = self.drive(state, 0.0, 0.0, 0.5)
        self.assertAlmostEqual(state.speed, 2.0 * LIMITS.max_acceleration - 0.5 * LIMITS.max_deceleration, places=6)

    def test_steering_keeps_its_rate(self):
        state = self.drive(bicycle.VehicleState(), 0.0, 0.5, 0.4)
        self.assertAlmostEqual(state.steering, 0.4 * LIMITS.max_steering_rate, places=6)

    def test_steering_is_cut_at_full_lock(self):
        self.assertEqual(LIMITS.steering_for(9.0), LIMITS.steering_for(1.2 / LIMITS.min_turning_radius))
        self.assertEqual(LIMITS.steering_for(-9.0), -LIMITS.steering_for(9.0))

    def test_limits_that_make_no_sense_are_refused_by_name(self):
        for value in (0.0, -1.0, math.nan, math.inf):
            with self.assertRaisesRegex(ValueError, "vehicle/wheelbase is"):
                bicycle.VehicleLimits(wheelbase=value)


if __name__ == "__main__":
    unittest.main()
