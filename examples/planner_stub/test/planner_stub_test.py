#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The planner stub below the real gateway; the vehicle's pose is published by this test, and stays where it is."""
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from external_command.msg import (ActionCommand, CommandStatus, LaneFollowCommand, PlanningCommand, PlanningPad,
                                  PlanningState, Pose, SpeedCommand)
from external_command.srv import Action, GetCommandStatus, LaneFollow, Speed

DEADLINE = 30.0  # [s]
NEAR, FAR = Pose(x=130.0, y=195.0), Pose(x=478.0, y=338.25)


def service(name, service_type):
    rospy.wait_for_service(name, DEADLINE)
    return rospy.ServiceProxy(name, service_type)


def wait_until(condition, what):
    """What `condition()` returns as soon as that is true."""
    end = time.monotonic() + DEADLINE
    while True:
        result = condition()
        if result:
            return result
        if time.monotonic() > end:
            raise AssertionError("not within %.0f s: %s" % (DEADLINE, what))
        time.sleep(0.05)


class PlannerStubTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
        cls.timer = rospy.Timer(rospy.Duration(0.05), lambda _: cls.publish_pose())
        cls.states = []
        cls.state_subscriber = rospy.Subscriber("planning/state", PlanningState, cls.states.append)
        cls.command = rospy.Publisher("planning/command", PlanningCommand, queue_size=10)
        cls.pad = rospy.Publisher("planning/pad", PlanningPad, queue_size=10)
        wait_until(lambda: cls.states and cls.command.get_num_connections() and cls.pad.get_num_connections(), "the stub")

    @classmethod
    def publish_pose(cls):
        transform = TransformStamped(child_frame_id="base_link")
        transform.header.frame_id = "map"
        transform.header.stamp = rospy.Time.now()
        transform.transform.translation.x, transform.transform.translation.y = 90.0, 194.75
        transform.transform.rotation.w = 1.0
        cls.tf.publish(TFMessage(transforms=[transform]))

    def lane_follow(self, goal):
        """The id of the command, asked for again until the component knows the vehicle's pose."""
        call = service("external_command/lane_follow", LaneFollow)

        def taken():
            status = call(LaneFollowCommand(end_pose=goal)).status
            self.assertIn(status.error_code, (CommandStatus.OK, CommandStatus.NOT_READY), status.message)
            return status.command_id if status.error_code == CommandStatus.OK else 0
        return wait_until(taken, "the command is taken")

    def action(self, number):
        return service("external_command/action", Action)(ActionCommand(command=number)).status.command_id

    def status(self, command_id):
        return service("external_command/command_status", GetCommandStatus)(command_id).status

    def wait_for(self, command_id, status, words=""):
        def is_so():
            now = self.status(command_id)
            return now if now.status == status and words in now.message else None
        return wait_until(is_so, "command %d has status %d, %r; it has %s" % (
            command_id, status, words, self.status(command_id)))

    def scenario(self):
        return self.states[-1].scenario

    def assert_stays(self, command_id):
        before = self.status(command_id).message
        rospy.sleep(1.0)
        self.assertEqual(self.status(command_id).message, before)

    def test_reports_a_command_until_it_is_finished(self):
        command_id = self.lane_follow(NEAR)
        self.wait_for(command_id, CommandStatus.RUNNING, "driven ")
        end = self.wait_for(command_id, CommandStatus.FINISHED)
        self.assertIn("driven ", end.message)  # the stub's word, not what the gateway sees by the pose

    def test_stands_after_a_stop_and_goes_on_after_a_start(self):
        command_id = self.lane_follow(FAR)
        self.wait_for(command_id, CommandStatus.RUNNING, "driven ")
        self.wait_for(self.action(ActionCommand.STOP), CommandStatus.FINISHED)
        self.assertEqual(self.scenario(), "EMERGENCY_STOP")
        self.wait_for(command_id, CommandStatus.RUNNING, "held ")
        self.assert_stays(command_id)
        self.action(ActionCommand.START)
        self.wait_for(command_id, CommandStatus.RUNNING, "driven ")
        self.action(ActionCommand.CLEAR_PLANNING)
        self.assertEqual(self.status(command_id).error_code, CommandStatus.CANCELLED)
        wait_until(lambda: self.scenario() == "IDLE", "the stub has forgotten it")

    def test_obeys_a_stop_that_was_sent_after_a_command_and_came_before_it(self):
        command_id = self.lane_follow(FAR)
        path = rospy.wait_for_message("planning/command", PlanningCommand, DEADLINE).path
        late = PlanningCommand(command_id=command_id, is_motion_command=True, path=path)
        late.header.stamp = rospy.Time.now()
        rospy.sleep(0.01)
        self.wait_for(self.action(ActionCommand.STOP), CommandStatus.FINISHED)
        self.command.publish(late)
        self.wait_for(command_id, CommandStatus.RUNNING, "held at 0.0")
        self.assert_stays(command_id)
        self.action(ActionCommand.CLEAR_PLANNING)

    def test_does_not_take_a_stop_for_that_of_a_command_which_was_sent_later(self):
        early = PlanningPad(action=PlanningPad.STOP)
        early.header.stamp = rospy.Time.now()
        rospy.sleep(0.01)
        command_id = self.lane_follow(FAR)
        self.wait_for(command_id, CommandStatus.RUNNING, "driven ")
        self.pad.publish(early)
        rospy.sleep(1.0)
        self.assertEqual(self.scenario(), "LANE_FOLLOW")
        self.pad.publish(PlanningPad(action=PlanningPad.STOP))  # without a stamp it counts
        self.wait_for(command_id, CommandStatus.RUNNING, "held ")
        self.action(ActionCommand.CLEAR_PLANNING)

    def test_does_not_drive_what_is_no_motion_command(self):
        wait_until(lambda: self.scenario() == "IDLE", "nothing is driven")
        self.command.publish(PlanningCommand(command_id=7))
        rospy.sleep(1.0)
        self.assertEqual(self.scenario(), "IDLE")

    def test_drives_at_the_speed_that_it_is_told_later(self):
        command_id = self.lane_follow(FAR)
        self.wait_for(command_id, CommandStatus.RUNNING, "driven ")
        service("external_command/speed", Speed)(SpeedCommand(kind=SpeedCommand.TARGET_SPEED_FACTOR))
        rospy.sleep(0.5)
        self.assert_stays(command_id)
        service("external_command/speed", Speed)(SpeedCommand(kind=SpeedCommand.RESTORE_TARGET_SPEED))
        before = self.status(command_id).message
        wait_until(lambda: self.status(command_id).message != before, "it goes on")
        self.action(ActionCommand.CLEAR_PLANNING)

    def test_says_that_it_cannot_change_lanes(self):
        end = self.wait_for(self.action(ActionCommand.CHANGE_LEFT), CommandStatus.ERROR)
        self.assertEqual(end.error_code, CommandStatus.REFUSED_BY_VEHICLE)
        self.assertIn("does not know", end.message)


if __name__ == "__main__":
    rospy.init_node("planner_stub_test")
    rostest.rosrun("planner_stub", "planner_stub", PlannerStubTest)
