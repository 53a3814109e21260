#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the map knows, as a program sees it that has no map: it can choose what to command."""
import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point

import support
from external_command.msg import CommandStatus, LaneFollowCommand, MapObject, Pose
from external_command.srv import FindMapObjects, FindMapObjectsRequest, LaneFollow

EVERYTHING = 10000


def find(ns="apollo", **fields):
    return support.service("/%s/external_command/map_objects" % ns, FindMapObjects)(FindMapObjectsRequest(**fields))


def ids(answer):
    return [item.id for item in answer.objects]


class MapObjectsTest(unittest.TestCase):
    def assert_refused(self, answer, error_code, *words):
        self.assertEqual(answer.error_code, error_code, answer.error_message)
        self.assertEqual((answer.objects, answer.total_count), ([], 0))
        for word in words:
            self.assertIn(word, answer.error_message)

    def test_lists_all_of_a_kind_and_no_more_than_is_asked_for(self):
        spaces = find(kind=MapObject.PARKING_SPACE, max_count=EVERYTHING)
        self.assertEqual((len(spaces.objects), spaces.total_count, spaces.error_code), (132, 132, CommandStatus.OK))
        self.assertEqual(ids(spaces), sorted(ids(spaces)))
        self.assertIn("n_out_5", ids(spaces))
        usual = find(kind=MapObject.PARKING_SPACE)
        self.assertEqual((ids(usual), usual.total_count), (ids(spaces)[:100], 132))
        everything = find(max_count=EVERYTHING)
        self.assertEqual({item.kind for item in everything.objects},
                         {MapObject.LANE, MapObject.ROAD, MapObject.PARKING_SPACE, MapObject.AREA})
        self.assertEqual(len(everything.objects), everything.total_count)

    def test_tells_of_a_space_what_it_takes_to_show_and_to_command_it(self):
        space = find(kind=MapObject.PARKING_SPACE, id="n_out_5").objects[0]
        self.assertEqual(len(space.outline), 4)
        self.assertGreater(space.length, space.width)
        self.assertGreater(space.width, 2.0)
        self.assertTrue(space.pose.has_heading)
        self.assertTrue(space.lane_ids)
        for lane_id in space.lane_ids:
            self.assertEqual(ids(find(kind=MapObject.LANE, id=lane_id)), [lane_id])

    def test_finds_what_is_near_a_point_the_nearest_first(self):
        point = Point(300.0, 195.0, 0.0)
        answer = find(is_near=True, point=point, radius=30.0, max_count=EVERYTHING)
        distances = [item.distance for item in answer.objects]
        self.assertTrue(distances)
        self.assertEqual(distances, sorted(distances))
        self.assertLessEqual(distances[-1], 30.0)
        lane = find(kind=MapObject.LANE, is_near=True, point=point, max_count=1).objects[0]
        away = math.hypot(lane.pose.x - point.x, lane.pose.y - point.y)
        self.assertAlmostEqual(lane.distance, away, delta=1e-6)

    def test_a_lane_that_was_found_can_be_driven_to(self):
        lane = find(kind=MapObject.LANE, is_near=True, point=Point(300.0, 195.0, 0.0), max_count=1).objects[0]
        command = LaneFollowCommand(is_start_pose_set=True, way_point=[Pose(x=100.0, y=195.0)], end_pose=lane.pose,
                                    dry_run=True)
        response = support.service("/apollo/external_command/lane_follow", LaneFollow)(command)
        self.assertEqual(response.status.status, CommandStatus.FINISHED, support.describe(response.status))
        self.assertEqual(response.report.lane_ids[-1], lane.id)

    def test_refuses_what_the_map_does_not_have_and_names_what_is_like_it(self):
        self.assert_refused(find(kind=MapObject.PARKING_SPACE, id="n_out_55"), CommandStatus.UNKNOWN_ID, "n_out_5")
        self.assert_refused(find(id="yrad"), CommandStatus.UNKNOWN_ID, "'yard'")
        self.assert_refused(find(kind=9), CommandStatus.INVALID_REQUEST, "kind is 9", "AREA (4)")
        self.assert_refused(find(is_near=True, point=Point(math.nan, 0.0, 0.0)), CommandStatus.INVALID_REQUEST, "point")
        self.assert_refused(find(is_near=True, radius=-1.0), CommandStatus.INVALID_REQUEST, "radius is -1")
        self.assert_refused(find(id="x" * 2000), CommandStatus.INVALID_REQUEST, "id")

    def test_says_in_the_words_of_a_command_that_there_is_no_map(self):
        command = LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0))
        refused = support.service("/without_map/external_command/lane_follow", LaneFollow)(command).status
        self.assertEqual(refused.error_code, CommandStatus.NOT_READY, support.describe(refused))
        self.assert_refused(find("without_map"), CommandStatus.NOT_READY, refused.message)


if __name__ == "__main__":
    rospy.init_node("map_objects_test")
    rostest.rosrun("external_command", "map_objects", MapObjectsTest)
