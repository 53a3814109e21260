#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A vehicle that drives on while the next command is planned takes it over without a stop: its path begins where the
vehicle is when it is sent."""
import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point

import support
from external_command.msg import (ActionCommand, CommandStatus, FreeSpaceCommand, PlanningCommand, Pose, RoiPolygon,
                                  ZoneCoverCommand)
from external_command.srv import Action, FreeSpace, ZoneCover
from vehicle import Vehicle
from zone_yard import percent_of

FAST = 10.0  # [m/s]
NEAR = 3.0  # from the vehicle, when the test sees it, to the begin of the path, where messages take 0.2 s [m]
TRIES = 3
GOES_ON = 25.0  # of a path, along what the vehicle was driving [m]


class MovingVehicleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()
        act = support.service("external_command/action", Action)
        support.wait_until(lambda: act(ActionCommand(command=ActionCommand.SWITCH_TO_AUTO)).status.error_code !=
                           CommandStatus.NOT_READY, "the chassis is heard")

    def setUp(self):
        self.commands = support.Collector("planning/command", PlanningCommand)
        self.motion = self.vehicle.drive_straight(2000.0)
        support.wait_until(lambda: self.vehicle.speed > FAST, "the vehicle is fast")

    def tearDown(self):
        self.commands.close()
        support.service("external_command/action", Action)(ActionCommand(command=ActionCommand.CLEAR_PLANNING))
        self.vehicle.wait_until_standing()

    def send(self, name, service_type, command_of_now):
        """A busy machine may plan too slowly: the vehicle is too far on by then, and goes on with what it has."""
        for _ in range(TRIES):
            status = support.service("external_command/" + name, service_type)(command_of_now()).status
            if status.error_code not in (CommandStatus.PLANNING_TIMEOUT, CommandStatus.START_BLOCKED):
                break
        return status

    def assert_taken_over(self, status):
        """The vehicle drives the new command, and did not stop for it."""
        self.assertEqual(status.status, CommandStatus.RUNNING, support.describe(status))
        command = self.commands.wait_for(lambda m: m.command_id == status.command_id, "the command")
        x, y, _ = self.vehicle.pose
        first = command.path.points[0]
        self.assertLess(math.hypot(first.x - x, first.y - y), NEAR + 0.5 * self.vehicle.speed)
        self.assertEqual(support.command_status(self.motion).error_code, CommandStatus.SUPERSEDED)
        support.wait_until(lambda: "driven" in support.command_status(status.command_id).message or
                           "swath" in support.command_status(status.command_id).message or
                           "lap" in support.command_status(status.command_id).message, "the vehicle reports")
        self.assertEqual(support.command_status(status.command_id).status, CommandStatus.RUNNING)

    def test_to_a_free_space_command(self):
        def command():
            goal = self.vehicle.ahead((150.0, 20.0))[0]
            spot = Pose(x=goal.x, y=goal.y, heading=self.vehicle.pose[2], has_heading=True)
            return FreeSpaceCommand(parking_spot_pose=spot)
        self.assert_taken_over(self.send("free_space", FreeSpace, command))

    def test_to_a_zone(self):
        def command():
            corners = self.vehicle.ahead((-20.0, -40.0), (160.0, -40.0), (160.0, 40.0), (-20.0, 40.0))
            return ZoneCoverCommand(drivable_roi=RoiPolygon(points=[Point(p.x, p.y, 0.0) for p in corners]),
                                    swath_width=4.0)
        self.assert_taken_over(self.send("zone_cover", ZoneCover, command))

    def test_on_with_the_zone_that_it_sweeps_already(self):
        corners = self.vehicle.ahead((-20.0, -20.0), (100.0, -20.0), (100.0, 20.0), (-20.0, 20.0))
        zone = RoiPolygon(points=[Point(p.x, p.y, 0.0) for p in corners])

        def sweep(resume):
            status = self.send("zone_cover", ZoneCover, lambda: ZoneCoverCommand(
                drivable_roi=zone, swath_width=4.0, resume=resume))
            self.assertEqual(status.status, CommandStatus.RUNNING, support.describe(status))
            return self.commands.wait_for(lambda m: m.command_id == status.command_id, "the command")

        first = sweep(False)
        support.wait_until(lambda: percent_of(support.command_status(first.command_id).message) >= 1, "1 % is swept",
                           60.0)
        resumed = sweep(True)
        path = [point for point in resumed.path.points if point.s < GOES_ON]
        self.assertGreater(len(path), 10)
        for point in path:
            nearest = min((p for p in first.path.points if p.direction == point.direction),
                          key=lambda p: math.hypot(p.x - point.x, p.y - point.y) + abs(math.sin(
                              (p.heading - point.heading) / 2.0)))
            self.assertEqual(point.direction, 1, "it backs up after %.1f m" % point.s)
            self.assertLess(math.hypot(nearest.x - point.x, nearest.y - point.y), 0.3, "after %.1f m" % point.s)
        swept = percent_of(support.command_status(resumed.command_id).message)
        support.wait_until(lambda: percent_of(support.command_status(resumed.command_id).message) > max(swept, 1),
                           "it sweeps on", 60.0)


if __name__ == "__main__":
    rospy.init_node("moving_vehicle_test")
    rostest.rosrun("external_command", "moving_vehicle", MovingVehicleTest)
