#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Commands whose paths are planned: free space, valet and precise parking, zone cover; driven by the simulated vehicle."""
import math
import shutil

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Point

import support
from external_command.msg import (
    CommandStatus, FreeSpaceCommand, LaneFollowCommand, PathPoint, PlanningCommand, Pose, PreciseParkingCommand,
    RoiPolygon, ValetParkingCommand, ZoneCoverCommand)
from external_command.srv import FreeSpace, LaneFollow, PreciseParking, ValetParking, ZoneCover

CHARGING_SPOT = Pose(x=322.0, y=110.0, heading=0.0, has_heading=True)
ON_MAIN_STREET = Pose(x=90.0, y=194.75, heading=0.0, has_heading=True)
COURTYARD = [(-15, -15), (15, -15), (15, 15), (-15, 15)]


def polygon(corners):
    return RoiPolygon(points=[Point(x=x, y=y) for x, y in corners])


def box(x, y, size):
    return polygon([(x - size, y - size), (x + size, y - size), (x + size, y + size), (x - size, y + size)])


def pose(x, y, heading):
    return Pose(x=x, y=y, heading=heading, has_heading=True)


class ManoeuvresTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        for frame in ("base_link", "courtyard/base_link"):
            support.wait_until(lambda name=frame: cls.buffer.can_transform("map", name, rospy.Time(0)), frame)
        for ns in ("apollo", "courtyard"):
            support.wait_until(lambda name=ns: cls.knows_its_pose(name), ns + " knows its pose")

    @staticmethod
    def knows_its_pose(ns):
        call = support.service("/%s/external_command/free_space" % ns, FreeSpace)
        answer = call(FreeSpaceCommand(parking_spot_pose=pose(0.0, 0.0, 0.0), dry_run=True))
        return answer.status.error_code != CommandStatus.NOT_READY

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(rospy.get_param("/courtyard/zone_cover_command_processor/progress_folder"), ignore_errors=True)

    def call(self, ns, name, service_type, command):
        return support.service("/%s/external_command/%s" % (ns, name), service_type)(command)

    def free_space(self, goal, **fields):
        fields.setdefault("drivable_roi", polygon(COURTYARD))
        return self.call("courtyard", "free_space", FreeSpace, FreeSpaceCommand(parking_spot_pose=goal, **fields))

    def zone_cover(self, **fields):
        return self.call("courtyard", "zone_cover", ZoneCover, ZoneCoverCommand(**fields))

    def vehicle(self, frame):
        transform = self.buffer.lookup_transform("map", frame, rospy.Time(0)).transform
        return transform.translation.x, transform.translation.y, 2.0 * math.atan2(
            transform.rotation.z, transform.rotation.w)

    def assert_stands_at(self, goal, frame):
        x, y, heading = self.vehicle(frame)
        self.assertLess(math.hypot(x - goal.x, y - goal.y), 0.1)
        self.assertLess(abs(math.remainder(heading - goal.heading, 2.0 * math.pi)), 0.02)

    def assert_ends_at(self, path, goal):
        last = path.points[-1]
        self.assertLess(math.hypot(last.x - goal.x, last.y - goal.y), 1e-3)
        self.assertLess(abs(math.remainder(last.heading - goal.heading, 2.0 * math.pi)), math.radians(0.01))

    def assert_wheels_follow(self, path):
        """Between gear changes, manoeuvre, lanes and where they meet included, they need not turn faster than they can."""
        vehicle = rospy.get_param("/apollo/external_command/vehicle")
        for a, b in zip(path.points, path.points[1:]):
            if a.direction != b.direction or b.s - a.s < 1e-6:
                continue
            turned = math.atan(vehicle["wheelbase"] * b.kappa) - math.atan(vehicle["wheelbase"] * a.kappa)
            rate = abs(turned) * 0.5 * (a.speed + b.speed) / (b.s - a.s)
            self.assertLess(rate, 1.05 * vehicle["max_steering_rate"], "at %.1f m" % a.s)

    def assert_steers_gradually_where_it_leaves_the_lanes(self, path):
        """The points of a manoeuvre are much closer together than those of lanes."""
        steps = list(zip(path.points, path.points[1:]))
        before, after = next((a, b) for a, b in steps if b.s - a.s < 0.2)
        self.assertEqual(before.direction, after.direction)
        self.assertLess(abs(after.kappa - before.kappa), 0.05, "at %.1f m" % before.s)

    def assert_running(self, answer):
        self.assertEqual(answer.status.status, CommandStatus.RUNNING, support.describe(answer.status))
        return answer.status.command_id

    def assert_refused(self, answer, error_code, *words):
        self.assertEqual(answer.status.error_code, error_code, support.describe(answer.status))
        for word in words:
            self.assertIn(word, answer.status.message)

    def drive(self, ns, answer):
        command_id = self.assert_running(answer)
        support.wait_for_status(command_id, CommandStatus.FINISHED, "/%s/external_command/command_status" % ns, 90.0)

    def drive_to_the_middle(self):
        self.drive("courtyard", self.free_space(pose(0.0, 0.0, 0.0)))

    def test_free_space_parks_in_a_courtyard_without_a_map(self):
        goal = pose(-8.0, 9.0, math.pi / 2.0)
        answer = self.free_space(goal, non_drivable_roi=[box(-2.0, 8.0, 1.5)])
        self.assertGreater(answer.report.min_clearance, 0.0)
        self.assertGreater(answer.report.wheel_turns, 0.0)
        self.drive("courtyard", answer)
        self.assert_stands_at(goal, "courtyard/base_link")

    def test_free_space_is_repeatable(self):
        goal = pose(8.0, -8.0, -math.pi / 2.0)
        first, second = (self.free_space(goal, dry_run=True) for _ in range(2))
        self.assertEqual([p.x for p in first.path.points], [p.x for p in second.path.points])
        self.assert_ends_at(first.path, goal)

    def test_free_space_refuses_what_cannot_be_reached(self):
        self.drive_to_the_middle()
        self.assert_refused(self.free_space(pose(0.0, 14.9, 0.0)), CommandStatus.GOAL_BLOCKED, "drivable_roi")
        self.assert_refused(self.free_space(pose(6.0, 6.0, 0.0), non_drivable_roi=[box(9.0, 9.0, 0.5), box(7.0, 6.0, 1)]),
                            CommandStatus.GOAL_BLOCKED, "non_drivable_roi[1]")
        wall = [polygon([(-15, 10), (15, 10), (15, 10.2), (-15, 10.2)])]
        self.assert_refused(self.free_space(pose(-3.0, 12.7, 0.0), non_drivable_roi=wall), CommandStatus.NO_PATH)

    def test_free_space_tells_that_there_is_no_room_to_turn(self):
        self.drive_to_the_middle()
        for half_width, error_code, words in ((1.7, CommandStatus.NO_PATH, ["too little room to turn"]),
                                              (4.5, CommandStatus.OK, [])):
            street = polygon([(-15, -half_width), (15, -half_width), (15, half_width), (-15, half_width)])
            answer = self.free_space(pose(3.0, 0.0, math.pi), drivable_roi=street, dry_run=True)
            self.assert_refused(answer, error_code, *words)

    def test_free_space_shuffles_round_in_a_narrow_street(self):
        self.drive_to_the_middle()
        street = polygon([(-15, -2.95), (15, -2.95), (15, 2.95), (-15, 2.95)])
        answer = self.free_space(pose(3.0, 0.0, math.pi), drivable_roi=street, dry_run=True)
        self.assertEqual(answer.status.error_code, CommandStatus.OK, support.describe(answer.status))
        self.assertGreater(answer.report.gear_changes, 6)
        self.assertGreater(answer.report.min_clearance, 0.0)

    def test_free_space_reaches_a_goal_nearer_than_the_margin(self):
        goal = pose(-8.0, 4.0, 0.0)
        for distance, words in ((0.05, "nearer than the margin"), (0.5, None)):
            answer = self.free_space(goal, non_drivable_roi=[box(-8.0, 5.5 + distance, 0.5)], dry_run=True)
            self.assertEqual(answer.status.error_code, CommandStatus.OK, support.describe(answer.status))
            self.assertEqual([words in w for w in answer.report.warnings], [True] if words else [])
        self.assert_refused(self.free_space(goal, non_drivable_roi=[box(-8.0, 5.45, 0.5)], dry_run=True),
                            CommandStatus.GOAL_BLOCKED, "non_drivable_roi[0]")

    def test_free_space_takes_a_point_for_an_obstacle(self):
        goal = pose(-8.0, 4.0, 0.0)
        self.assert_refused(self.free_space(goal, non_drivable_roi=[polygon([(-7.0, 4.0)] * 3)], dry_run=True),
                            CommandStatus.GOAL_BLOCKED, "non_drivable_roi[0]")
        answer = self.free_space(goal, non_drivable_roi=[polygon([(-7.0, 9.0)] * 3)], dry_run=True)
        self.assertEqual(answer.status.error_code, CommandStatus.OK, support.describe(answer.status))

    def test_free_space_refuses_bad_polygons(self):
        bow_tie = polygon([(0, 0), (5, 5), (5, 0), (0, 5)])
        self.assert_refused(self.free_space(pose(5, 5, 0), non_drivable_roi=[bow_tie]), CommandStatus.INVALID_REQUEST,
                            "non_drivable_roi[0]")
        self.assert_refused(self.free_space(Pose(x=5, y=5)), CommandStatus.INVALID_REQUEST, "has_heading")

    def valet(self, spot, **fields):
        return self.call("apollo", "valet_parking", ValetParking, ValetParkingCommand(parking_spot_id=spot, **fields))

    def test_valet_parking_ends_in_the_space(self):
        for spot in ("n_out_5", "ave_east_2"):
            with self.subTest(spot=spot):
                answer = self.valet(spot, is_start_pose_set=True, way_point=[ON_MAIN_STREET], dry_run=True)
                self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
                self.assertGreater(answer.report.gear_changes + answer.report.path_length, 0.0)
                self.assertGreater(answer.report.min_clearance, 0.0)
                self.assertGreater(answer.report.near_length, 0.0, "a space is hardly wider than the vehicle")
                self.assert_wheels_follow(answer.path)
                self.assert_steers_gradually_where_it_leaves_the_lanes(answer.path)

    def test_parks_and_leaves_the_space_again(self):
        self.drive("apollo", self.valet("n_out_5"))
        sent = support.Collector("/apollo/planning/command", PlanningCommand)
        answer = self.call("apollo", "lane_follow", LaneFollow, LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0)))
        self.assertEqual(answer.report.warnings, [])
        command = sent.wait_for(lambda m: m.command_id == answer.status.command_id and m.is_motion_command,
                                "the command")
        x, y, _ = self.vehicle("base_link")
        first = command.path.points[0]
        self.assertLess(math.hypot(first.x - x, first.y - y), 1.0)
        self.assert_wheels_follow(command.path)
        self.drive("apollo", answer)

    def precise(self, spot=CHARGING_SPOT, **fields):
        return self.call("apollo", "precise_parking", PreciseParking,
                         PreciseParkingCommand(parking_spot_pose=spot, **fields))

    def test_precise_parking_reaches_the_exact_pose_nose_in_or_backing_in(self):
        for inwards, gear in ((True, PathPoint.FORWARD), (False, PathPoint.REVERSE)):
            with self.subTest(parking_inwards=inwards):
                answer = self.precise(parking_inwards=inwards, is_start_pose_set=True, way_point=[ON_MAIN_STREET],
                                      dry_run=True)
                self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
                self.assert_ends_at(answer.path, CHARGING_SPOT)
                self.assert_wheels_follow(answer.path)
                self.assertEqual(answer.path.points[-1].direction, gear)
                self.assertTrue(answer.report.lane_ids)

    def test_precise_parking_refuses_a_spot_outside_every_area(self):
        self.assert_refused(self.precise(ON_MAIN_STREET), CommandStatus.INVALID_REQUEST, "area")

    def test_precise_parking_names_what_the_map_has_in_the_way(self):
        across_the_fence = pose(332.0, 110.0, 0.0)
        answer = self.precise(across_the_fence, parking_inwards=True, is_start_pose_set=True, way_point=[ON_MAIN_STREET])
        self.assert_refused(answer, CommandStatus.GOAL_BLOCKED, "sticks out of the surface of lanes and area by")

    def test_zone_cover_sweeps_a_courtyard_and_tells_how_far_it_is(self):
        statuses = support.Collector("/courtyard/external_command/status", CommandStatus)
        self.drive_to_the_middle()
        answer = self.zone_cover(drivable_roi=polygon(COURTYARD), swath_width=2.0)
        self.assertGreater(answer.report.coverage_ratio, 0.8)
        command_id = self.assert_running(answer)
        statuses.wait_for(lambda m: m.command_id == command_id and "swath" in m.message and "%" in m.message, "progress")
        support.wait_for_status(command_id, CommandStatus.FINISHED, "/courtyard/external_command/command_status", 90.0)

    def test_zone_cover_sweeps_an_area_of_the_map(self):
        command = ZoneCoverCommand(zone_cover_area_id="yard", swath_width=2.5, dry_run=True, is_start_pose_set=True,
                                   way_point=[ON_MAIN_STREET])
        answer = self.call("apollo", "zone_cover", ZoneCover, command)
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
        self.assertTrue(answer.report.lane_ids)
        self.assertTrue(any(answer.path.tool_on))
        self.assertFalse(answer.path.tool_on[0])
        self.assert_wheels_follow(answer.path)

    def test_zone_cover_refuses_what_cannot_be_swept(self):
        self.drive_to_the_middle()
        invalid = CommandStatus.INVALID_REQUEST
        self.assert_refused(self.zone_cover(), invalid, "zone_cover_area_id and drivable_roi are both empty")
        both = self.zone_cover(zone_cover_area_id="yard", drivable_roi=polygon(COURTYARD))
        self.assert_refused(both, invalid, "yard", "drivable_roi has 4 points", "not both")
        self.assert_refused(self.zone_cover(drivable_roi=polygon([(0, 0), (9, 9)])), invalid, "drivable_roi.points has 2")
        self.assert_refused(self.zone_cover(drivable_roi=polygon([(0, 0), (1, 0), (1, 1), (0, 1)])), invalid,
                            "smaller than the vehicle")
        self.assert_refused(self.zone_cover(drivable_roi=polygon([(0, 0), (30, 30), (30, 0), (0, 30)])), invalid,
                            "drivable_roi")
        elsewhere = polygon([(100, 100), (140, 100), (140, 140), (100, 140)])
        self.assert_refused(self.zone_cover(drivable_roi=elsewhere), CommandStatus.START_BLOCKED)
        unknown = ZoneCoverCommand(zone_cover_area_id="no_such_area")
        self.assert_refused(self.call("apollo", "zone_cover", ZoneCover, unknown), invalid, "no_such_area")


if __name__ == "__main__":
    rospy.init_node("manoeuvres_test")
    rostest.rosrun("external_command", "manoeuvres", ManoeuvresTest)
