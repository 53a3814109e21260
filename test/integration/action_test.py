#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every action with the simulated vehicle: where it goes, what the vehicle does, and when it is finished."""
import unittest

import rospy
import rostest

import support
from external_command.msg import (ActionCommand, Chassis, CommandStatus, ControlPad, PathFollowCommand, PlanningCommand,
                                  PlanningPad)
from external_command.srv import Action, PathFollow
from vehicle import Vehicle


def act(action, **fields):
    return support.service("external_command/action", Action)(ActionCommand(command=action, **fields)).status


class ActionTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()
        cls.planning = support.Collector("planning/pad", PlanningPad)
        cls.control = support.Collector("control/pad", ControlPad)
        support.wait_until(
            lambda: act(ActionCommand.SWITCH_TO_AUTO).error_code != CommandStatus.NOT_READY, "the chassis is heard")

    def setUp(self):
        self.finish(ActionCommand.SWITCH_TO_AUTO)

    def tearDown(self):
        act(ActionCommand.CLEAR_PLANNING)
        self.vehicle.wait_until_standing()

    def send(self, action):
        """The id of an action that is RUNNING."""
        status = act(action)
        self.assertEqual(status.status, CommandStatus.RUNNING, support.describe(status))
        return status.command_id

    def finish(self, action):
        """Its last status, FINISHED."""
        status = act(action)
        self.assertIn(status.status, (CommandStatus.RUNNING, CommandStatus.FINISHED), support.describe(status))
        return support.wait_for_status(status.command_id, CommandStatus.FINISHED)

    def assert_pads(self, collector, already, *pads):
        support.wait_until(lambda: len(collector.messages) >= already + len(pads), "pads %s" % (pads,))
        self.assertEqual([pad.action for pad in collector.messages[already:]], list(pads))

    def test_stop_and_start(self):
        motion = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        already = len(self.planning.messages)
        stop = self.send(ActionCommand.STOP)
        status = support.wait_for_status(stop, CommandStatus.FINISHED)
        self.assertIn("EMERGENCY_STOP", status.message)
        self.vehicle.wait_until_standing()
        self.assertEqual(support.command_status(motion).status, CommandStatus.RUNNING)

        start = self.send(ActionCommand.START)
        support.wait_for_status(start, CommandStatus.FINISHED)
        self.vehicle.wait_until_moving()
        self.assert_pads(self.planning, already, PlanningPad.STOP, PlanningPad.RESUME_CRUISE)

    def test_a_stop_holds_the_command_before_it_that_reaches_the_vehicle_after_it(self):
        self.finish(ActionCommand.STOP)
        way = PathFollowCommand(way_point=self.vehicle.ahead((0.0, 0.0), (50.0, 0.0)), dry_run=True)
        late = PlanningCommand(command_id=1, is_motion_command=True)
        late.path = support.service("external_command/path_follow", PathFollow)(way).path
        late.header.stamp = self.planning.messages[-1].header.stamp - rospy.Duration(0.001)
        commands = rospy.Publisher("planning/command", PlanningCommand, queue_size=1)
        support.wait_until(lambda: commands.get_num_connections() > 0, "the vehicle takes commands")
        commands.publish(late)
        rospy.sleep(0.5)
        self.assertEqual(self.vehicle.speed, 0.0)
        self.send(ActionCommand.START)
        self.vehicle.wait_until_moving()

    def test_a_stop_of_a_standing_vehicle_is_finished(self):
        support.wait_for_status(self.send(ActionCommand.STOP), CommandStatus.FINISHED)

    def test_a_start_of_a_moving_vehicle_waits_for_movement_that_begins_after_it(self):
        self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        start = self.send(ActionCommand.START)
        self.finish(ActionCommand.VIN_REQ)  # by a newer report of the chassis
        self.assertEqual(support.command_status(start).status, CommandStatus.RUNNING)

    def test_pull_over(self):
        self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        already = len(self.planning.messages)
        status = support.wait_for_status(self.send(ActionCommand.PULL_OVER), CommandStatus.FINISHED)
        self.assertIn("EMERGENCY_PULL_OVER", status.message)
        self.vehicle.wait_until_standing()
        self.assert_pads(self.planning, already, PlanningPad.PULL_OVER)

    def test_a_start_supersedes_a_stop_that_has_not_ended(self):
        self.vehicle.drive_straight()
        support.wait_until(lambda: self.vehicle.speed > 5.0, "the vehicle is fast")
        pull_over = self.send(ActionCommand.PULL_OVER)
        start = self.send(ActionCommand.START)
        status = support.wait_for_status(pull_over, CommandStatus.ERROR)
        self.assertEqual(status.error_code, CommandStatus.SUPERSEDED)
        self.assertIn(str(start), status.message)

    def test_what_the_planner_takes_note_of(self):
        for action, pad in ((ActionCommand.FOLLOW, PlanningPad.FOLLOW),
                            (ActionCommand.CHANGE_LEFT, PlanningPad.CHANGE_LEFT),
                            (ActionCommand.CHANGE_RIGHT, PlanningPad.CHANGE_RIGHT),
                            (ActionCommand.ENTER_MISSION, PlanningPad.ENTER_MISSION),
                            (ActionCommand.EXIT_MISSION, PlanningPad.EXIT_MISSION)):
            already = len(self.planning.messages)
            support.wait_for_status(self.send(action), CommandStatus.FINISHED)
            self.assert_pads(self.planning, already, pad)

    def test_clear_planning_ends_the_running_motion_command(self):
        motion = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        already = len(self.planning.messages)
        clear = act(ActionCommand.CLEAR_PLANNING)
        self.assertEqual(clear.status, CommandStatus.FINISHED, support.describe(clear))
        status = support.command_status(motion)
        self.assertEqual(status.status, CommandStatus.ERROR, support.describe(status))
        self.assertEqual(status.error_code, CommandStatus.CANCELLED)
        self.assertIn("CLEAR_PLANNING", status.message)
        self.assertIn(str(clear.command_id), status.message)
        self.vehicle.wait_until_standing()
        self.assert_pads(self.planning, already, PlanningPad.CLEAR_PLANNING)

    def test_clear_planning_of_nothing_is_finished(self):
        self.assertEqual(act(ActionCommand.CLEAR_PLANNING).status, CommandStatus.FINISHED)

    def test_switches_to_manual_and_back_while_a_motion_command_runs(self):
        motion = self.vehicle.drive_straight()
        already = len(self.control.messages)
        self.finish(ActionCommand.SWITCH_TO_MANUAL)
        self.assertEqual(self.vehicle.chassis.driving_mode, Chassis.COMPLETE_MANUAL)
        self.assertEqual(support.command_status(motion).status, CommandStatus.RUNNING)
        self.finish(ActionCommand.SWITCH_TO_AUTO)
        self.assertEqual(self.vehicle.chassis.driving_mode, Chassis.COMPLETE_AUTO_DRIVE)
        self.assert_pads(self.control, already, ControlPad.RESET, ControlPad.START)
        self.vehicle.wait_until_moving()

    def stop_a_switch_to_auto(self, action):
        """What became of a switch to auto behind which `action` was called at once."""
        self.finish(ActionCommand.SWITCH_TO_MANUAL)
        to_auto = self.send(ActionCommand.SWITCH_TO_AUTO)
        stop = act(action)
        asked = len(self.control.messages)
        status = support.command_status(to_auto)
        if status.status == CommandStatus.ERROR:
            self.assertEqual(status.error_code, CommandStatus.CANCELLED, support.describe(status))
            self.assertIn(str(stop.command_id), status.message)
            rospy.sleep(1.0)
            self.assertLessEqual(len(self.control.messages), asked + 1, "one may still be on the way")
        return status

    def test_what_stops_ends_a_switch_to_auto_that_is_under_way(self):
        for action in (ActionCommand.STOP, ActionCommand.CLEAR_PLANNING):
            support.wait_until(lambda: self.stop_a_switch_to_auto(action).status == CommandStatus.ERROR,
                               "a switch that is under way when it is stopped")

    def test_a_chassis_that_is_in_auto_already_is_not_asked(self):
        already = len(self.control.messages)
        self.finish(ActionCommand.SWITCH_TO_AUTO)
        self.assertEqual(len(self.control.messages), already)

    def test_asks_for_the_vin(self):
        self.assertIn("SIMULATED", self.finish(ActionCommand.VIN_REQ).message)

    def test_refuses_an_unknown_action_and_names_the_known_ones(self):
        for action in (0, 8, 49, 55, 255):
            status = act(action)
            self.assertEqual(status.status, CommandStatus.ERROR)
            self.assertEqual(status.error_code, CommandStatus.INVALID_REQUEST)
            self.assertIn("command is %d" % action, status.message)
            self.assertIn("SWITCH_TO_AUTO (51)", status.message)

    def test_a_retry_is_not_sent_twice(self):
        self.vehicle.drive_straight()
        support.wait_until(lambda: self.vehicle.speed > 5.0, "the vehicle is fast")
        already = len(self.planning.messages)
        first = act(ActionCommand.PULL_OVER, command_id=1234)
        again = act(ActionCommand.PULL_OVER, command_id=1234)
        self.assertEqual(again.status, CommandStatus.RUNNING, support.describe(again))
        other = act(ActionCommand.FOLLOW, command_id=1234)
        self.assertEqual(other.error_code, CommandStatus.DUPLICATE_ID, support.describe(other))
        support.wait_for_status(first.command_id, CommandStatus.FINISHED)
        self.assert_pads(self.planning, already, PlanningPad.PULL_OVER)


if __name__ == "__main__":
    rospy.init_node("action_test")
    rostest.rosrun("external_command", "action", ActionTest)
