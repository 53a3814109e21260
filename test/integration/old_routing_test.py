#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The adapter for legacy routing requests: what becomes of them, and that each refusal is answered."""
import math
import os
import re
import sys
import types

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Point, PoseStamped, Quaternion

import support
from external_command.msg import (CommandStatus, DeadEndInfo, LaneFollowCommand, LaneSegment, LaneWaypoint,
                                  ParkingInfo, PlanningCommand, Pose, RoutingRequest, RoutingResponse)
from external_command.srv import LaneFollow

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "support"))
import document_tables as document  # noqa: E402  (of this package's sources)

SPACE = "n_out_10"
FAR_AWAY = Point(460.0, 338.0, 0.0)
EAST_END = Point(300.0, 195.0, 0.0)
NOWHERE = Point(5000.0, 5000.0, 0.0)


def publisher(topic, message_type):
    """A publisher that somebody listens to."""
    made = rospy.Publisher(topic, message_type, queue_size=100)
    support.wait_until(lambda: made.get_num_connections() > 0, "a subscriber of " + topic)
    return made


def is_vehicle_known():
    call = support.service("/apollo/external_command/lane_follow", LaneFollow)
    command = LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True)
    return call(command).status.error_code != CommandStatus.NOT_READY


def by_pose(point, **fields):
    return LaneWaypoint(pose=point, **fields)


class OldRoutingTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.requests = publisher("/apollo/routing_request", RoutingRequest)
        cls.goals = publisher("/move_base_simple/goal", PoseStamped)
        support.wait_until(is_vehicle_known, "a pose of the vehicle")

    def setUp(self):
        self.sent = support.Collector("/apollo/planning_command_history", PlanningCommand)
        self.responses = support.Collector("/apollo/routing_response", RoutingResponse)

    def tearDown(self):
        self.sent.close()
        self.responses.close()

    def test_what_a_command_is_warned_of_is_in_the_log(self):
        log = support.log_of("/apollo/external_command")
        self.planned(is_start_pose_set=True, waypoint=[by_pose(EAST_END), by_pose(FAR_AWAY)])
        line = log.wait_for(lambda m: "the path begins at (300.00, 194.75" in m.msg, "the warning").msg
        self.assertIn("is_start_pose_set", line)
        log.close()

    def planned(self, **fields):
        """The planning command that the request becomes."""
        return self._command_after(lambda: self.requests.publish(RoutingRequest(**fields)))

    def _command_after(self, send):
        before = len(self.sent.messages)
        send()
        support.wait_until(lambda: len(self.sent.messages) > before, "a planning command")
        return self.sent.messages[-1]

    def refused(self, error_code, *words, **fields):
        """The routing response that says so."""
        return self._refused(self.requests, RoutingRequest(**fields), error_code, *words)

    def _refused(self, topic, message, error_code, *words):
        before = len(self.sent.messages)
        message.header.stamp = rospy.Time.now()
        topic.publish(message)
        response = self.responses.wait_for(
            lambda m: m.error_code != RoutingResponse.OK and m.routing_request.header.stamp == message.header.stamp,
            "a response with an error that has one of " + str(words))
        self.assertEqual(response.error_code, error_code, response.error_message)
        for word in words:
            self.assertIn(word, response.error_message)
        self.assertEqual(len(self.sent.messages), before)
        return response

    def assert_ends_at(self, command, point):
        last = command.path.points[-1]
        self.assertLess(math.hypot(last.x - point.x, last.y - point.y), 3.0)

    def last_lane(self, command):
        road = command.lane_follow_command.road[-1]
        return next(passage for passage in road.passage if passage.can_exit).segment[-1]

    def test_the_adapter_lives_in_the_process_of_the_component(self):
        self.assertIsNone(support.pid_of("/apollo/old_routing_adapter"), "it is a node of its own, with a map of its own")
        subscribers = dict(rosgraph.Master("/test").getSystemState()[1])["/apollo/routing_request"]
        self.assertEqual(subscribers, ["/apollo/external_command"])

    def test_one_way_point_is_the_end(self):
        command = self.planned(waypoint=[by_pose(EAST_END)])
        self.assert_ends_at(command, EAST_END)
        self.assertEqual(command.command_type, PlanningCommand.NONE)

    def test_the_first_of_several_way_points_is_dropped(self):
        command = self.planned(waypoint=[by_pose(NOWHERE), by_pose(FAR_AWAY), by_pose(EAST_END)])
        self.assert_ends_at(command, EAST_END)
        nearest = min(math.hypot(p.x - FAR_AWAY.x, p.y - FAR_AWAY.y) for p in command.path.points)
        self.assertLess(nearest, 4.0)

    def test_the_first_way_point_is_the_start_where_told(self):
        command = self.planned(waypoint=[by_pose(FAR_AWAY), by_pose(EAST_END)], is_start_pose_set=True)
        first = command.path.points[0]
        self.assertLess(math.hypot(first.x - FAR_AWAY.x, first.y - FAR_AWAY.y), 4.0)

    def test_a_way_point_by_lane_ends_on_that_lane(self):
        route = self.planned(waypoint=[by_pose(FAR_AWAY)]).lane_follow_command
        for segment in [passage.segment[0] for road in route.road[1:] for passage in road.passage]:
            for s in (0.0, 0.5 * segment.end_s, segment.end_s):
                command = self.planned(waypoint=[LaneWaypoint(id=segment.id, s=s)])
                end = self.last_lane(command)
                self.assertEqual(end.id, segment.id)
                self.assertLessEqual(abs(end.end_s - s), 0.51)

    def test_lane_and_pose_may_be_given_together(self):
        reference = self.planned(waypoint=[by_pose(EAST_END)])
        lane, last = self.last_lane(reference), reference.path.points[-1]
        near = Point(last.x + 0.5, last.y + 0.5, 0.0)
        for s in (lane.end_s, 0.0):
            command = self.planned(waypoint=[LaneWaypoint(id=lane.id, s=s, pose=near)])
            self.assertEqual(self.last_lane(command).id, lane.id)
            self.assert_ends_at(command, near)
        far = Point(last.x, last.y + 20.0, 0.0)
        for s in (lane.end_s, 0.0):
            self.refused(CommandStatus.INVALID_REQUEST, "waypoint[0]", lane.id, "20.00 m", "%.2f" % far.y,
                         "way_point_tolerance", waypoint=[LaneWaypoint(id=lane.id, s=s, pose=far)])
        self.refused(CommandStatus.INVALID_REQUEST, "waypoint[0]", "heading", lane.id,
                     waypoint=[LaneWaypoint(id=lane.id, s=lane.end_s, heading=last.heading + 2.0, has_heading=True)])

    def test_refuses_requests_that_make_no_command(self):
        invalid = CommandStatus.INVALID_REQUEST
        end = by_pose(EAST_END)
        lane = self.last_lane(self.planned(waypoint=[end])).id
        for words, fields in (
                (["waypoint has 0 elements"], {}),
                (["waypoint has 1 elements"], dict(waypoint=[end], is_start_pose_set=True)),
                (["waypoint[1]", "no_such_lane"], dict(waypoint=[end, LaneWaypoint(id="no_such_lane")])),
                (["waypoint[0]", "s 99999"], dict(waypoint=[LaneWaypoint(id=lane, s=99999.0)])),
                (["waypoint[0].s", "nan"], dict(waypoint=[LaneWaypoint(id=lane, s=float("nan"))])),
                (["waypoint[0].pose.x", "inf"], dict(waypoint=[by_pose(Point(float("inf"), 0.0, 0.0))])),
                (["waypoint[0]", "neither"], dict(waypoint=[LaneWaypoint()])),
                (["blacklisted_road", "no_road"], dict(waypoint=[end], blacklisted_road=["no_road"])),
                (["blacklisted_lane", "no_lane"], dict(waypoint=[end], blacklisted_lane=[LaneSegment(id="no_lane")])),
                (["parking_space_id"], dict(parking_info=ParkingInfo(parking_point=Point(134.0, 172.0, 0.0)))),
                (["P-99"], dict(parking_info=ParkingInfo(parking_space_id="P-99")))):
            with self.subTest(words):
                response = self.refused(invalid, *words, **fields)
                self.assertEqual(len(response.routing_request.waypoint), len(fields.get("waypoint", [])))

    def test_black_lists_are_carried_over(self):
        last = self.last_lane(self.planned(waypoint=[by_pose(EAST_END)])).id
        heading = dict(heading=0.0, has_heading=True)
        self.refused(CommandStatus.NO_ROUTE, "black", waypoint=[by_pose(EAST_END, **heading)],
                     blacklisted_lane=[LaneSegment(id=last)])

    def test_an_end_off_the_map_is_refused_by_the_service(self):
        self.refused(CommandStatus.OFF_MAP, "end_pose", "5000",
                     waypoint=[by_pose(NOWHERE, heading=0.0, has_heading=True)])

    def test_parking_info_becomes_valet_parking(self):
        info = ParkingInfo(parking_space_id=SPACE)
        way = [by_pose(NOWHERE), by_pose(Point(380.0, 250.0, 0.0)), by_pose(NOWHERE)]
        for waypoint, is_start_pose_set in (([], False), (way, False), ([by_pose(FAR_AWAY), by_pose(NOWHERE)], True)):
            command = self.planned(parking_info=info, waypoint=waypoint, is_start_pose_set=is_start_pose_set)
            self.assertEqual(command.command_type, PlanningCommand.PARKING)
            self.assertEqual(command.parking_command.parking_spot_id, SPACE)

    def test_dead_end_info_is_passed_over(self):
        info = DeadEndInfo(dead_end_routing_type=DeadEndInfo.ROUTING_IN)
        self.assert_ends_at(self.planned(waypoint=[by_pose(EAST_END)], dead_end_info=info), EAST_END)

    def test_a_goal_of_rviz_becomes_lane_follow(self):
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position = EAST_END
        goal.pose.orientation.w = 1.0
        command = self._command_after(lambda: self.goals.publish(goal))
        self.assert_ends_at(command, EAST_END)
        self.assertAlmostEqual(command.path.points[-1].heading, 0.0, places=3)
        goal.pose.orientation.z, goal.pose.orientation.w = math.sin(math.pi / 4.0), math.cos(math.pi / 4.0)
        self._refused(self.goals, goal, CommandStatus.OFF_MAP, "end_pose")

    def test_a_goal_in_the_vehicles_frame_is_transformed(self):
        goal = PoseStamped()
        goal.header.frame_id = "base_link"
        goal.pose.position.x = 60.0
        goal.pose.orientation.w = 1.0
        command = self._command_after(lambda: self.goals.publish(goal))
        first, last = command.path.points[0], command.path.points[-1]
        self.assertLess(abs(math.hypot(last.x - first.x, last.y - first.y) - 60.0), 5.0)

    def test_a_goal_in_an_unknown_frame_is_refused(self):
        goal = PoseStamped()
        goal.header.frame_id = "no_such_frame"
        self._refused(self.goals, goal, CommandStatus.INVALID_REQUEST, "no_such_frame")

    def test_a_goal_that_is_no_pose_is_refused_by_the_names_of_its_own_fields(self):
        nan = float("nan")
        for words, position, orientation in (
                (["pose.position.y is nan"], Point(300.0, nan, 0.0), Quaternion(w=1.0)),
                (["pose.orientation is (0, 0, nan, 1)", "no rotation"], EAST_END, Quaternion(z=nan, w=1.0)),
                (["pose.orientation is (0, 0, 0, 1e+200)"], EAST_END, Quaternion(w=1e200)),
                (["pose.orientation is (0, 0, 0, 1e-200)"], EAST_END, Quaternion(w=1e-200))):
            with self.subTest(words):
                goal = PoseStamped()
                goal.pose.position, goal.pose.orientation = position, orientation
                response = self._refused(self.goals, goal, CommandStatus.INVALID_REQUEST, *words)
                self.assertNotIn("waypoint", response.error_message)

    def test_a_goal_whose_orientation_nobody_filled_in_may_be_reached_with_any(self):
        goal = PoseStamped()
        goal.pose.position = EAST_END
        self.assert_ends_at(self._command_after(lambda: self.goals.publish(goal)), EAST_END)

    def test_the_two_programs_of_the_page_make_the_vehicle_drive_the_same(self):
        before, after = re.findall(r"^```python\n(.*?)^```$", document.page("old_routing.md"), re.MULTILINE | re.DOTALL)
        names = dict(globals(), rospy=types.SimpleNamespace(
            Publisher=lambda topic, message_type, queue_size: publisher(topic, message_type),
            ServiceProxy=rospy.ServiceProxy, logerr=rospy.logerr))
        paths = [self._command_after(lambda: exec(program, names)).path.points  # pylint: disable=exec-used
                 for program in (before, after)]
        self.assertEqual(names["answer"].status.error_code, CommandStatus.OK)
        self.assertLess(math.hypot(paths[0][-1].x - paths[1][-1].x, paths[0][-1].y - paths[1][-1].y), 0.6)  # one may have been reached


if __name__ == "__main__":
    rospy.init_node("old_routing_test")
    rostest.rosrun("external_command", "old_routing", OldRoutingTest)
