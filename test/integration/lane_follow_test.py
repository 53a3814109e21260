#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lane following on the demo town, with the simulated vehicle: what it does, and what it refuses."""
import math
import unittest

import rospy
import rostest

import support
from external_command.msg import CommandStatus, LaneFollowCommand, LaneSegment, PlanningCommand, Pose, RoutingResponse
from external_command.srv import LaneFollow
from vehicle import Vehicle

# On main street, eastbound: the vehicle starts near its west end.
EAST_END = Pose(x=300.0, y=195.0, heading=0.0, has_heading=True)
ACROSS_TOWN = Pose(x=460.0, y=338.0)
BEYOND = Pose(x=478.0, y=338.25)  # from where it is a long way round to any other end
NOWHERE = Pose(x=5000.0, y=5000.0)


def lane_follow(**fields):
    call = support.service("external_command/lane_follow", LaneFollow)
    return call(LaneFollowCommand(**fields))


def from_west(x, y=195.0):
    return Pose(x=x, y=y, heading=0.0, has_heading=True)


class LaneFollowTest(unittest.TestCase):
    def setUp(self):
        self.sent = support.Collector("planning/command", PlanningCommand)
        support.wait_until(self._vehicle_is_known, "a pose of the vehicle")

    def tearDown(self):
        self.sent.close()

    def _vehicle_is_known(self):
        answer = lane_follow(end_pose=EAST_END, dry_run=True)
        return answer.status.error_code != CommandStatus.NOT_READY

    def assert_refused(self, answer, error_code, *words):
        status = answer.status
        self.assertEqual(status.status, CommandStatus.ERROR, support.describe(status))
        self.assertEqual(status.error_code, error_code, support.describe(status))
        for word in words:
            self.assertIn(word, status.message)

    def wait_for_command(self, command_id):
        return self.sent.wait_for(lambda m: m.command_id == command_id, "planning command %d" % command_id)

    def test_drives_to_its_end(self):
        responses = support.Collector("routing_response", RoutingResponse)
        answer = lane_follow(end_pose=BEYOND)
        status = answer.status
        self.assertEqual(status.status, CommandStatus.RUNNING, support.describe(status))
        self.assertGreater(status.command_id, 0)
        command = self.wait_for_command(status.command_id)
        self.assertTrue(command.is_motion_command)
        self.assertTrue(command.has_lane_follow_command)
        self.assertEqual(command.command_type, PlanningCommand.NONE)
        self.assert_is_a_path(command.path.points)
        self.assertAlmostEqual(answer.report.path_length, command.path.points[-1].s, places=3)
        response = responses.wait_for(lambda m: m.header.stamp == command.header.stamp, "the routing response")
        self.assertAlmostEqual(response.distance, answer.report.route_length, places=3)
        self.assertTrue(response.road)
        support.wait_for_status(status.command_id, CommandStatus.FINISHED, deadline=60.0)

    def test_has_arrived_at_once_where_the_vehicle_stands(self):
        there = lane_follow(end_pose=BEYOND)
        support.wait_for_status(there.status.command_id, CommandStatus.FINISHED, deadline=60.0)
        x, y, heading = Vehicle().pose
        again = lane_follow(end_pose=Pose(x=x, y=y, heading=heading, has_heading=True))
        self.assertEqual(again.status.status, CommandStatus.RUNNING, support.describe(again.status))
        points = self.wait_for_command(again.status.command_id).path.points
        self.assertGreaterEqual(len(points), 2)
        for before, after in zip(points, points[1:]):
            self.assertGreater(math.hypot(after.x - before.x, after.y - before.y), 0.005)
        support.wait_for_status(again.status.command_id, CommandStatus.FINISHED, deadline=60.0)

    def assert_is_a_path(self, points):
        self.assertGreater(len(points), 2)
        for before, after in zip(points, points[1:]):
            step = math.hypot(after.x - before.x, after.y - before.y)
            self.assertLess(step, 0.6)
            self.assertGreaterEqual(after.s, before.s)
            self.assertLess(abs(after.kappa), 0.25)
        self.assertEqual(points[-1].speed, 0.0)

    def test_passes_its_way_points_in_order(self):
        way = [from_west(100.0), from_west(180.0), Pose(x=380.0, y=250.0)]
        answer = lane_follow(is_start_pose_set=True, way_point=way, end_pose=ACROSS_TOWN, dry_run=True)
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
        along = 0
        for pose in way:
            distances = [math.hypot(p.x - pose.x, p.y - pose.y) for p in answer.path.points[along:]]
            nearest = min(range(len(distances)), key=distances.__getitem__)
            self.assertLess(distances[nearest], 4.0)
            along += nearest

    def test_a_dry_run_plans_and_sends_nothing(self):
        answer = lane_follow(end_pose=EAST_END, dry_run=True)
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
        self.assert_is_a_path(answer.path.points)
        self.assertTrue(answer.report.lane_ids)
        real = lane_follow(end_pose=EAST_END).status.command_id
        self.wait_for_command(real)
        self.assertNotIn(answer.status.command_id, [message.command_id for message in self.sent.messages])

    def test_caps_the_target_speed_and_says_so(self):
        answer = lane_follow(end_pose=EAST_END, target_speed=99.0, dry_run=True)
        self.assertTrue(any("max_speed" in warning for warning in answer.report.warnings), answer.report.warnings)
        slow = lane_follow(end_pose=EAST_END, target_speed=2.0, dry_run=True)
        self.assertLessEqual(max(point.speed for point in slow.path.points), 2.0)

    def test_refuses_bad_requests_and_leaves_the_running_command_alone(self):
        running = lane_follow(end_pose=ACROSS_TOWN).status.command_id
        nan = float("nan")
        invalid = CommandStatus.INVALID_REQUEST
        self.assert_refused(lane_follow(end_pose=Pose(x=nan)), invalid, "end_pose.x", "finite")
        self.assert_refused(lane_follow(end_pose=EAST_END, target_speed=-1.0), invalid, "target_speed", "-1")
        self.assert_refused(lane_follow(end_pose=EAST_END, is_start_pose_set=True), invalid, "way_point")
        self.assert_refused(
            lane_follow(end_pose=EAST_END, way_point=[Pose()] * 1001), invalid, "way_point", "1001", "1000")
        self.assert_refused(
            lane_follow(end_pose=EAST_END, blacklisted_road=["no_such_road"]), invalid, "no_such_road")
        self.assert_refused(
            lane_follow(end_pose=EAST_END, blacklisted_lane=[LaneSegment(id="no_such_lane")]), invalid, "no_such_lane")
        unknown_frame = LaneFollowCommand(end_pose=EAST_END)
        unknown_frame.header.frame_id = "no_such_frame"
        self.assert_refused(support.service("external_command/lane_follow", LaneFollow)(unknown_frame), invalid,
                            "no_such_frame")
        self.assertEqual(support.command_status(running).status, CommandStatus.RUNNING)

    def test_refuses_a_heading_that_no_lane_near_has(self):
        wrong_way = Pose(x=300.0, y=195.0, heading=math.pi / 2.0, has_heading=True)
        self.assert_refused(lane_follow(end_pose=wrong_way), CommandStatus.OFF_MAP, "end_pose")
        far = Pose(x=5000.0, y=5000.0, heading=0.0, has_heading=True)
        self.assert_refused(lane_follow(end_pose=far), CommandStatus.OFF_MAP, "end_pose", "5000")

    def test_refuses_a_goal_or_way_point_far_from_every_lane(self):
        self.assert_refused(lane_follow(), CommandStatus.OFF_MAP, "end_pose (0.00, 0.00)", "limit is 10.00 m",
                            "max_goal_distance")
        self.assert_refused(lane_follow(end_pose=NOWHERE), CommandStatus.OFF_MAP, "end_pose", "nearest lane")
        self.assert_refused(lane_follow(way_point=[NOWHERE], end_pose=EAST_END), CommandStatus.OFF_MAP, "way_point[0]")
        beside = lane_follow(end_pose=Pose(x=300.0, y=188.0), dry_run=True)
        self.assertEqual(beside.status.status, CommandStatus.FINISHED, support.describe(beside.status))

    def test_takes_the_lane_that_suits_the_route_where_several_are_near(self):
        # 0.1 m to the right of the lane straight on, where one that turns right is as near.
        start = Pose(x=203.0, y=194.65, heading=0.0, has_heading=True)
        answer = lane_follow(is_start_pose_set=True, way_point=[start], end_pose=Pose(x=280.0, y=194.75), dry_run=True)
        self.assertAlmostEqual(answer.report.route_length, 77.0, delta=0.5)

    def test_takes_a_goal_just_behind_its_start_as_reached(self):
        start = Pose(x=150.0, y=194.75, heading=0.0, has_heading=True)
        for behind in [0.001, 0.5]:
            answer = lane_follow(is_start_pose_set=True, way_point=[start], end_pose=Pose(x=150.0 - behind, y=194.75),
                                 dry_run=True)
            self.assertEqual(answer.report.route_length, 0.0)

    def test_black_lists_bind(self):
        way = [from_west(100.0)]
        fields = dict(is_start_pose_set=True, way_point=way, end_pose=EAST_END, dry_run=True)
        free = lane_follow(**fields)
        around = lane_follow(blacklisted_road=["main_2"], **dict(fields, end_pose=ACROSS_TOWN))
        self.assertFalse(any(lane.startswith("main_2") for lane in around.report.lane_ids), around.report.lane_ids)
        last = free.report.lane_ids[-1]
        self.assert_refused(lane_follow(blacklisted_road=["main_2"], **fields), CommandStatus.NO_ROUTE, "black")
        self.assertIn("main_2", last)

    def test_answers_a_retry_without_carrying_it_out_twice(self):
        first = lane_follow(command_id=4711, end_pose=ACROSS_TOWN)
        again = lane_follow(command_id=4711, end_pose=ACROSS_TOWN)
        self.assertEqual(first.status.command_id, 4711)
        self.assertEqual(again.status.status, CommandStatus.RUNNING, support.describe(again.status))
        other = lane_follow(command_id=4711, end_pose=EAST_END)
        self.assert_refused(other, CommandStatus.DUPLICATE_ID, "4711")
        after = lane_follow(end_pose=ACROSS_TOWN).status.command_id
        self.wait_for_command(after)
        self.assertEqual([m.command_id for m in self.sent.messages].count(4711), 1)

    def test_an_id_may_be_used_again_once_its_command_has_ended(self):
        lane_follow(command_id=17, end_pose=ACROSS_TOWN)
        lane_follow(end_pose=EAST_END)
        self.assertEqual(support.command_status(17).error_code, CommandStatus.SUPERSEDED)
        again = lane_follow(command_id=17, end_pose=ACROSS_TOWN)
        self.assertEqual(again.status.status, CommandStatus.RUNNING, support.describe(again.status))

    def test_a_newer_command_supersedes_the_running_one(self):
        first = lane_follow(end_pose=ACROSS_TOWN).status.command_id
        second = lane_follow(end_pose=EAST_END).status.command_id
        status = support.wait_for_status(first, CommandStatus.ERROR)
        self.assertEqual(status.error_code, CommandStatus.SUPERSEDED)
        self.assertIn(str(second), status.message)
        self.assertEqual(support.command_status(second).status, CommandStatus.RUNNING)

    def test_statuses_of_old_commands_stay_available(self):
        refused = lane_follow(command_id=99, end_pose=Pose(x=float("inf")))
        for _ in range(50):
            lane_follow(end_pose=EAST_END, dry_run=True)
        self.assertEqual(support.command_status(99).message, refused.status.message)

    def test_an_id_never_seen_is_unknown(self):
        status = support.command_status(123456789)
        self.assertEqual(status.status, CommandStatus.UNKNOWN)
        self.assertEqual(status.error_code, CommandStatus.UNKNOWN_ID)

    def test_publishes_every_change_of_a_status(self):
        statuses = support.Collector("external_command/status", CommandStatus)
        command_id = lane_follow(end_pose=EAST_END).status.command_id
        statuses.wait_for(lambda m: m.command_id == command_id and m.message == "sent", "status 'sent'")
        lane_follow(end_pose=ACROSS_TOWN)
        statuses.wait_for(
            lambda m: m.command_id == command_id and m.error_code == CommandStatus.SUPERSEDED, "status 'superseded'")


if __name__ == "__main__":
    rospy.init_node("lane_follow_test")
    rostest.rosrun("external_command", "lane_follow", LaneFollowTest)
