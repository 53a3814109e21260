#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Actions and chassis commands where planner and chassis are silent, or are played by the test."""
import threading
import unittest

import rospy
import rostest

import support
from external_command.msg import (ActionCommand, Chassis, ChassisCommand, CommandStatus, ControlPad, PlanningState,
                                  VehicleSignal)
from external_command.srv import Action, ChassisControl


def act(action):
    return support.service("external_command/action", Action)(ActionCommand(command=action)).status


class PlayedChassis:
    """Reports `mode` 20 times a second. `on_pad(chassis, action)` is called for each ControlPad."""

    def __init__(self, mode, on_pad=None, ahead=0.0):
        self.mode = mode
        self._ahead = ahead  # of the stamps; 0: none are set [s]
        self._is_paused = threading.Event()
        self._on_pad = on_pad
        self._publisher = rospy.Publisher("canbus/chassis", Chassis, queue_size=10)
        self._pads = rospy.Subscriber("control/pad", ControlPad, self._answer)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._report)

    def __enter__(self):
        support.wait_until(lambda: self._publisher.get_num_connections() > 0, "somebody listens to the chassis")
        support.wait_until(lambda: self._pads.get_num_connections() > 0, "a publisher of control/pad")
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._stop.set()
        self._thread.join()
        self._pads.unregister()
        self._publisher.unregister()

    def pause(self):
        self._is_paused.set()

    def _answer(self, pad):
        if self._on_pad:
            self._on_pad(self, pad.action)

    def _report(self):
        while not self._stop.wait(0.05):
            message = Chassis(driving_mode=self.mode)
            if self._ahead > 0.0:
                message.header.stamp = rospy.Time.now() + rospy.Duration(self._ahead)
            if not self._is_paused.is_set():
                self._publisher.publish(message)


def obey(chassis, action):
    chassis.mode = Chassis.COMPLETE_AUTO_DRIVE if action == ControlPad.START else Chassis.COMPLETE_MANUAL


