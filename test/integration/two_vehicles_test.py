#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Two vehicles under one master, and a processor that is loaded on its own beside the component."""
import unittest

import rospy
import rostest

import support
from external_command.msg import CommandStatus, LaneFollowCommand, PlanningCommand, Pose
from external_command.srv import LaneFollow

GOALS = {"first": Pose(x=300.0, y=195.0), "second": Pose(x=300.0, y=205.0)}


def drive(vehicle):
    """The status of the first command that is not refused. No second one, planned while the vehicle moves: at twenty
    times real time, and on a busy machine, it has left the beginning of that path when the path reaches it."""
    call = support.service("/%s/external_command/lane_follow" % vehicle, LaneFollow)
    statuses = []

    def is_accepted():
        statuses.append(call(LaneFollowCommand(end_pose=GOALS[vehicle])).status)
        return statuses[-1].status == CommandStatus.RUNNING

    support.wait_until(is_accepted, vehicle + " is ready")
    return statuses[-1]


def status_service(vehicle):
    return "/%s/external_command/command_status" % vehicle


class TwoVehiclesTest(unittest.TestCase):
    def test_each_drives_its_own_way(self):
        sent = {name: support.Collector("/%s/planning/command" % name, PlanningCommand) for name in GOALS}
        statuses = {name: drive(name) for name in GOALS}
        for name, status in statuses.items():
            command = sent[name].wait_for(lambda m: m.command_id == status.command_id, "command of " + name)
            self.assertLess(abs(command.path.points[-1].y - GOALS[name].y), 5.0)
            support.wait_for_status(status.command_id, CommandStatus.FINISHED, status_service(name), 60.0)

    def test_the_status_service_answers_for_a_processor_loaded_on_its_own(self):
        status = drive("second")
        known = support.command_status(status.command_id, status_service("second"))
        self.assertIn(known.status, (CommandStatus.RUNNING, CommandStatus.FINISHED), support.describe(known))

    def test_neither_knows_the_commands_of_the_other(self):
        status = drive("second")
        self.assertEqual(support.command_status(status.command_id + 10 ** 9, status_service("first")).status,
                         CommandStatus.UNKNOWN)


if __name__ == "__main__":
    rospy.init_node("two_vehicles_test")
    rostest.rosrun("external_command", "two_vehicles", TwoVehiclesTest)
