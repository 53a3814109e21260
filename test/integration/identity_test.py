#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ids are given by callers and come again: what belongs to one command never touches another by the same id. A command
ends by what is said of it, or by where the vehicle stands; what has ended is not driven by a planner that starts later."""
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, TransformStamped
from nav_msgs.msg import Path
from tf2_msgs.msg import TFMessage

import support
from external_command.msg import (ActionCommand, CommandStatus, LaneFollowCommand, PathFollowCommand, PlanningCommand,
                                  PlanningPad, Pose, RoutingResponse)
from external_command.srv import Action, LaneFollow, PathFollow

RUNNING, FINISHED, ERROR = CommandStatus.RUNNING, CommandStatus.FINISHED, CommandStatus.ERROR


def act(action, command_id=0):
    return support.service("external_command/action", Action)(
        ActionCommand(command=action, command_id=command_id)).status


def follow(length=30.0, command_id=0):
    """A path from (10, 0) to the east."""
    points = [Point(10.0 + x, 0.0, 0.0) for x in (0.0, 0.5 * length, length)]
    status = support.service("external_command/path_follow", PathFollow)(
        PathFollowCommand(way_point=points, command_id=command_id)).status
    assert status.status == RUNNING, support.describe(status)
    return status.command_id


class Localization:
    """Says 20 times a second where the vehicle is."""

    def __init__(self):
        self.x, self.y = 10.0, 0.0
        self._publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self._timer = rospy.Timer(rospy.Duration(0.05), self._publish)

    def _publish(self, _):
        transform = TransformStamped(child_frame_id="base_link")
        transform.header.frame_id = "map"
        transform.header.stamp = rospy.Time.now()
        transform.transform.translation.x = self.x
        transform.transform.translation.y = self.y
        transform.transform.rotation.w = 1.0
        self._publisher.publish(TFMessage(transforms=[transform]))


class IdentityTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Localization()
        cls.reports = rospy.Publisher("planning/command_status", CommandStatus, queue_size=100)
        support.service("external_command/command_status", support.GetCommandStatus)
        support.wait_until(lambda: cls.reports.get_num_connections() > 0, "somebody listens to the planner")

    def setUp(self):
        self.vehicle.x, self.vehicle.y = 10.0, 0.0
        act(ActionCommand.CLEAR_PLANNING)

    def report(self, command_id, status, message="", stamp=None):
        message = CommandStatus(command_id=command_id, status=status, message=message)
        message.header.stamp = stamp or rospy.Time.now()
        self.reports.publish(message)

    def finish(self, command_id):
        self.report(command_id, FINISHED)
        support.wait_for_status(command_id, FINISHED)

    def assert_latched(self, topic, message_type, is_right, what):
        """What a program gets that subscribes now."""
        late = support.Collector(topic, message_type)
        try:
            late.wait_for(is_right, what)
            self.assertTrue(is_right(late.messages[-1]), what)
        finally:
            late.close()

    def assert_withdrawn(self, command_id):
        self.assert_latched("planning/command", PlanningCommand,
                            lambda m: m.command_id == command_id and not m.is_motion_command,
                            "command %d is not to be driven" % command_id)
        self.assert_latched("external_command/path", Path, lambda m: not m.poses, "no path")
        self.assert_latched("routing_response", RoutingResponse, lambda m: not m.road, "no route")

    def test_clear_planning_under_the_id_of_an_ended_motion_command_is_what_it_says(self):
        self.finish(follow(command_id=5))
        action = act(ActionCommand.CLEAR_PLANNING, command_id=5)
        self.assertEqual(action.status, FINISHED)
        self.assertEqual(support.command_status(action.command_id).status, FINISHED)

    def test_clear_planning_leaves_an_action_that_has_the_id_of_the_ended_motion_command(self):
        self.finish(follow(command_id=6))
        action = act(ActionCommand.CHANGE_LEFT, command_id=6)
        self.assertEqual(action.status, RUNNING)
        act(ActionCommand.CLEAR_PLANNING)
        follow()
        self.assertEqual(support.command_status(6).status, RUNNING, "it is no motion command")

    def test_a_reused_motion_id_means_the_newer_command(self):
        self.finish(follow(command_id=7))
        follow(length=40.0, command_id=7)
        self.assertEqual(support.command_status(7).status, RUNNING)
        other = follow()
        status = support.command_status(7)
        self.assertEqual(status.error_code, CommandStatus.SUPERSEDED, support.describe(status))
        self.assertIn(str(other), status.message)
        follow(length=50.0, command_id=7)
        self.assertEqual(support.command_status(7).status, RUNNING)
        self.assertEqual(support.command_status(other).error_code, CommandStatus.SUPERSEDED)

    def test_a_retry_is_not_sent_twice_but_a_stop_is(self):
        pads = support.Collector("planning/pad", PlanningPad)
        commands = support.Collector("planning_command_history", PlanningCommand)
        follow(command_id=8)
        follow(command_id=8)
        first = act(ActionCommand.STOP, command_id=9)
        again = act(ActionCommand.STOP, command_id=9)
        on_motion = act(ActionCommand.STOP, command_id=8)
        self.assertEqual(first.command_id, 9)
        for status in (again, on_motion):
            self.assertEqual(status.status, RUNNING, support.describe(status))
            self.assertNotIn(status.command_id, (8, 9))
            self.assertIn("still running", status.message)
        support.wait_until(lambda: [pad.action for pad in pads.messages].count(PlanningPad.STOP) == 3, "three stops")
        self.assertEqual(len(commands.messages), 1)
        self.assertEqual(support.command_status(8).status, RUNNING)
        pads.close()
        commands.close()

    def test_a_motion_command_supersedes_the_stop_before_it(self):
        for action in (ActionCommand.STOP, ActionCommand.PULL_OVER):
            held = act(action).command_id
            motion = follow()
            status = support.wait_for_status(held, ERROR)
            self.assertEqual(status.error_code, CommandStatus.SUPERSEDED, support.describe(status))
            self.assertIn(str(motion), status.message)

    def test_a_running_command_is_never_forgotten(self):
        motion = follow()
        call = rospy.ServiceProxy("external_command/action", Action, persistent=True)
        for _ in range(2500):
            call(ActionCommand(command=ActionCommand.FOLLOW))
        self.assertEqual(support.command_status(motion).status, RUNNING)
        self.finish(motion)

    def test_a_report_without_a_status_ends_nothing(self):
        motion = follow()
        for status in (0, 4, 77):
            self.report(motion, status, "odd")
        self.report(motion, RUNNING, "on its way")
        support.wait_until(lambda: support.command_status(motion).message == "on its way", "the report counts")
        self.assertEqual(support.command_status(motion).status, RUNNING)
        self.finish(motion)

    def test_a_report_from_a_clock_that_is_a_little_behind_counts_and_an_older_one_does_not(self):
        motion = follow()
        self.report(motion, ERROR, "an earlier run's", rospy.Time.now() - rospy.Duration(20.0))
        self.report(motion, FINISHED, "arrived", rospy.Time.now() - rospy.Duration(0.3))
        status = support.wait_for_status(motion, FINISHED)
        self.assertEqual(status.message, "arrived")

    def test_what_is_stopped_cleared_or_ended_is_not_driven_by_a_planner_that_starts_later(self):
        motion = follow()
        self.assert_latched("planning/command", PlanningCommand, lambda m: m.command_id == motion and
                            m.is_motion_command, "the command is there while it runs")
        act(ActionCommand.STOP)
        self.assert_withdrawn(motion)
        act(ActionCommand.START)
        self.assert_latched("external_command/path", Path, lambda m: m.poses, "the path is back")
        act(ActionCommand.CLEAR_PLANNING)
        self.assert_withdrawn(motion)
        motion = follow()
        self.finish(motion)
        self.assert_withdrawn(motion)
        motion = follow()
        self.report(motion, ERROR, "a wall")
        support.wait_for_status(motion, ERROR)
        self.assert_withdrawn(motion)

    def test_the_route_is_cleared_with_the_command(self):
        self.vehicle.x, self.vehicle.y = 90.0, 194.75
        command = LaneFollowCommand(end_pose=Pose(x=150.0, y=194.75))
        call = support.service("external_command/lane_follow", LaneFollow)
        support.wait_until(lambda: call(command).status.status == RUNNING, "the vehicle is seen on the lane")
        self.assert_latched("routing_response", RoutingResponse, lambda m: m.road, "a route")
        act(ActionCommand.CLEAR_PLANNING)
        self.assert_latched("routing_response", RoutingResponse, lambda m: not m.road, "no route")

    def test_a_vehicle_that_stands_at_the_end_has_arrived_though_no_planner_says_so(self):
        motion = follow(length=30.0)
        for x in range(10, 41):
            self.vehicle.x = float(x)
            rospy.sleep(0.06)  # as a vehicle drives, seen at each place
        status = support.wait_for_status(motion, FINISHED)
        self.assertIn("pose", status.message)

    def test_a_vehicle_at_the_end_of_a_lap_that_it_has_not_driven_has_not_arrived(self):
        lap = [Point(10.0, 0.0, 0.0), Point(40.0, 0.0, 0.0), Point(40.0, 30.0, 0.0), Point(10.0, 30.0, 0.0),
               Point(10.0, 0.0, 0.0)]
        status = support.service("external_command/path_follow", PathFollow)(PathFollowCommand(way_point=lap)).status
        support.wait_until(lambda: "nothing was reported" in support.command_status(status.command_id).message,
                           "the silence is noted")
        self.assertEqual(support.command_status(status.command_id).status, RUNNING)


if __name__ == "__main__":
    rospy.init_node("identity_test")
    rostest.rosrun("external_command", "identity", IdentityTest)
