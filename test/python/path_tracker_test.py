# SPDX-License-Identifier: Apache-2.0
import math
import random
import unittest

from external_command import bicycle
from external_command.msg import PathPoint
from external_command.path_legs import PathError, split_legs
from external_command.path_tracker import PathTracker
from external_command.plane import distance
from paths import DT, LIMITS, PARKING, limited, make_path, state_at


def offset_from(points, state):
    """Distance of a vehicle from the polyline of a path [m]."""
    nearest = math.inf
    for a, b in zip(points, points[1:]):
        dx, dy = b.x - a.x, b.y - a.y
        square = dx * dx + dy * dy
        t = min(max(((state.x - a.x) * dx + (state.y - a.y) * dy) / square, 0.0), 1.0) if square else 0.0
        nearest = min(nearest, distance((a.x + t * dx, a.y + t * dy), (state.x, state.y)))
    return nearest


class PathTrackerTest(unittest.TestCase):
    def drive(self, points, start=None, limit=600.0):
        """Every state on the way to the end of the path; fails where it is not reached within `limit` [s]."""
        tracker = PathTracker(points, LIMITS)
        states = [start or state_at(points[0])]
        while len(states) * DT < limit:
            state = states[-1]
            if tracker.leg_done(state) and not tracker.next_leg():
                self.assertAlmostEqual(tracker.driven, tracker.length, delta=0.01)
                return states, tracker.end_error(state)
            control = tracker.control(state, DT)
            states.append(bicycle.step(state, LIMITS, tracker.gear * control.speed, control.steering,
                                       LIMITS.max_deceleration, DT))
        self.fail("not at the end after %g s" % limit)

    def assert_drives(self, points, within=0.03):
        states, (position, heading) = self.drive(points)
        self.assertLess(max(offset_from(points, state) for state in states[::10]), within)
        self.assertLess(position, 0.02)
        self.assertLess(math.degrees(heading), 0.5)
        return states

    def test_follows_a_straight_and_stops_at_its_end(self):
        self.assert_drives(make_path([(50.0, 0.0)]), within=0.001)

    def test_follows_bends_whose_curvature_jumps(self):
        self.assert_drives(make_path([(20.0, 0.0), (18.0, 1.0 / 12.0), (15.0, -1.0 / 15.0), (20.0, 0.0)]))

    def test_follows_a_change_from_full_lock_to_full_lock(self):
        self.assert_drives(make_path([(10.0, 0.0), (8.0, 0.2), (8.0, -0.2), (5.0, 0.0)], speed=3.0))

    def test_parks_exactly(self):
        self.assert_drives(make_path(PARKING, speed=2.0))

    def test_follows_many_short_legs(self):
        self.assert_drives(make_path([(0.3, 0.2), (-0.3, -0.2)] * 5))

    def test_takes_a_sparse_path(self):
        self.assert_drives([PathPoint(x=0.0), PathPoint(x=40.0, direction=1)])

    def test_is_as_fast_as_the_limits_of_a_path_and_stops_at_its_zeros(self):
        states = self.assert_drives(limited(make_path(PARKING, speed=1.0)), within=0.05)
        self.assertAlmostEqual(max(abs(state.speed) for state in states), 1.0, delta=0.01)
        self.assertLess(len(states) * DT, 60.0, "it does not crawl")

    def test_follows_random_manoeuvres(self):
        seed = 20
        random.seed(seed)
        for case in range(15):
            pieces = [(random.choice((-1.0, 1.0)) * random.uniform(0.5, 8.0), random.choice((-0.2, 0.0, 0.2)))
                      for _ in range(6)]
            with self.subTest(seed=seed, case=case, pieces=pieces):
                self.assert_drives(make_path(pieces, speed=2.0), within=0.05)

    def test_keeps_the_speed_limits(self):
        points = make_path([(60.0, 0.0), (30.0, 1.0 / 12.0)], speed=12.0)
        states = self.assert_drives(points)
        self.assertGreater(max(state.speed for state in states), 8.0)
        for state in states:
            kappa = abs(math.tan(state.steering)) / LIMITS.wheelbase
            self.assertLess(state.speed ** 2 * kappa, 1.3 * LIMITS.max_lateral_acceleration)
        for a, b in zip(states, states[1:]):
            self.assertLessEqual(a.speed - b.speed, LIMITS.max_deceleration * DT + 1e-9)

    def test_stops_before_it_changes_gear(self):
        states = self.assert_drives(make_path(PARKING, speed=2.0))
        for a, b in zip(states, states[1:]):
            self.assertGreaterEqual(a.speed * b.speed, 0.0)

    def test_drives_to_a_path_that_begins_elsewhere(self):
        points = make_path([(100.0, 0.0)])
        for start in (bicycle.VehicleState(0.0, 15.0, -1.5), bicycle.VehicleState(-10.0, -10.0, 0.0),
                      bicycle.VehicleState(5.0, 3.0, 3.1)):
            states, (position, _) = self.drive(points, start)
            self.assertLess(position, 0.02)
            self.assertLess(max(offset_from(points, state) for state in states), 20.0)

    def test_finds_back_to_the_path_in_reverse(self):
        points = make_path([(-30.0, 0.0), (-10.0, 0.1)])
        _, (position, _) = self.drive(points, bicycle.VehicleState(0.0, 0.5, 0.0))
        self.assertLess(position, 0.02)

    def test_a_path_along_itself_is_driven_once_around(self):
        states = self.assert_drives(make_path([(2.0 * math.pi * 15.0, 1.0 / 15.0), (5.0, 1.0 / 15.0)]))
        self.assertGreater(sum(abs(state.speed) * DT for state in states), 98.0)


class SplitLegsTest(unittest.TestCase):
    def test_cuts_at_gear_changes_and_shares_the_cusp(self):
        legs = split_legs(make_path([(2.0, 0.0), (-3.0, 0.1), (1.0, 0.0)]))
        self.assertEqual([gear for _, gear in legs], [1, -1, 1])
        for (before, _), (after, _) in zip(legs, legs[1:]):
            self.assertIs(before[-1], after[0])

    def test_leaves_out_repeated_points(self):
        points = [PathPoint(x=x, speed=1.0, direction=1) for x in (0.0, 0.0, 1.0, 1.0, 1.0, 2.0)]
        self.assertEqual([p.x for p in split_legs(points)[0][0]], [0.0, 1.0, 2.0])

    def test_refuses_what_cannot_be_driven_and_says_why(self):
        point = PathPoint
        for points, text in (([], "0 points"), ([point()], "1 points"), ([point(), point()], "no length"),
                             ([point(), point(x=math.nan)], "point 1 of the path is not finite"),
                             ([point(), point(x=1.0, speed=math.inf)], "point 1 of the path is not finite"),
                             ([point(), point(x=1.0, direction=5)], "direction 5"),
                             ([point(), point(x=1e300)], "1e\\+300 m long"),
                             ([point(speed=1.0), point(x=1.0), point(x=2.0)], "limit of 0 at \\(1.00, 0.00\\)"),
                             ([point(), point(x=1.0, speed=-1.0)], "limit of -1 m/s"),
                             ([point(), point(y=1.0)], "off its heading"),
                             ([point(), point(x=1.0, direction=-1)], "off its heading")):
            with self.assertRaisesRegex(PathError, text):
                split_legs(points)


if __name__ == "__main__":
    unittest.main()
