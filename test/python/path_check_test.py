# SPDX-License-Identifier: Apache-2.0
import math
import unittest

from external_command.bicycle import VehicleState
from external_command.path_check import faults, start_fault
from paths import LIMITS, PARKING, limited, make_path


class PathCheckTest(unittest.TestCase):
    def assert_fault(self, text, points, **kinds):
        found = faults(points, LIMITS, **kinds)
        self.assertTrue(any(text in fault for fault in found), "%r is not told in %s" % (text, found))

    def test_takes_what_a_vehicle_can_drive(self):
        for pieces in ([(30.0, 0.0)], [(20.0, 0.0), (8.0, 0.2), (20.0, 0.0)], PARKING, [(-5.0, 0.1), (5.0, 0.1)]):
            self.assertEqual(faults(limited(make_path(pieces)), LIMITS), [], pieces)

    def test_takes_a_vehicle_that_is_there_already(self):
        self.assertEqual(faults(limited(make_path([(0.0, 0.0)])), LIMITS), [])

    def test_tells_a_limit_of_0_inside_a_leg(self):
        points = limited(make_path([(30.0, 0.0)]))
        points[100].speed = 0.0
        self.assert_fault("inside a leg", points)

    def test_tells_an_end_and_a_gear_change_that_are_passed_at_speed(self):
        for index in (80, -1):
            points = limited(make_path([(8.0, 0.0), (-5.0, 0.0)]))
            points[index].speed = 0.3
            self.assert_fault("must stop", points)

    def test_tells_speeds_that_cannot_be_braked_for_or_sped_up_to(self):
        for before, after in ((5.0, 1.0), (1.0, 5.0)):
            points = limited(make_path([(40.0, 0.0)]))
            for i, p in enumerate(points[:300]):
                p.speed = before if i < 150 else after
            self.assert_fault("m/s^2 from %.2f to %.2f" % (before, after), points)

    def test_tells_speeds_above_what_gear_and_bend_allow(self):
        points = limited(make_path([(-30.0, 0.0)]))
        for p in points[1:-60]:
            p.speed = 2.5
        self.assert_fault("the vehicle's is 2.00", points)
        points = limited(make_path([(30.0, 0.1)]))
        for p in points[1:-100]:
            p.speed = 4.5
        self.assert_fault("to the side", points)

    def test_tells_jumps_of_place_heading_and_s(self):
        for change, text in ((lambda p: setattr(p, "x", p.x + 3.0), "from the one before"),
                             (lambda p: setattr(p, "y", p.y + 0.02), "sideways"),
                             (lambda p: setattr(p, "heading", p.heading + 0.2), "the curvature says"),
                             (lambda p: setattr(p, "s", p.s - 0.2), "has an s")):
            points = limited(make_path([(30.0, 0.0)]))
            change(points[77])
            self.assert_fault(text, points)

    def test_tells_a_path_that_turns_round(self):
        points = limited(make_path([(10.0, 0.0)]))
        points[50:60] = reversed(points[50:60])
        self.assert_fault("point 51", points)

    def test_tells_bends_that_are_too_tight_unless_they_are_known(self):
        points = limited(make_path([(10.0, 0.0), (5.0, 0.3)]))
        self.assert_fault("radius of 3.33 m", points)
        self.assertEqual(faults(points, LIMITS, check_curvature=False), [])

    def test_tells_what_is_no_path(self):
        self.assert_fault("0 points", [])
        points = limited(make_path([(10.0, 0.0)]))
        points[5].kappa = math.nan
        self.assert_fault("point 5 is not finite", points)


class StartFaultTest(unittest.TestCase):
    def test_takes_a_path_that_begins_at_the_vehicle(self):
        self.assertIsNone(start_fault(make_path([(10.0, 0.0)]), VehicleState(0.1, 0.1, 0.05), 0.3))

    def test_tells_another_place_and_another_heading(self):
        points = make_path([(10.0, 0.0)])
        self.assertIn("0.50 m from the vehicle", start_fault(points, VehicleState(0.5, 0.0, 0.0), 0.3))
        self.assertIn("1.00 rad off", start_fault(points, VehicleState(0.0, 0.0, -1.0), 0.3))


if __name__ == "__main__":
    unittest.main()
