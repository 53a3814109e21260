#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The adapter for programs that know move_base, as those see it."""
import math
import unittest

import actionlib
import roslib.message
import rospy
import rostest
import rostopic
from actionlib_msgs.msg import GoalStatus, GoalStatusArray
from geometry_msgs.msg import PoseStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseActionFeedback, MoveBaseActionResult, MoveBaseGoal
from nav_msgs.srv import GetPlan

import support
from external_command import msg
from external_command.srv import Action, LaneFollow
from goals import ACTIONS, name_of
from vehicle import Vehicle

START = (90.0, 194.75)
NEAR = 3.0  # of the lane's end point to a goal beside it [m]


def pose(x, y, heading=0.0, frame="map"):
    stamped = PoseStamped()
    stamped.header.frame_id = frame
    stamped.pose.position.x, stamped.pose.position.y = x, y
    stamped.pose.orientation.z, stamped.pose.orientation.w = math.sin(heading / 2.0), math.cos(heading / 2.0)
    return stamped


def position(stamped):
    return stamped.pose.position.x, stamped.pose.position.y


class MoveBaseTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()
        cls.act = support.service("external_command/action", Action)
        support.wait_until(lambda: cls.act(msg.ActionCommand(command=msg.ActionCommand.SWITCH_TO_AUTO)).status.error_code
                           != msg.CommandStatus.NOT_READY, "the chassis is heard")
        cls.client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        assert cls.client.wait_for_server(rospy.Duration(support.DEADLINE)), "there is no action move_base"

    def setUp(self):
        self.vehicle.place(*START)
        self.sent = support.Collector("planning_command_history", msg.PlanningCommand)
        self.states = support.Collector("move_base/status", GoalStatusArray)

    def tearDown(self):
        self.client.stop_tracking_goal()
        self.act(msg.ActionCommand(command=msg.ActionCommand.CLEAR_PLANNING))
        self.vehicle.wait_until_standing()
        self.sent.close()
        self.states.close()

    def do(self, goal, client=None):
        client = client or self.client
        client.send_goal(MoveBaseGoal(goal))
        self.assertTrue(client.wait_for_result(rospy.Duration(support.DEADLINE)), name_of(client.get_state()))
        return client.get_state(), client.get_goal_status_text()

    def assert_aborted(self, goal, *words):
        state, text = self.do(goal)
        self.assertEqual(state, GoalStatus.ABORTED, text)
        for word in words:
            self.assertIn(word, text)

    def drive(self, x=300.0, y=195.0):
        """The goal's id, the vehicle under way to it."""
        known = {s.goal_id.id for message in self.states.messages for s in message.status_list}
        self.client.send_goal(MoveBaseGoal(pose(x, y)))
        self.vehicle.wait_until_moving()
        message = self.states.wait_for(lambda m: {s.goal_id.id for s in m.status_list} - known, "the goal is listed")
        return next(s.goal_id.id for s in message.status_list if s.goal_id.id not in known)

    def wait_for_state(self, goal_id, state):
        self.states.wait_for(lambda m: any(s.goal_id.id == goal_id and s.status == state for s in m.status_list),
                             "goal %s is %s" % (goal_id, name_of(state)))

    def test_a_goal_is_reached_and_the_position_told_on_the_way(self):
        feedback = []
        self.client.send_goal(MoveBaseGoal(pose(130.0, 195.0)), feedback_cb=feedback.append)
        self.assertTrue(self.client.wait_for_result(rospy.Duration(2 * support.DEADLINE)))
        self.assertEqual((self.client.get_state(), self.client.get_goal_status_text()),
                         (GoalStatus.SUCCEEDED, "Goal reached."))
        self.assertLess(math.dist(self.vehicle.pose[:2], (130.0, 195.0)), NEAR)
        self.assertEqual({f.base_position.header.frame_id for f in feedback}, {"map"})
        xs = [f.base_position.pose.position.x for f in feedback]
        self.assertGreater(len(xs), 5)
        self.assertEqual(xs, sorted(xs))
        self.assertLess(xs[0], 110.0)
        self.assertGreater(xs[-1], 120.0)

    def test_a_goal_in_the_vehicles_frame_is_driven_to(self):
        self.client.send_goal(MoveBaseGoal(pose(40.0, 0.0, frame="base_link")))
        support.wait_until(lambda: self.sent.messages, "a command")
        last = self.sent.messages[0].path.points[-1]
        self.assertLess(math.dist((last.x, last.y), (START[0] + 40.0, START[1])), NEAR)

    def test_goals_that_cannot_be_driven_are_aborted_with_the_reason(self):
        self.assert_aborted(pose(5000.0, 5000.0), "end_pose", "5000")
        self.assert_aborted(pose(130.0, 195.0, frame="no_such_frame"), "target_pose.header.frame_id 'no_such_frame'")
        self.assert_aborted(pose(130.0, float("nan")), "target_pose.pose.position.y", "nan")
        self.assert_aborted(pose(130.0, 195.0, heading=math.pi), "end_pose")
        tilted, empty = pose(130.0, 195.0), pose(130.0, 195.0)
        tilted.pose.orientation.x = 0.5
        empty.pose.orientation.w = 0.0
        self.assert_aborted(tilted, "target_pose.pose.orientation", "vertical")
        self.assert_aborted(empty, "target_pose.pose.orientation", "no rotation")
        self.assertEqual(self.sent.messages, [])

    def test_a_cancel_stops_the_vehicle(self):
        goal_id = self.drive()
        self.client.cancel_goal()
        self.assertTrue(self.client.wait_for_result(rospy.Duration(support.DEADLINE)))
        self.assertEqual(self.client.get_state(), GoalStatus.PREEMPTED)
        self.wait_for_state(goal_id, GoalStatus.PREEMPTED)
        self.vehicle.wait_until_standing()

    def test_a_newer_goal_takes_the_place_of_the_older_and_the_vehicle_drives_on(self):
        older = self.drive()
        support.wait_until(lambda: self.vehicle.speed > 3.0, "the vehicle is fast")
        newer = self.drive(x=320.0)
        self.wait_for_state(older, GoalStatus.PREEMPTED)
        self.wait_for_state(newer, GoalStatus.ACTIVE)
        self.assertGreater(self.vehicle.speed, 2.0)
        self.assertEqual(len(self.sent.messages), 2)

    def test_a_newer_goal_that_cannot_be_driven_stops_the_vehicle(self):
        older = self.drive()
        self.assert_aborted(pose(5000.0, 5000.0), "5000")
        self.wait_for_state(older, GoalStatus.PREEMPTED)
        self.vehicle.wait_until_standing()

    def test_of_many_goals_in_a_row_the_last_is_driven(self):
        results = support.Collector("move_base/result", MoveBaseActionResult)
        for i in range(20):
            self.client.send_goal(MoveBaseGoal(pose(200.0 + i, 195.0)))
        support.wait_until(lambda: len(results.messages) == 19, "all but the last have ended")
        self.assertEqual({m.status.status for m in results.messages}, {GoalStatus.PREEMPTED})
        support.wait_until(lambda: self.sent.messages and
                           abs(self.sent.messages[-1].path.points[-1].x - 219.0) < NEAR, "the last is sent")
        results.close()

    def test_another_command_preempts_a_goal(self):
        self.drive()
        status = support.service("external_command/lane_follow", LaneFollow)(
            msg.LaneFollowCommand(end_pose=msg.Pose(x=320.0, y=195.0))).status
        self.assertEqual(status.status, msg.CommandStatus.RUNNING, support.describe(status))
        self.assertTrue(self.client.wait_for_result(rospy.Duration(support.DEADLINE)))
        self.assertEqual(self.client.get_state(), GoalStatus.PREEMPTED)
        self.assertEqual(support.command_status(status.command_id).status, msg.CommandStatus.RUNNING)

    def test_a_stop_holds_the_vehicle_and_a_start_lets_it_go_on(self):
        goal_id = self.drive()
        self.act(msg.ActionCommand(command=msg.ActionCommand.STOP))
        self.vehicle.wait_until_standing()
        self.act(msg.ActionCommand(command=msg.ActionCommand.START))
        self.vehicle.wait_until_moving()
        self.wait_for_state(goal_id, GoalStatus.ACTIVE)
        self.assertEqual(self.client.get_state(), GoalStatus.ACTIVE)

    def test_a_goal_without_a_client_is_driven_to(self):
        feedback = support.Collector("move_base/feedback", MoveBaseActionFeedback)
        goals = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
        support.wait_until(lambda: goals.get_num_connections() > 0, "somebody takes goals")
        goals.publish(pose(300.0, 195.0))
        self.vehicle.wait_until_moving()
        support.wait_until(lambda: feedback.messages, "feedback")
        goals.unregister()
        feedback.close()

    def test_a_plan_is_made_and_nothing_sent(self):
        plan = support.service("move_base/make_plan", GetPlan)
        path = plan(goal=pose(300.0, 195.0)).plan
        self.assertEqual(path.header.frame_id, "map")
        self.assertLess(math.dist(position(path.poses[0]), self.vehicle.pose[:2]), NEAR)
        self.assertLess(math.dist(position(path.poses[-1]), (300.0, 195.0)), NEAR)
        other = plan(start=pose(120.0, 195.0), goal=pose(300.0, 195.0)).plan
        self.assertLess(math.dist(position(other.poses[0]), (120.0, 195.0)), NEAR)
        for nowhere in (pose(5000.0, 5000.0), pose(300.0, 195.0, frame="no_such_frame"), pose(float("inf"), 0.0)):
            self.assertEqual(plan(goal=nowhere).plan.poses, [])
        self.assertEqual(self.sent.messages, [])

    def test_a_plan_ends_within_the_tolerance(self):
        plan = support.service("move_base/make_plan", GetPlan)
        beside = pose(200.0, 203.0)  # 8 m off the lane
        self.assertEqual(plan(goal=beside, tolerance=0.0).plan.poses, [])
        self.assertEqual(plan(goal=beside, tolerance=2.0).plan.poses, [])
        path = plan(goal=beside, tolerance=12.0).plan
        self.assertLessEqual(math.dist(position(path.poses[-1]), (200.0, 203.0)), 12.01)
        self.assertEqual(plan(goal=beside, tolerance=float("nan")).plan.poses, [])

    def test_a_free_space_goal_is_parked_at(self):
        parker = actionlib.SimpleActionClient("park_base", MoveBaseAction)
        self.assertTrue(parker.wait_for_server(rospy.Duration(support.DEADLINE)))
        goal = pose(START[0] + 20.0, START[1] + 3.0)
        plan = support.service("park_base/make_plan", GetPlan)
        self.assertLess(math.dist(position(plan(goal=goal).plan.poses[-1]), position(goal)), 0.1)
        self.assertEqual(plan(start=pose(80.0, 195.0), goal=goal).plan.poses, [])
        self.assertEqual(self.do(goal, parker)[0], GoalStatus.SUCCEEDED)
        self.assertLess(math.dist(self.vehicle.pose[:2], position(goal)), 0.6)

    def test_what_a_goal_is_warned_of_is_in_the_log(self):
        log = support.log_of("/apollo/external_command")
        parker = actionlib.SimpleActionClient("park_base", MoveBaseAction)
        self.assertTrue(parker.wait_for_server(rospy.Duration(support.DEADLINE)))
        parker.send_goal(MoveBaseGoal(pose(START[0] + 20.0, START[1] + 3.0)))
        line = log.wait_for(lambda m: "goal of %s became command" % rospy.get_name() in m.msg, "the warning").msg
        self.assertIn("goal_distance_warning", line)
        parker.cancel_goal()
        log.close()

    def test_clients_that_find_out_the_type_by_the_topic_can_send_goals(self):
        """As axclient.py does."""
        names = dict({"external_command/" + name: action for name, action in ACTIONS.items()}, move_base=MoveBaseAction)
        for name, action in names.items():
            found = rostopic.get_topic_type(rospy.resolve_name(name + "/goal"))[0]
            self.assertIs(roslib.message.get_message_class(found[:-len("Goal")]), action)


if __name__ == "__main__":
    rospy.init_node("move_base_test")
    rostest.rosrun("external_command", "move_base", MoveBaseTest)
