#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Small maps and paths on which an obvious answer would be wrong: what is right on each, through the running component.

Those of ../shared/data/cases are skipped where that folder is not there; the others are drawn here.
"""
import dataclasses
import math
import os
import tempfile
import unittest

import rospkg
import rospy
import rostest
import yaml
from genpy.message import fill_message_args
from nav_msgs.msg import Path

import support
from component import LANE_FOLLOW, Component
from external_command import bicycle, path_check
from external_command.msg import (CommandStatus, LaneFollowCommand, LaneWaypoint, Passage, PathPoint, PlanningCommand,
                                  Pose, RoutingRequest, ValetParkingCommand)
from external_command.srv import LaneFollow, ValetParking
from localization import Localization

PACKAGE = rospkg.RosPack().get_path("external_command")
CASES = os.path.join(PACKAGE, "..", "shared", "data", "cases")
TOWN = os.path.join(PACKAGE, "maps", "demo_town", "base_map.bin")
VALET_PARKING = "external_command/ValetParkingCommandProcessor"
PATH_FOLLOW = "external_command/PathFollowCommandProcessor"
ADAPTER = "external_command/OldRoutingAdapter"
NAMESPACE = "/case_maps"


def limits():
    """Those of the vehicle that the component is told of."""
    with open(os.path.join(PACKAGE, "config", "vehicle.yaml"), encoding="utf-8") as file:
        stated = yaml.safe_load(file)
    names = [field.name for field in dataclasses.fields(bicycle.VehicleLimits)]
    return bicycle.VehicleLimits(**{name: stated[name] for name in names if name in stated})


LIMITS = limits()


def case(name):
    path = os.path.join(CASES, name)
    if not os.path.exists(path):
        raise unittest.SkipTest("%s is not there" % path)
    return path


def component_on(map_file, *processors, **parameters):
    own = {"processors": list(processors or (LANE_FOLLOW,)), "map_file": map_file}
    return Component(NAMESPACE, dict(parameters, external_command=own))


def lane(name, z, *points):
    line = " ".join("point { x: %g y: %g z: %g }" % (x, y, z) for x, y in points)
    curve = "central_curve { segment { line_segment { %s } } }" % line
    return 'lane { id { id: "%s" } %s type: CITY_DRIVING }\n' % (name, curve)


class DrawnMap:
    """A map file of the test's own."""

    def __init__(self, text):
        self._file = tempfile.NamedTemporaryFile("w", suffix=".txt")
        self._file.write(text)
        self._file.flush()

    def __enter__(self):
        return self._file.name

    def __exit__(self, *_):
        self._file.close()