class WithoutVehicleTest(unittest.TestCase):
    def setUp(self):
        self.pads = support.Collector("control/pad", ControlPad)

    def tearDown(self):
        self.pads.close()

    def start_switch(self, action):
        """The id of a switch that is RUNNING; waits for the chassis to be heard."""
        answers = []

        def is_heard():
            answers.append(act(action))
            return answers[-1].error_code != CommandStatus.NOT_READY

        support.wait_until(is_heard, "the chassis is heard")
        self.assertEqual(answers[-1].status, CommandStatus.RUNNING, support.describe(answers[-1]))
        return answers[-1].command_id

    def wait_until_chassis_is_not_heard(self):
        """What was heard of it is too old; the switches that this was tried with have ended."""
        begun = []

        def is_refused():
            begun.append(act(ActionCommand.SWITCH_TO_AUTO))
            return begun[-1].error_code == CommandStatus.NOT_READY

        support.wait_until(is_refused, "what was heard of the chassis is too old")
        for switch in begun:
            support.wait_until(lambda: support.command_status(switch.command_id).status != CommandStatus.RUNNING,
                               "a switch ends")

    def test_needs_the_chassis_to_switch_to_auto(self):
        self.wait_until_chassis_is_not_heard()
        already = len(self.pads.messages)
        status = act(ActionCommand.SWITCH_TO_AUTO)
        self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
        self.assertIn("chassis", status.message)
        self.assertEqual(len(self.pads.messages), already)

    def test_switches_to_manual_without_a_chassis_and_says_that_nothing_confirms_it(self):
        switch = act(ActionCommand.SWITCH_TO_MANUAL)
        self.assertEqual(switch.status, CommandStatus.RUNNING, support.describe(switch))
        status = support.wait_for_status(switch.command_id, CommandStatus.ERROR)
        self.assertIn("not confirmed", status.message)
        self.assertEqual([pad.action for pad in self.pads.messages], [ControlPad.RESET] * 3)

    def test_takes_a_report_from_before_the_switch_to_manual_for_nothing(self):
        with PlayedChassis(Chassis.COMPLETE_MANUAL) as chassis:
            support.wait_for_status(self.start_switch(ActionCommand.SWITCH_TO_MANUAL), CommandStatus.FINISHED)
            chassis.pause()
            self.wait_until_chassis_is_not_heard()
            status = support.wait_for_status(act(ActionCommand.SWITCH_TO_MANUAL).command_id, CommandStatus.ERROR)
        self.assertIn("not confirmed", status.message)

    def test_a_chassis_that_reports_from_the_future_is_not_heard(self):
        with PlayedChassis(Chassis.COMPLETE_MANUAL, ahead=30.0):
            def is_told():
                return "in the future" in act(ActionCommand.SWITCH_TO_AUTO).message

            support.wait_until(is_told, "the refusal tells that the stamp lies in the future")

    def test_asks_three_times_for_a_mode(self):
        with PlayedChassis(Chassis.COMPLETE_AUTO_DRIVE):
            switch = self.start_switch(ActionCommand.SWITCH_TO_MANUAL)
            status = support.wait_for_status(switch, CommandStatus.ERROR)
        self.assertEqual(status.error_code, CommandStatus.REFUSED_BY_VEHICLE, support.describe(status))
        self.assertIn("COMPLETE_MANUAL 3 of 3 times", status.message)
        self.assertEqual([pad.action for pad in self.pads.messages], [ControlPad.RESET] * 3)
        stamps = [pad.header.stamp.to_sec() for pad in self.pads.messages]
        for before, after in zip(stamps, stamps[1:]):
            self.assertGreater(after - before, 0.45)
            self.assertLess(after - before, 1.0)

    def test_brings_the_chassis_to_manual_before_auto(self):
        with PlayedChassis(Chassis.AUTO_STEER_ONLY, obey):
            switch = self.start_switch(ActionCommand.SWITCH_TO_AUTO)
            support.wait_for_status(switch, CommandStatus.FINISHED)
        self.assertEqual([pad.action for pad in self.pads.messages], [ControlPad.RESET, ControlPad.START])

    def test_never_asks_for_auto_where_manual_is_not_reached(self):
        with PlayedChassis(Chassis.EMERGENCY_MODE):
            switch = self.start_switch(ActionCommand.SWITCH_TO_AUTO)
            support.wait_for_status(switch, CommandStatus.ERROR)
        self.assertEqual([pad.action for pad in self.pads.messages], [ControlPad.RESET] * 3)

    def test_a_newer_switch_replaces_a_running_one(self):
        with PlayedChassis(Chassis.COMPLETE_MANUAL) as chassis:
            first = self.start_switch(ActionCommand.SWITCH_TO_AUTO)
            support.wait_until(lambda: self.pads.messages, "the chassis is asked for auto")
            second = act(ActionCommand.SWITCH_TO_MANUAL).command_id
            status = support.wait_for_status(first, CommandStatus.ERROR)
            self.assertEqual(status.error_code, CommandStatus.SUPERSEDED)
            self.assertIn(str(second), status.message)
            support.wait_for_status(second, CommandStatus.FINISHED)
            self.assertEqual(chassis.mode, Chassis.COMPLETE_MANUAL)
        # Although the chassis reported manual all the time: it could still have gone into auto.
        self.assertEqual([pad.action for pad in self.pads.messages], [ControlPad.START, ControlPad.RESET])

    def test_actions_that_nobody_shows_the_end_of_become_unknown(self):
        sent = {action: act(action).command_id for action in (
            ActionCommand.FOLLOW, ActionCommand.CHANGE_LEFT, ActionCommand.STOP, ActionCommand.START,
            ActionCommand.VIN_REQ)}
        del sent[ActionCommand.STOP]  # superseded by the start
        for command_id in sent.values():
            status = support.wait_for_status(command_id, CommandStatus.UNKNOWN)
            self.assertIn("~timeout", status.message)
        stop = act(ActionCommand.STOP).command_id
        self.assertIn("~stop_timeout", support.wait_for_status(stop, CommandStatus.UNKNOWN).message)

    def test_the_planner_may_report_an_action_by_its_id_or_refuse_it(self):
        reports = rospy.Publisher("planning/command_status", CommandStatus, queue_size=10)
        states = rospy.Publisher("planning/state", PlanningState, queue_size=10)
        support.wait_until(lambda: reports.get_num_connections() > 0 and states.get_num_connections() > 0,
                           "somebody listens to the planner")
        done, refused, stop = [act(action).command_id for action in (
            ActionCommand.CHANGE_LEFT, ActionCommand.CHANGE_RIGHT, ActionCommand.STOP)]
        # Until it is there: a connection may still be new.
        self.repeat_until_ended(done, lambda: reports.publish(
            CommandStatus(command_id=done, status=CommandStatus.FINISHED)), CommandStatus.FINISHED)
        self.repeat_until_ended(refused, lambda: reports.publish(
            CommandStatus(command_id=refused, status=CommandStatus.ERROR, message="a wall")), CommandStatus.ERROR)
        self.assertEqual(support.command_status(refused).message, "a wall")
        self.assertEqual(support.command_status(refused).error_code, CommandStatus.REFUSED_BY_VEHICLE)
        self.assertEqual(support.command_status(stop).status, CommandStatus.RUNNING)

        def stand():
            states.publish(PlanningState(scenario="EMERGENCY_STOP"))
            reports.publish(CommandStatus(command_id=stop, status=CommandStatus.FINISHED))

        self.repeat_until_ended(stop, stand, CommandStatus.FINISHED)
        states.publish(PlanningState(scenario="IDLE"))

    def test_passes_on_codes_of_the_table_and_words_that_can_be_read_of_a_planner_that_refuses_an_action(self):
        reports = rospy.Publisher("planning/command_status", CommandStatus, queue_size=10)
        support.wait_until(lambda: reports.get_num_connections() > 0, "somebody listens to the planner")
        told = support.Collector("external_command/status", CommandStatus)
        for given, code in ((0, CommandStatus.REFUSED_BY_VEHICLE), (CommandStatus.NO_PATH, CommandStatus.NO_PATH),
                            (16, CommandStatus.REFUSED_BY_VEHICLE), (65535, CommandStatus.REFUSED_BY_VEHICLE)):
            report = CommandStatus(command_id=act(ActionCommand.FOLLOW).command_id, status=CommandStatus.ERROR,
                                   error_code=given, message="a wall\n\x1b[2J" + 100000 * "!")
            report.header.frame_id = "anything"
            end = self.told_after(reports, report, told)
            self.assertEqual(end.error_code, code, support.describe(end)[:200])
            self.assertIn("a wall\\x0a\\x1b[2J", end.message)
            self.assertEqual("error_code is %d" % given in end.message, given > CommandStatus.INTERNAL_ERROR)
            self.assertLess(len(end.message), 3000)
            self.assertEqual(end.header.frame_id, "")
            self.assertGreater(end.header.stamp.to_sec(), 0.0)
        told.close()
        reports.unregister()

    def told_after(self, reports, report, told):
        """The end of its command, as the topic tells it."""
        self.repeat_until_ended(report.command_id, lambda: reports.publish(report), CommandStatus.ERROR)
        return told.wait_for(lambda m: (m.command_id, m.status) == (report.command_id, CommandStatus.ERROR), "its end")

    def repeat_until_ended(self, command_id, publish, wanted):
        def has_ended():
            publish()
            return support.command_status(command_id).status != CommandStatus.RUNNING

        support.wait_until(has_ended, "command %d ends" % command_id)
        status = support.command_status(command_id)
        self.assertEqual(status.status, wanted, support.describe(status))

    def test_signals_that_the_chassis_does_not_report_become_unknown(self):
        command = ChassisCommand(basic_signal=VehicleSignal(horn=VehicleSignal.ON))
        with PlayedChassis(Chassis.COMPLETE_MANUAL):
            sent = support.service("external_command/chassis", ChassisControl)(command).status
            status = support.wait_for_status(sent.command_id, CommandStatus.UNKNOWN)
        self.assertIn("horn", status.message)


if __name__ == "__main__":
    rospy.init_node("without_vehicle_test")
    rostest.rosrun("external_command", "without_vehicle", WithoutVehicleTest)
