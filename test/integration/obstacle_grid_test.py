#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The obstacle grid as parking takes it: what is inside it, unknown, beyond it, old."""
import os
import unittest

import rospkg
import rospy
import rostest
from nav_msgs.msg import OccupancyGrid

import support
from component import Component, patient
from external_command.msg import CommandStatus, Pose, ValetParkingCommand
from external_command.srv import ValetParking

TOWN = os.path.join(rospkg.RosPack().get_path("external_command"), "maps", "demo_town", "base_map.bin")
NAMESPACE = "/obstacle_grid"
GRID = NAMESPACE + "/grid"
START = Pose(x=90.0, y=195.0)
SPACE = "n_out_10"


def grid(around, value, frame="map", stamp=None, side=20.0):
    """A square of `side` [m] around a pose, all of one value."""
    message = OccupancyGrid()
    message.header.frame_id = frame
    message.header.stamp = stamp or rospy.Time.now()
    message.info.resolution = side / 40.0
    message.info.width = message.info.height = 40
    message.info.origin.position.x, message.info.origin.position.y = around.x - side / 2.0, around.y - side / 2.0
    message.info.origin.orientation.w = 1.0
    message.data = [value] * 1600
    return message


def parking(**parameters):
    own = patient("valet_parking_command_processor", obstacle_grid_name="grid", **parameters)
    return Component(NAMESPACE, {
        "external_command": {"processors": ["external_command/ValetParkingCommandProcessor"], "map_file": TOWN},
        "valet_parking_command_processor": own})


class ObstacleGridTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.publisher = rospy.Publisher(GRID, OccupancyGrid, queue_size=1, latch=True)

    def plan(self, component):
        """The answer to a dry run."""
        call = component.service("external_command/valet_parking", ValetParking)
        return call(ValetParkingCommand(parking_spot_id=SPACE, is_start_pose_set=True, way_point=[START], dry_run=True))

    def wait_for(self, component, error_code, message=None):
        """Publishes `message`, and plans until that comes of it."""
        if message:
            self.publisher.publish(message)
        answers = []

        def is_so():
            answers.append(self.plan(component))
            return answers[-1].status.error_code == error_code
        support.wait_until(is_so, "error code %d" % error_code)
        return answers[-1]

    def test_beyond_its_border_is_free_and_unknown_inside_is_blocked(self):
        with parking() as component:
            free = self.wait_for(component, CommandStatus.OK, grid(START, 0))
            last = free.path.points[-1]
            unknown = self.wait_for(component, CommandStatus.GOAL_BLOCKED, grid(last, -1, side=3.0))
            self.assertIn("are unknown, which counts as blocked (~grid_unknown_is_blocked)", unknown.status.message)
            self.wait_for(component, CommandStatus.OK, grid(last, 0, frame="/map"))
            blocked = self.wait_for(component, CommandStatus.GOAL_BLOCKED, grid(last, 100, side=3.0))
            self.assertIn("the obstacle grid", blocked.status.message)
            self.assertNotIn("unknown", blocked.status.message)
            self.wait_for(component, CommandStatus.NOT_READY, grid(last, 0, frame="nowhere"))
            old = self.wait_for(component, CommandStatus.NOT_READY,
                                grid(START, 0, stamp=rospy.Time.now() - rospy.Duration(600.0)))
            self.assertIn("max_grid_age", old.status.message)

    def test_parameters_say_otherwise(self):
        others = dict(grid_unknown_is_blocked=False, grid_outside_is_blocked=True, max_grid_age=0)
        with parking(**others) as component:
            self.publisher.publish(grid(START, 0, stamp=rospy.Time.now() - rospy.Duration(600.0)))
            blocked = self.wait_for(component, CommandStatus.GOAL_BLOCKED)
            self.assertIn("the obstacle grid", blocked.status.message)
            self.wait_for(component, CommandStatus.OK, grid(START, -1, stamp=rospy.Time(1.0), side=2000.0))


if __name__ == "__main__":
    rospy.init_node("obstacle_grid_test")
    rostest.rosrun("external_command", "obstacle_grid", ObstacleGridTest)
