#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Commands that are cancelled one by one: what the vehicle does then, and what goes on."""
import unittest

import rospy
import rostest

import support
from external_command.msg import ActionCommand, CommandStatus, ControlPad, PlanningCommand, PlanningPad
from external_command.srv import Action, CancelCommand
from vehicle import Vehicle


def act(action, **fields):
    return support.service("external_command/action", Action)(ActionCommand(command=action, **fields)).status


def cancel(command_id):
    return support.service("external_command/cancel_command", CancelCommand)(command_id=command_id)


class CancelTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()
        cls.pads = support.Collector("planning/pad", PlanningPad)
        cls.control = support.Collector("control/pad", ControlPad)
        cls.commands = support.Collector("planning/command", PlanningCommand)
        support.wait_until(
            lambda: act(ActionCommand.SWITCH_TO_AUTO).error_code != CommandStatus.NOT_READY, "the chassis is heard")

    def tearDown(self):
        act(ActionCommand.CLEAR_PLANNING)
        self.vehicle.wait_until_standing()

    def assert_cancels(self, command_id):
        answer = cancel(command_id)
        self.assertTrue(answer.was_running, support.describe(answer.status))
        for status in (answer.status, support.command_status(command_id)):
            self.assertEqual(status.command_id, command_id)
            self.assertEqual(status.status, CommandStatus.ERROR, support.describe(status))
            self.assertEqual(status.error_code, CommandStatus.CANCELLED, support.describe(status))
            self.assertIn(rospy.get_name(), status.message)

    def last_command(self):
        return self.commands.messages[-1]

    def test_a_driven_command_is_cleared_and_the_next_is_driven(self):
        motion = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        self.assert_cancels(motion)
        self.vehicle.wait_until_standing()
        support.wait_until(lambda: (self.last_command().command_id, self.last_command().is_motion_command) ==
                           (motion, False), "the command is withdrawn")
        self.assertEqual(self.pads.messages[-1].action, PlanningPad.CLEAR_PLANNING)
        self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()

    def test_a_command_held_by_a_stop_is_cleared_and_start_moves_nothing(self):
        motion = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        support.wait_for_status(act(ActionCommand.STOP).command_id, CommandStatus.FINISHED)
        self.assert_cancels(motion)
        act(ActionCommand.START)
        rospy.sleep(0.5)
        self.assertEqual(self.vehicle.speed, 0.0)

    def test_a_vehicle_that_hears_late_of_an_earlier_clearing_drives_on(self):
        """Topics are not in step: the newer command may come before the pad that clears the one before it."""
        self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        late = PlanningPad(action=PlanningPad.CLEAR_PLANNING)
        late.header.stamp = self.last_command().header.stamp - rospy.Duration(0.001)
        pads = rospy.Publisher("planning/pad", PlanningPad, queue_size=1)
        support.wait_until(lambda: pads.get_num_connections() > 1, "the vehicle takes pads")
        pads.publish(late)
        rospy.sleep(0.5)
        self.assertGreater(self.vehicle.speed, 0.5)
        late.header.stamp = rospy.Time.now()
        pads.publish(late)
        self.vehicle.wait_until_standing()

    def test_an_ended_command_clears_nothing(self):
        motion = self.vehicle.drive_straight(length=5.0)
        support.wait_for_status(motion, CommandStatus.FINISHED)
        running = self.vehicle.drive_straight()
        already = len(self.pads.messages)
        answer = cancel(motion)
        self.assertFalse(answer.was_running)
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
        self.vehicle.wait_until_moving()
        self.assertEqual(support.command_status(running).status, CommandStatus.RUNNING)
        self.assertEqual(len(self.pads.messages), already)

    def test_a_reused_id_means_the_newest_command(self):
        first = self.vehicle.drive_straight(length=5.0, command_id=77)
        support.wait_for_status(first, CommandStatus.FINISHED)
        self.vehicle.drive_straight(command_id=77)
        self.vehicle.wait_until_moving()
        self.assert_cancels(77)
        self.vehicle.wait_until_standing()

    def test_an_unknown_id_is_told(self):
        answer = cancel(123456)
        self.assertFalse(answer.was_running)
        self.assertEqual(answer.status.status, CommandStatus.UNKNOWN)
        self.assertEqual(answer.status.error_code, CommandStatus.UNKNOWN_ID)

    def test_an_action_is_waited_for_no_longer_and_the_motion_goes_on(self):
        motion = self.vehicle.drive_straight()
        self.vehicle.wait_until_moving()
        start = act(ActionCommand.START)
        self.assertEqual(start.status, CommandStatus.RUNNING, support.describe(start))
        self.assert_cancels(start.command_id)
        self.assertEqual(support.command_status(motion).status, CommandStatus.RUNNING)
        self.assertGreater(self.vehicle.speed, 0.0)

    def test_a_stop_that_is_cancelled_holds_all_the_same(self):
        self.vehicle.drive_straight()
        support.wait_until(lambda: self.vehicle.speed > 5.0, "the vehicle is fast")
        self.assert_cancels(act(ActionCommand.STOP).command_id)
        self.vehicle.wait_until_standing()

    def test_a_mode_switch_asks_no_more(self):
        switch = act(ActionCommand.SWITCH_TO_MANUAL)
        self.assertEqual(switch.status, CommandStatus.RUNNING, support.describe(switch))
        self.assert_cancels(switch.command_id)
        support.wait_until(lambda: self.control.messages, "the mode was asked for")
        already = len(self.control.messages)
        rospy.sleep(1.2)  # it would ask twice more, or see that it is done
        self.assertEqual(len(self.control.messages), already)
        status = support.command_status(switch.command_id)
        self.assertEqual(status.error_code, CommandStatus.CANCELLED, support.describe(status))
        support.wait_for_status(act(ActionCommand.SWITCH_TO_AUTO).command_id, CommandStatus.FINISHED)


if __name__ == "__main__":
    rospy.init_node("cancel_test")
    rostest.rosrun("external_command", "cancel", CancelTest)
