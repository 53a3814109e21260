#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The motion commands as actions, for clients as they are usual."""
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

import support
from external_command import msg
from external_command.srv import Action, GetCommandStatus, PathFollow
from goals import ACTIONS, BareClient, Client, large_zone, name_of
from vehicle import Vehicle

EAST = msg.Pose(x=300.0, y=195.0)
NOWHERE = msg.Pose(x=5000.0, y=5000.0)


class ActionsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()
        cls.act = support.service("external_command/action", Action)
        support.wait_until(lambda: cls.act(msg.ActionCommand(command=msg.ActionCommand.SWITCH_TO_AUTO)).status.error_code
                           != msg.CommandStatus.NOT_READY, "the chassis is heard")

    def setUp(self):
        self.vehicle.place(90.0, 194.75)
        self.sent = support.Collector("planning_command_history", msg.PlanningCommand)

    def tearDown(self):
        self.sent.close()
        self.act(msg.ActionCommand(command=msg.ActionCommand.CLEAR_PLANNING))
        self.vehicle.wait_until_standing()

    def assert_ends(self, end, state, status, error_code=msg.CommandStatus.OK):
        """`end`: of a client. Returns the result."""
        result = end[1]
        seen = "%s, %s" % (name_of(end[0]), support.describe(result.status))
        self.assertEqual(end[0], state, seen)
        self.assertEqual(result.status.status, status, seen)
        self.assertEqual(result.status.error_code, error_code, seen)
        return result

    def assert_cancelled(self, end, state=GoalStatus.PREEMPTED):
        return self.assert_ends(end, state, msg.CommandStatus.ERROR, msg.CommandStatus.CANCELLED)

    def straight(self, length, **fields):
        return msg.PathFollowCommand(way_point=self.vehicle.ahead((0.0, 0.0), (length, 0.0)), **fields)

    def wait_until_sent(self, command_id):
        self.sent.wait_for(lambda m: m.command_id == command_id, "command %d is sent" % command_id)

    def test_each_motion_service_has_its_action(self):
        for name in ACTIONS:
            Client(name)

    def test_a_dry_run_succeeds_with_its_report_and_sends_nothing(self):
        result = self.assert_ends(Client("lane_follow").do(msg.LaneFollowCommand(end_pose=EAST, dry_run=True)),
                                  GoalStatus.SUCCEEDED, msg.CommandStatus.FINISHED)
        self.assertGreater(result.report.path_length, 100.0)
        self.assertTrue(result.report.lane_ids)
        self.assertEqual(self.sent.messages, [])

    def test_what_is_driven_succeeds_at_its_end_and_tells_on_the_way_how_far_it_has_come(self):
        client = Client("path_follow")
        client.send(self.straight(60.0))
        self.assertTrue(client.was_active.wait(support.DEADLINE))
        result = self.assert_ends(client.end(), GoalStatus.SUCCEEDED, msg.CommandStatus.FINISHED)
        self.assertAlmostEqual(result.report.path_length, 60.0, delta=2.0)
        self.assertEqual({status.command_id for _, status in client.feedback}, {result.status.command_id})
        self.assertEqual({status.status for _, status in client.feedback}, {msg.CommandStatus.RUNNING})
        driven = [status.share_done for _, status in client.feedback if status.has_progress]
        self.assertGreater(len(driven), 5)
        self.assertEqual(driven, sorted(driven))
        self.assertGreater(driven[-1], 0.5)
        took = client.feedback[-1][0] - client.feedback[0][0]
        self.assertGreaterEqual(len(client.feedback) / took, 2.0)

    def test_what_is_no_valid_request_is_rejected(self):
        path = self.straight(60.0, target_speed=-1.0)
        result = self.assert_ends(Client("path_follow").do(path), GoalStatus.REJECTED, msg.CommandStatus.ERROR,
                                  msg.CommandStatus.INVALID_REQUEST)
        self.assertIn("target_speed", result.status.message)
        self.assertEqual(self.sent.messages, [])

    def test_what_cannot_be_planned_is_aborted_and_leaves_the_running_command_alone(self):
        running = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        self.assert_ends(Client("lane_follow").do(msg.LaneFollowCommand(end_pose=NOWHERE)), GoalStatus.ABORTED,
                         msg.CommandStatus.ERROR, msg.CommandStatus.OFF_MAP)
        self.assertEqual(support.command_status(running).status, msg.CommandStatus.RUNNING)

    def test_a_cancel_ends_what_is_driven(self):
        client = Client("path_follow")
        client.send(self.straight(500.0))
        self.vehicle.wait_until_moving()
        client.cancel()
        result = self.assert_cancelled(client.end())
        self.vehicle.wait_until_standing()
        self.assertEqual(support.command_status(result.status.command_id).error_code, msg.CommandStatus.CANCELLED)

    def test_a_cancel_ends_what_is_planned_and_nothing_else(self):
        running = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        client = Client("zone_cover")
        client.send(large_zone())
        self.assertIn("planned", client.wait_for_feedback().message)
        client.cancel()
        result = self.assert_cancelled(client.end())
        self.assertEqual(support.command_status(running).status, msg.CommandStatus.RUNNING)
        self.assertNotIn(result.status.command_id, [m.command_id for m in self.sent.messages])
        self.assertGreater(self.vehicle.speed, 0.5)

    def test_a_stop_ends_what_is_planned(self):
        client = Client("zone_cover")
        client.send(large_zone())
        client.wait_for_feedback()
        self.act(msg.ActionCommand(command=msg.ActionCommand.STOP))
        self.assert_cancelled(client.end())
        self.assertEqual(self.sent.messages, [])

    def test_a_stop_holds_what_is_driven_and_a_start_lets_it_go_on(self):
        client = Client("path_follow")
        client.send(self.straight(60.0))
        self.vehicle.wait_until_moving()
        self.act(msg.ActionCommand(command=msg.ActionCommand.STOP))
        self.vehicle.wait_until_standing()
        self.act(msg.ActionCommand(command=msg.ActionCommand.START))
        self.assert_ends(client.end(), GoalStatus.SUCCEEDED, msg.CommandStatus.FINISHED)

    def test_clearing_the_planning_ends_what_is_driven(self):
        client = Client("path_follow")
        client.send(self.straight(500.0))
        self.vehicle.wait_until_moving()
        self.act(msg.ActionCommand(command=msg.ActionCommand.CLEAR_PLANNING))
        self.assert_cancelled(client.end())

    def test_a_newer_goal_takes_the_place_of_another_clients(self):
        older, newer = Client("path_follow"), Client("lane_follow")
        older.send(self.straight(500.0))
        self.vehicle.wait_until_moving()
        newer.send(msg.LaneFollowCommand(end_pose=EAST))
        result = self.assert_ends(older.end(), GoalStatus.PREEMPTED, msg.CommandStatus.ERROR,
                                  msg.CommandStatus.SUPERSEDED)
        self.assertIn(str(newer.wait_for_feedback().command_id), result.status.message)
        self.assertTrue(newer.was_active.wait(support.DEADLINE))
        newer.cancel()
        self.assert_cancelled(newer.end())

    def test_a_client_that_goes_away_leaves_its_command_running(self):
        client = BareClient("path_follow")
        client.send("a goal of somebody who leaves", self.straight(500.0, command_id=77))
        self.wait_until_sent(77)
        client.close()
        self.vehicle.wait_until_moving()
        self.assertEqual(support.command_status(77).status, msg.CommandStatus.RUNNING)

    def test_a_goal_that_repeats_a_running_command_follows_it(self):
        command = self.straight(60.0, command_id=78)
        answer = support.service("external_command/path_follow", PathFollow)(command)
        self.assertEqual(answer.status.status, msg.CommandStatus.RUNNING, support.describe(answer.status))
        result = self.assert_ends(Client("path_follow").do(command), GoalStatus.SUCCEEDED, msg.CommandStatus.FINISHED)
        self.assertEqual(result.status.command_id, 78)
        self.assertEqual([m.command_id for m in self.sent.messages], [78])

    def test_a_goal_under_the_id_of_another_running_command_is_rejected(self):
        client, other = Client("path_follow"), Client("path_follow")
        client.send(self.straight(500.0, command_id=79))
        self.wait_until_sent(79)
        self.assert_ends(other.do(self.straight(400.0, command_id=79)), GoalStatus.REJECTED, msg.CommandStatus.ERROR,
                         msg.CommandStatus.DUPLICATE_ID)
        client.cancel()
        self.assert_cancelled(client.end())

    def test_every_goal_is_in_the_log_of_commands(self):
        log = support.Collector("external_command/log", msg.CommandLogEntry)
        result = Client("lane_follow").do(msg.LaneFollowCommand(end_pose=EAST, dry_run=True))[1]
        entry = log.wait_for(lambda m: m.reply.command_id == result.status.command_id, "an entry of the log")
        self.assertEqual((entry.service, entry.caller), ("/apollo/external_command/lane_follow", rospy.get_name()))
        self.assertEqual(entry.request.type, "external_command/LaneFollowCommand")
        log.close()

    def test_the_status_service_knows_the_commands_of_goals(self):
        result = Client("lane_follow").do(msg.LaneFollowCommand(end_pose=EAST, dry_run=True))[1]
        known = support.service("external_command/command_status", GetCommandStatus)(result.status.command_id).status
        self.assertEqual(known.message, result.status.message)


if __name__ == "__main__":
    rospy.init_node("actions_test")
    rostest.rosrun("external_command", "actions", ActionsTest)
