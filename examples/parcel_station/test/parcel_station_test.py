#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The processors of this package, loaded by external_command's component."""
import os
import queue
import subprocess
import tempfile
import unittest

import actionlib
import rosbag
import rospy
import rostest

from external_command import any_message
from external_command.msg import CommandLogEntry, CommandStatus, PlanningCommand, Pose
from external_command.srv import GetCommandStatus
from parcel_station.msg import DeliverParcelAction, DeliverParcelCommand, DeliverParcelGoal, HatchCommand
from parcel_station.srv import DeliverParcel, Hatch

DEADLINE = 30.0  # [s]
STATION = Pose(x=300.0, y=195.0)


def service(name, service_type):
    rospy.wait_for_service(name, DEADLINE)
    return rospy.ServiceProxy(name, service_type)


class ParcelStationTest(unittest.TestCase):
    def deliver(self, **fields):
        """The answer, asked for again until the component knows the vehicle's pose."""
        call = service("parcel_station/deliver_parcel", DeliverParcel)
        end = rospy.get_time() + DEADLINE
        while True:
            answer = call(DeliverParcelCommand(**fields))
            if answer.status.error_code != CommandStatus.NOT_READY or rospy.get_time() > end:
                return answer

    def assert_refused(self, status, *words):
        self.assertEqual((status.status, status.error_code), (CommandStatus.ERROR, CommandStatus.INVALID_REQUEST))
        for word in words:
            self.assertIn(word, status.message)

    def test_the_planning_module_unpacks_the_command(self):
        commands = queue.Queue()
        subscriber = rospy.Subscriber("planning/command", PlanningCommand, commands.put)
        status = self.deliver(parcel_id="P-42", station=STATION).status
        self.assertEqual(status.status, CommandStatus.RUNNING, status.message)
        command = commands.get(timeout=DEADLINE)
        while command.command_id != status.command_id:  # a latched one of before
            command = commands.get(timeout=DEADLINE)
        subscriber.unregister()
        self.assertEqual(command.command_type, PlanningCommand.CUSTOM)
        parcel = any_message.unpack(command.custom_command, DeliverParcelCommand)
        self.assertEqual(parcel.parcel_id, "P-42")
        with self.assertRaises(any_message.WrongType):
            any_message.unpack(command.custom_command, HatchCommand)

    def test_the_status_service_knows_the_commands(self):
        status = self.deliver(parcel_id="P-43", station=STATION).status
        known = service("external_command/command_status", GetCommandStatus)(status.command_id).status
        self.assertIn(known.status, (CommandStatus.RUNNING, CommandStatus.FINISHED), known.message)

    def test_a_delivery_is_an_action_too(self):
        self.deliver(parcel_id="P-45", station=STATION, dry_run=True)  # until the vehicle's pose is known
        client = actionlib.SimpleActionClient("parcel_station/deliver_parcel", DeliverParcelAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(DEADLINE)))
        command = DeliverParcelCommand(parcel_id="P-45", station=STATION, dry_run=True)
        state = client.send_goal_and_wait(DeliverParcelGoal(command), rospy.Duration(DEADLINE))
        self.assertEqual(state, actionlib.GoalStatus.SUCCEEDED)
        self.assertGreater(client.get_result().report.path_length, 0.0)

    def test_refuses_what_makes_no_sense(self):
        self.assert_refused(self.deliver(station=STATION).status, "parcel_id")
        self.assert_refused(self.deliver(parcel_id="P-44", station=Pose(x=float("nan"))).status, "station.x", "nan")

    def test_a_plain_command_is_passed_on(self):
        hatch = service("parcel_station/hatch", Hatch)
        commands = queue.Queue()
        subscriber = rospy.Subscriber("parcel_station/hatch_command", HatchCommand, commands.put)
        while subscriber.get_num_connections() == 0:
            rospy.sleep(0.01)
        status = hatch(HatchCommand(compartment=4, open=True)).status
        self.assertEqual(status.status, CommandStatus.FINISHED, status.message)
        self.assertEqual(commands.get(timeout=DEADLINE).compartment, 4)
        self.assert_refused(hatch(HatchCommand(compartment=5)).status, "compartment", "5", "4")
        subscriber.unregister()

    def test_a_recorded_command_is_sent_again(self):
        logged, opened = queue.Queue(), queue.Queue()
        subscribers = [rospy.Subscriber("external_command/log", CommandLogEntry, logged.put),
                       rospy.Subscriber("parcel_station/hatch_command", HatchCommand, opened.put)]
        while any(subscriber.get_num_connections() == 0 for subscriber in subscribers):
            rospy.sleep(0.01)
        service("parcel_station/hatch", Hatch)(HatchCommand(compartment=3, open=True))
        first = opened.get(timeout=DEADLINE)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "log.bag")
            with rosbag.Bag(path, "w") as bag:
                bag.write("external_command/log", logged.get(timeout=DEADLINE))
            subprocess.run(["rosrun", "external_command", "replay_commands", "--immediate", path], check=True)
        again = opened.get(timeout=DEADLINE)
        self.assertEqual((again.compartment, again.open), (3, True))
        self.assertNotEqual(again.command_id, first.command_id)
        for subscriber in subscribers:
            subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("parcel_station_test")
    rostest.rosrun("parcel_station", "parcel_station", ParcelStationTest)
