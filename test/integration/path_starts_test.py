#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Paths begin at the vehicle, wherever it stands, and are driven to their end by the simulated one."""
import math
import unittest

import rospy
import rostest

import support
from external_command.msg import CommandStatus, LaneFollowCommand, Pose
from external_command.srv import CancelCommand, LaneFollow
from vehicle import Vehicle

EAST_END = Pose(x=300.0, y=194.75, heading=0.0, has_heading=True)
CHARGING_SPOT = (322.0, 110.0, 0.0)  # in the yard, 30 m from the nearest lane


class PathStartsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()

    @staticmethod
    def follow(end_pose=EAST_END, **fields):
        call = support.service("external_command/lane_follow", LaneFollow)
        return call(LaneFollowCommand(end_pose=end_pose, **fields))

    def assert_begins_at(self, points, x, y, heading):
        self.assertLess(math.hypot(points[0].x - x, points[0].y - y), 0.01)
        self.assertLess(abs(math.remainder(points[0].heading - heading, 2.0 * math.pi)), 0.02)

    def assert_drives_from(self, x, y, heading):
        self.vehicle.place(x, y, heading)
        planned = self.follow(dry_run=True)
        self.assertEqual(planned.status.error_code, CommandStatus.OK, support.describe(planned.status))
        self.assertEqual(planned.report.warnings, [])
        self.assert_begins_at(planned.path.points, x, y, heading)
        status = self.follow().status
        support.wait_for_status(status.command_id, CommandStatus.FINISHED, deadline=60.0)

    def test_on_the_lane_but_beside_its_centre_line(self):
        self.assert_drives_from(150.0, 195.4, 0.15)

    def test_in_an_area_of_the_map(self):
        self.assert_drives_from(*CHARGING_SPOT)

    def test_off_the_lanes_where_there_is_room_to_get_onto_one(self):
        self.assert_drives_from(150.0, 190.5, 0.0)

    def test_too_far_off_the_lanes_for_a_manoeuvre_is_told_with_the_distance(self):
        self.vehicle.place(150.0, 180.0, 0.0)
        answer = self.follow(dry_run=True)
        self.assertEqual(answer.status.error_code, CommandStatus.OK, support.describe(answer.status))
        self.assertTrue(any("m from the vehicle: no manoeuvre leads there" in warning
                            for warning in answer.report.warnings), answer.report.warnings)

    def test_a_given_start_is_warned_of_where_the_vehicle_is_elsewhere(self):
        for start, is_warned_of in ((250.0, True), (92.0, False)):
            self.vehicle.place(90.0, 194.75, 0.0)
            answer = self.follow(is_start_pose_set=True, way_point=[Pose(x=start, y=194.75)])
            self.assertEqual(answer.status.status, CommandStatus.RUNNING, support.describe(answer.status))
            support.service("external_command/cancel_command", CancelCommand)(command_id=answer.status.command_id)
            told = [warning for warning in answer.report.warnings if "(is_start_pose_set), 160.00 m from" in warning]
            self.assertEqual(bool(told), is_warned_of, answer.report.warnings)

    def test_a_path_that_is_too_long_is_refused(self):
        self.vehicle.place(90.0, 194.75, 0.0)
        answer = self.follow(way_point=[EAST_END, Pose(x=90.0, y=194.75)] * 200, dry_run=True)
        self.assertEqual(answer.status.error_code, CommandStatus.INVALID_REQUEST, support.describe(answer.status))
        self.assertIn("~routing/max_path_length", answer.status.message)


if __name__ == "__main__":
    rospy.init_node("path_starts_test")
    rostest.rosrun("external_command", "path_starts", PathStartsTest)