class CaseMapsTest(support.TestCase):
    def setUp(self):
        self.vehicle = Localization(0.0, 0.0)
        self.vehicle.start()
        self.addCleanup(self.vehicle.stop)

    def follow(self, component, start, end, way=(), **fields):
        """The answer to a dry run of a vehicle at `start` (x, y, heading)."""
        self.vehicle.x, self.vehicle.y, self.vehicle.heading = (tuple(start) + (0.0, 0.0))[:3]
        return self._once_known(component.service("external_command/lane_follow", LaneFollow), LaneFollowCommand(
            end_pose=end, way_point=list(way), dry_run=True, **fields))

    def _once_known(self, call, command):
        """The answer with the pose that the vehicle has now: the component hears of it in its own time."""
        answers = []

        def is_there():
            answers.append(call(command))
            points = answers[-1].path.points
            here = (self.vehicle.x, self.vehicle.y)
            return answers[-1].status.error_code != CommandStatus.NOT_READY and (
                not points or math.hypot(points[0].x - here[0], points[0].y - here[1]) < 0.01)
        support.wait_until(is_there, "the component knows the pose")
        return answers[-1]

    def assert_driven(self, answer, distance, lanes=None, within=0.6):
        self.assertEqual(answer.status.error_code, CommandStatus.OK, support.describe(answer.status))
        self.assertAlmostEqual(answer.report.route_length, distance, delta=within)
        if lanes:
            self.assertEqual(answer.report.lane_ids, lanes)
        self.assertEqual(path_check.faults(answer.path.points, LIMITS), [])

    def assert_refused(self, answer, code, *words):
        self.assertEqual(answer.status.error_code, code, support.describe(answer.status))
        for word in words:
            self.assertIn(word, answer.status.message)

    def test_ten_centimetres_beside_a_lane_do_not_lead_round_the_block(self):
        with component_on(TOWN) as component:
            for y in (194.65, 194.75, 194.85):
                self.assert_driven(self.follow(component, (203.0, y), Pose(x=280.0, y=194.75)), 77.0)

    def test_what_lies_just_behind_counts_as_reached(self):
        with component_on(TOWN) as component:
            self.assert_driven(self.follow(component, (90.0, 194.75), Pose(x=89.999, y=194.75)), 0.0)
            for behind in ([0.0, 0.001], [0.0, 0.4, 0.8, 1.2]):
                way = [Pose(x=120.0 - offset, y=194.75) for offset in behind]
                self.assert_driven(self.follow(component, (90.0, 194.75), Pose(x=150.0, y=194.75), way), 60.0)

    def test_an_unknown_parking_space_or_lane_offers_the_nearest(self):
        self.vehicle.x, self.vehicle.y = 90.0, 194.75
        with component_on(TOWN, LANE_FOLLOW, VALET_PARKING) as component:
            park = component.service("external_command/valet_parking", ValetParking)
            self.assert_refused(park(ValetParkingCommand(parking_spot_id="n_out5", dry_run=True)),
                                CommandStatus.INVALID_REQUEST, "n_out_5")
            town_lane = self.follow(component, (90.0, 194.75), Pose(x=150.0, y=194.75)).report.lane_ids[0]
            goal = Pose(x=150.0, y=194.75, lane_id=town_lane + "x")
            self.assert_refused(self.follow(component, (90.0, 194.75), goal), CommandStatus.INVALID_REQUEST,
                                "end_pose names lane", "did you mean", town_lane)

    def test_fork(self):
        with component_on(case("fork.txt")) as component:
            end = Pose(x=60.0)
            self.assert_driven(self.follow(component, (1.0, -0.1, -0.05), end), 59.0, ["straight", "out_e"])
            way = [Pose(x=1.0, y=-0.1)]
            self.assert_driven(self.follow(component, (-20.0, 0.0), end, way), 80.0, ["in", "straight", "out_e"])
            pinned = Pose(x=1.0, y=-0.1, lane_id="right")
            self.assert_refused(self.follow(component, (-20.0, 0.0), end, [pinned]), CommandStatus.NO_ROUTE, "right")

    def test_two_way_lane(self):
        with component_on(case("two_way_lane.txt")) as component:
            self.assert_driven(self.follow(component, (150.0, 0.0, math.pi), Pose(x=50.0)), 100.0, ["west"])

    def test_bidirection(self):
        with component_on(case("bidirection.txt")) as component:
            self.assert_driven(self.follow(component, (150.0, 0.0, math.pi), Pose(x=50.0)), 100.0, ["two_way"])
            self.assert_driven(self.follow(component, (50.0, 0.0), Pose(x=150.0)), 100.0, ["two_way"])

    def test_missing_link(self):
        with component_on(case("missing_link.txt")) as component:
            self.assert_refused(self.follow(component, (5.0, 0.0), Pose(x=140.0)), CommandStatus.NO_ROUTE,
                                "lane lane_26 ends where lane lane_48 begins", "the map does not link them")

    def test_overlap(self):
        with component_on(case("overlap.txt")) as component:
            answer = self.follow(component, (5.0, 0.0), Pose(x=90.0))
            self.assert_driven(answer, 85.0, ["a", "b"])
            self.assertLess(max(abs(point.y) for point in answer.path.points), 0.05)

    def test_swapped_neighbours(self):
        with component_on(case("swapped_neighbours.txt")) as component:
            self.vehicle.x = 5.0
            answer = self.follow(component, (5.0, 0.0), Pose(x=190.0, y=-3.5))
            self.assert_driven(answer, 185.0, ["A", "B"])
            self.assertAlmostEqual(answer.path.points[-1].y, -3.5, places=3)
            commands = support.Collector(NAMESPACE + "/planning/command", PlanningCommand)
            component.service("external_command/lane_follow", LaneFollow)(
                LaneFollowCommand(end_pose=Pose(x=190.0, y=-3.5)))
            route = commands.wait_for(lambda m: m.has_lane_follow_command, "the command").lane_follow_command
            self.assertIn(Passage.RIGHT, [p.change_lane_type for road in route.road for p in road.passage])
            self.assertNotIn(Passage.LEFT, [p.change_lane_type for road in route.road for p in road.passage])
            self.assertIn("on the other side than the map states", component.output)

    def test_parking_spaces_drawn_wrong(self):
        with component_on(case("parking.txt"), VALET_PARKING) as component:
            self.vehicle.x = 2.0
            park = component.service("external_command/valet_parking", ValetParking)
            answers = {name: self._once_known(park, ValetParkingCommand(parking_spot_id=name, dry_run=True))
                       for name in ("deg", "tiny", "rect")}
            self.assertIn("heading is in degrees", component.output)
        for name in ("deg", "rect"):
            self.assertEqual(answers[name].status.error_code, CommandStatus.OK, support.describe(answers[name].status))
            self.assertAlmostEqual(abs(answers[name].path.points[-1].heading), math.pi / 2.0, delta=0.06)
            self.assertEqual(path_check.faults(answers[name].path.points, LIMITS), [])
        self.assert_refused(answers["tiny"], CommandStatus.GOAL_BLOCKED, "tiny", "too small for the vehicle")

    def test_paths_of_other_programs(self):
        north, west = ((5.0, 5.0), (5.0, 24.0)), ((5.0, 5.0), (-14.0, 5.0))
        ends = {"path_west_identity": west, "path_north_navfn": north, "path_north_zero": north,
                "path_goal_repeated": None, "path_slash_map": None}
        with component_on("", PATH_FOLLOW, path_follow_command_processor={"input_path_name": "plan"}):
            commands = support.Collector(NAMESPACE + "/planning_command_history", PlanningCommand)
            publisher = rospy.Publisher(NAMESPACE + "/plan", Path, queue_size=10)
            support.wait_until(lambda: publisher.get_num_connections() > 0, "somebody takes the path")
            for name, wanted in ends.items():
                with self.subTest(name), open(case(name + ".yaml"), encoding="utf-8") as file:
                    given = Path()
                    fill_message_args(given, [yaml.safe_load(file)])
                    before = len(commands.messages)
                    publisher.publish(given)
                    support.wait_until(lambda: len(commands.messages) > before, "the path of %s is taken" % name)
                    points = commands.messages[-1].path.points
                    self.assertEqual({point.direction for point in points}, {PathPoint.FORWARD})
                    self.assertEqual(path_check.faults(points, LIMITS), [])
                    first, last = given.poses[0].pose.position, given.poses[-1].pose.position
                    for point, end in zip((points[0], points[-1]), wanted or ((first.x, first.y), (last.x, last.y))):
                        self.assertLess(math.hypot(point.x - end[0], point.y - end[1]), 0.01)

    def test_decks_are_told_apart_by_height(self):
        east = [(0.0, 0.0), (50.0, 0.0), (100.0, 0.0)]
        with DrawnMap(lane("lower", 1.0, *east) + lane("upper", 7.0, *[(x, 0.3) for x, _ in east])) as path:
            with component_on(path) as component:
                self.vehicle.z = 6.8
                self.assert_driven(self.follow(component, (10.0, 0.0), Pose(x=90.0)), 80.0, ["upper"])
                self.vehicle.z = 1.2
                support.wait_until(lambda: self.follow(component, (10.0, 0.0), Pose(x=90.0)).report.lane_ids ==
                                   ["lower"], "the vehicle is on the lower deck")
                for z in (1.0, 0.0):
                    goal = Pose(x=90.0, y=0.3, z=z, has_z=True)
                    self.assert_driven(self.follow(component, (10.0, 0.0), goal), 80.0, ["lower"])
                refused = self.follow(component, (10.0, 0.0), Pose(x=90.0, z=7.0, has_z=True))
                self.assert_refused(refused, CommandStatus.NO_ROUTE, "lower", "upper")
                refused = self.follow(component, (10.0, 0.0), Pose(x=90.0, z=math.nan, has_z=True))
                self.assert_refused(refused, CommandStatus.INVALID_REQUEST, "end_pose.z")

    def test_a_legacy_way_point_keeps_to_the_lane_that_it_names(self):
        points = [(0.0, 0.0), (50.0, 0.0), (100.0, 0.0)]
        text = lane("a", 0.0, *points) + lane("b", 0.0, *points) + lane("c", 0.0, *points)
        with DrawnMap(text) as path, component_on(path, LANE_FOLLOW, ADAPTER):
            self.vehicle.x = 10.0
            commands = support.Collector(NAMESPACE + "/planning_command_history", PlanningCommand)
            requests = rospy.Publisher(NAMESPACE + "/routing_request", RoutingRequest, queue_size=10)
            support.wait_until(lambda: requests.get_num_connections() > 0, "somebody takes requests")
            for name in ("a", "b", "c"):
                before = len(commands.messages)
                requests.publish(RoutingRequest(is_start_pose_set=True, waypoint=[LaneWaypoint(id=name, s=10.0),
                                                                                 LaneWaypoint(id=name, s=90.0)]))
                support.wait_until(lambda: len(commands.messages) > before, "a command")
                route = commands.messages[-1].lane_follow_command
                self.assertEqual([p.segment[0].id for road in route.road for p in road.passage if p.can_exit], [name])


if __name__ == "__main__":
    rospy.init_node("case_maps_test")
    rostest.rosrun("external_command", "case_maps", CaseMapsTest)
