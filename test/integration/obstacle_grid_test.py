#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The obstacle grid as the planners take it: what is inside it, unknown, beyond it, old, and what is no grid."""
import math
import os

import rospkg
import rospy
import rostest
from nav_msgs.msg import OccupancyGrid

import support
from component import Component, patient
from external_command.msg import (CommandStatus, FreeSpaceCommand, LaneFollowCommand, Pose, PreciseParkingCommand,
                                  Readiness, ValetParkingCommand, ZoneCoverCommand)
from external_command.srv import FreeSpace, LaneFollow, PreciseParking, ValetParking, ZoneCover
from localization import Localization

TOWN = os.path.join(rospkg.RosPack().get_path("external_command"), "maps", "demo_town", "base_map.bin")
NAMESPACE = "/obstacle_grid"
GRID = NAMESPACE + "/grid"
START = Pose(x=90.0, y=195.0)
SPACE = "n_out_10"
BESIDE_THE_ROAD = Pose(x=120.0, y=175.0, heading=1.5, has_heading=True)
SERVICES = {"lane_follow": LaneFollow, "valet_parking": ValetParking, "free_space": FreeSpace,
            "precise_parking": PreciseParking, "zone_cover": ZoneCover}


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


def broken(**info):
    """A grid of which a value of `info` is wrong."""
    message = grid(BESIDE_THE_ROAD, 0)
    for key, value in info.items():
        setattr(message.info, key, value)
    return message


def without_place():
    message = grid(BESIDE_THE_ROAD, 0)
    message.info.origin.position.x = math.nan
    return message


def all_that_plan():
    processors = ["external_command/%sProcessor" % name for name in
                  ("LaneFollowCommand", "ValetParkingCommand", "FreeSpaceCommand", "PreciseParkingCommand",
                   "ZoneCoverCommand")]
    own = {"processors": processors, "map_file": TOWN, "base_frame": "grid_vehicle"}
    parameters = {name + "_command_processor": patient(name + "_command_processor", obstacle_grid_name="grid")
                  for name in SERVICES}
    return Component(NAMESPACE, dict(parameters, external_command=own))


def commands():
    """Of each service one that asks for a grid, from where the vehicle stands off the lanes."""
    start = dict(is_start_pose_set=True, way_point=[START], dry_run=True)
    near = Pose(x=BESIDE_THE_ROAD.x, y=BESIDE_THE_ROAD.y - 5.0, heading=1.5, has_heading=True)
    return {
        "lane_follow": LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True),
        "valet_parking": ValetParkingCommand(parking_spot_id=SPACE, **start),
        "free_space": FreeSpaceCommand(parking_spot_pose=near, dry_run=True),
        "precise_parking": PreciseParkingCommand(parking_spot_pose=Pose(x=322.0, y=110.0, has_heading=True),
                                                 parking_inwards=True, **start),
        "zone_cover": ZoneCoverCommand(zone_cover_area_id="yard", swath_width=5.0, **start)}


class ObstacleGridTest(support.TestCase):
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

    def test_what_is_no_grid_counts_as_missing_and_says_why(self):
        wrong = [(broken(width=41), "holds 1600 values; its size of 41 x 40 needs 1640"),
                 (broken(width=0, height=0), "0 x 0 cells"),
                 (broken(resolution=0.0), "resolution is 0 m"),
                 (broken(resolution=math.nan), "resolution is nan m"),
                 (without_place(), "origin is not finite")]
        localization = Localization(BESIDE_THE_ROAD.x, BESIDE_THE_ROAD.y, BESIDE_THE_ROAD.heading, child="grid_vehicle")
        localization.start()
        with all_that_plan() as component:
            readiness = support.Collector(NAMESPACE + "/external_command/readiness", Readiness)
            for message, words in wrong:
                self.assert_unmet(readiness, message, words)
                self.assert_refused(component, message, words)
            good = grid(BESIDE_THE_ROAD, 0)
            self.wait_for_condition(readiness, good, lambda condition: condition.is_met)
            self.assert_taken(component, good)
        localization.stop()

    def wait_for_condition(self, readiness, message, is_so):
        """Publishes `message` until the readiness of the grid is so."""
        def is_told():
            self.publish_now(message)
            told = [c for m in readiness.messages[-1:] for c in m.conditions if c.name == "obstacle_grid"]
            return bool(told) and is_so(told[0])
        support.wait_until(is_told, "the readiness of the grid")

    def publish_now(self, message):
        message.header.stamp = rospy.Time.now()
        self.publisher.publish(message)

    def assert_unmet(self, readiness, message, words):
        self.wait_for_condition(readiness, message, lambda condition: not condition.is_met and words in condition.message)

    def answer(self, component, name, message, is_so):
        """The answer to a command beside the grid `message`, which may come after it: asked for until it is so."""
        call = component.service("external_command/" + name, SERVICES[name])
        answers = []

        def is_answered():
            self.publish_now(message)
            answers.append(call(commands()[name]).status)
            return is_so(answers[-1])
        support.wait_until(is_answered, lambda: "%s; the last answer: %s" % (name, support.describe(answers[-1])))
        return answers[-1]

    def assert_refused(self, component, message, words):
        for name in SERVICES:
            with self.subTest(name=name, words=words):
                status = self.answer(component, name, message, lambda status: words in status.message)
                self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
                self.assertIn("the obstacle grid on grid cannot be used", status.message)

    def assert_taken(self, component, message):
        for name in SERVICES:
            with self.subTest(name=name):
                self.answer(component, name, message, lambda status: status.status == CommandStatus.FINISHED)


if __name__ == "__main__":
    rospy.init_node("obstacle_grid_test")
    rostest.rosrun("external_command", "obstacle_grid", ObstacleGridTest)
