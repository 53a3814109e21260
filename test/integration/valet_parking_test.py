#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Valet parking in the demo town: the route to a parking space by its id, and what is refused."""
import math
import unittest

import rospy
import rostest

import support
from external_command.msg import (CommandStatus, LaneFollowCommand, LaneSegment, PlanningCommand, Pose,
                                  ValetParkingCommand)
from external_command.srv import LaneFollow, ValetParking

SPACE = "n_out_10"  # in a row north of the aisle aisle_n
SPACE_MIDDLE = (134.6, 172.25)
MAIN_STREET = Pose(x=300.0, y=195.0, heading=0.0, has_heading=True)


def valet_parking(**fields):
    call = support.service("external_command/valet_parking", ValetParking)
    return call(ValetParkingCommand(**fields))


def lane_follow(**fields):
    call = support.service("external_command/lane_follow", LaneFollow)
    return call(LaneFollowCommand(**fields))


def end_of(path):
    last = path.points[-1]
    return Pose(x=last.x, y=last.y, heading=last.heading, has_heading=True)


def distance(pose, point):
    return math.hypot(pose.x - point[0], pose.y - point[1])


class ValetParkingTest(unittest.TestCase):
    def setUp(self):
        support.wait_until(self._vehicle_is_known, "a pose of the vehicle")

    def _vehicle_is_known(self):
        return valet_parking(parking_spot_id=SPACE, dry_run=True).status.error_code != CommandStatus.NOT_READY

    def planned(self, **fields):
        """The answer to a dry run that succeeds."""
        answer = valet_parking(dry_run=True, **fields)
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
        return answer

    def assert_refused(self, answer, error_code, *words):
        status = answer.status
        self.assertEqual((status.status, status.error_code), (CommandStatus.ERROR, error_code),
                         support.describe(status))
        for word in words:
            self.assertIn(word, status.message)

    def test_drives_to_the_space_and_away_again(self):
        sent = support.Collector("planning/command", PlanningCommand)
        status = valet_parking(parking_spot_id=SPACE, target_speed=8.0).status
        self.assertEqual(status.status, CommandStatus.RUNNING, support.describe(status))
        command = sent.wait_for(lambda m: m.command_id == status.command_id, "the planning command")
        self.assertEqual(command.command_type, PlanningCommand.PARKING)
        self.assertEqual(command.parking_command.parking_spot_id, SPACE)
        self.assertEqual(command.parking_command.target_speed, 8.0)
        self.assertTrue(command.has_lane_follow_command)
        self.assertTrue(command.lane_follow_command.road)
        self.assertLess(distance(end_of(command.path), SPACE_MIDDLE), 12.0)
        support.wait_for_status(status.command_id, CommandStatus.FINISHED, deadline=60.0)

        away = lane_follow(end_pose=MAIN_STREET).status
        self.assertEqual(away.status, CommandStatus.RUNNING, support.describe(away))
        support.wait_for_status(away.command_id, CommandStatus.FINISHED, deadline=60.0)

    def test_every_row_of_spaces_can_be_driven_to(self):
        for row in ("n_out", "n_in", "m_north", "m_south", "s_in", "s_out", "ave_east", "ave_west"):
            answer = self.planned(parking_spot_id=row + "_3")
            self.assertFalse([warning for warning in answer.report.warnings if "overlap" in warning])

    def test_takes_the_shorter_way_of_both_sides_of_the_aisle(self):
        aisle = self.planned(parking_spot_id=SPACE).report.lane_ids[-1]
        around = self.planned(parking_spot_id=SPACE, blacklisted_lane=[LaneSegment(id=aisle)])
        self.assertNotEqual(around.report.lane_ids[-1], aisle)
        self.assertGreater(around.report.route_length, self.planned(parking_spot_id=SPACE).report.route_length)

    def test_passes_its_way_points(self):
        detour = Pose(x=380.0, y=250.0)
        answer = self.planned(parking_spot_id=SPACE, way_point=[detour])
        self.assertLess(min(math.hypot(p.x - detour.x, p.y - detour.y) for p in answer.path.points), 4.0)

    def test_a_vehicle_beside_the_space_stays_there(self):
        aisle = Pose(x=SPACE_MIDDLE[0], y=166.0)
        abreast = end_of(lane_follow(end_pose=aisle, dry_run=True).path)
        for offset in (-0.8, 0.0, 0.8):
            start = Pose(x=abreast.x + offset * math.cos(abreast.heading),
                         y=abreast.y + offset * math.sin(abreast.heading), heading=abreast.heading, has_heading=True)
            answer = self.planned(parking_spot_id=SPACE, is_start_pose_set=True, way_point=[start])
            self.assertAlmostEqual(answer.report.route_length, 0.0, places=6)
            self.assertTrue(answer.path.points)

    def test_refuses_bad_requests(self):
        invalid = CommandStatus.INVALID_REQUEST
        self.assert_refused(valet_parking(), invalid, "parking_spot_id", "empty")
        self.assert_refused(valet_parking(parking_spot_id="P-99"), invalid, "parking_spot_id", "P-99", "132")
        self.assert_refused(valet_parking(parking_spot_id=SPACE, target_speed=-1.0), invalid, "target_speed")
        self.assert_refused(valet_parking(parking_spot_id=SPACE, way_point=[Pose(y=float("nan"))]), invalid,
                            "way_point[0].y", "nan")
        self.assert_refused(valet_parking(parking_spot_id=SPACE, blacklisted_road=["no_such_road"]), invalid,
                            "no_such_road")
        self.assert_refused(valet_parking(parking_spot_id=SPACE, blacklisted_road=["aisle_n"]),
                            CommandStatus.NO_ROUTE, "black")


if __name__ == "__main__":
    rospy.init_node("valet_parking_test")
    rostest.rosrun("external_command", "valet_parking", ValetParkingTest)
