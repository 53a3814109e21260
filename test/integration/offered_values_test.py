#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every value that a comment in config/ and launch/ offers for a parameter can be set, and does what is said."""
import json
import os
import re
import unittest

import rospkg
import rospy
import rostest
import yaml

import support
from component import Component, configuration
from external_command.msg import CommandStatus, FreeSpaceCommand, Pose, RoiPolygon, ValetParkingCommand, ZoneCoverCommand
from external_command.srv import FreeSpace, ValetParking, ZoneCover
from geometry_msgs.msg import Point
from localization import Localization
from processes import Launch

ROOT = rospkg.RosPack().get_path("external_command")
MAP = os.path.join(ROOT, "maps", "demo_town", "base_map.bin")
NAMESPACE = "/offered_values_test"
ADAPTER = "external_command/MoveBaseAdapter"
MANOEUVRES = ("lane_follow", "valet_parking", "free_space", "precise_parking", "zone_cover")

# Parameters with words for values, and those whose comment says what true, false, empty or a number means.
OFFERED = {
    "external_command/map_origin": ["none", "auto", [60.0, 60.0]],
    "external_command/map_file": [MAP],
    "external_command/map_cache_folder": ["", "none"],
    "external_command/arrival": ["reported", "pose", "both"],
    "external_command/planning_threads": [0, 2],
    "external_command/limits/geofence": [[], [[-500, -500], [1500, -500], [1500, 1500], [-500, 1500]]],
    "external_command/limits/max_goal_distance": [0.0, 2000.0],
    "external_command/limits/max_speed": [0.0, 5.0],
    "external_command/require_all": [True, False],
    "external_command/diagnostics_use_fqn": [False, True],
    "external_command/routing/refuse_undrivable": [False, True],
    "external_command/routing/max_path_start_distance": [0.0, 500.0],
    "lane_follow_command_processor/actions": [True, False],
    "lane_follow_command_processor/allowed_callers": [[], ["/offered_values_test"]],
    "lane_follow_command_processor/obstacle_grid_name": ["", "grid"],
    "lane_follow_command_processor/max_grid_age": [0.0, 2.0],
    "free_space_command_processor/free_space/planner":
        ["portfolio", "hybrid_astar", "rrtconnect", "rrtstar", "kpiece"],
    "free_space_command_processor/free_space/continuous_curvature": [False, True],
    "free_space_command_processor/max_goal_distance": [0.0, 500.0],
    "valet_parking_command_processor/parking_direction": ["cheaper", "nose_in", "backing_in"],
    "zone_cover_command_processor/coverage/headland_laps": [-1, 1],
    "zone_cover_command_processor/coverage/headland_first": [True, False],
    "zone_cover_command_processor/coverage/objective": ["shortest", "fewest_turns"],
    "zone_cover_command_processor/coverage/max_gap": [4.0, 0.0],
    "zone_cover_command_processor/coverage/turn_speed": [2.0, 0.0],
    "zone_cover_command_processor/coverage/reverse_to_turn": [False, True],  # with one lap there is no room
    "zone_cover_command_processor/progress_folder": [""],
    "path_follow_command_processor/input_path_name": ["", "a_path"],
    "path_follow_command_processor/max_start_distance": [0.0, 500.0],
    "move_base_adapter/service": ["lane_follow", "lane_follow", "free_space", "precise_parking"],
    "move_base_adapter/service_name": [""],
    "move_base_adapter/use_heading": [True, False, True, True],  # False for lane_follow only
}
ELSEWHERE = {  # parameter: the test in which its values are set
    "lane_follow_command_processor/enabled": "hostile_requests_test.py",
    "old_routing_adapter/goal_name": "old_routing.test",
    "move_base_adapter/goal_name": "move_base.test",
}
VARIANTS = max(map(len, OFFERED.values()))


def commented_parameters():
    """{parameter: comment} of config/external_command.yaml; lines of a comment that goes on are joined."""
    found, path = {}, []
    with open(os.path.join(ROOT, "config", "external_command.yaml"), encoding="utf-8") as file:
        for line in file:
            key = re.match(r"^( *)(\w+):", line)
            comment = line.partition("#")[2].strip()
            if key:
                path = path[:len(key.group(1)) // 2] + [key.group(2)]
                found["/".join(path)] = comment
            elif path and comment:
                found["/".join(path)] += " " + comment
    return found


def offers_values(comment):
    """That says what a certain value means, `0: none` for example, or lists words."""
    return re.search(r"(^|\W)(true|false|empty|-?\d+): |\bor \w+(, \w+)*$|, or |^or | for example", comment)


class Variant(Component):
    """The gateway with the `number`th of the values of each parameter, or the first again where there are fewer."""

    def __init__(self, number):
        parameters = json.loads(json.dumps(configuration(more_processors=[ADAPTER])))  # the file's aliases become parameters of their own
        for name in MANOEUVRES:
            parameters[name + "_command_processor"]["free_space"]["time_budget"] = 60.0
        parameters["zone_cover_command_processor"]["coverage"]["time_budget"] = 60.0
        self.values = {name: values[number % len(values)] for name, values in OFFERED.items()}
        for name, value in self.values.items():
            *tree, key = name.split("/")
            place = parameters
            for part in tree:
                place = place[part]
            place[key] = value
        self.number = number
        super().__init__(NAMESPACE, parameters)

    @property
    def origin(self):
        """What is subtracted from the map's coordinates."""
        support.wait_until(lambda: "is ready" in self.output or not self.is_running, "it is ready")
        assert self.is_running, self.output
        return rospy.get_param(NAMESPACE + "/external_command/map_origin_resolved")


class OfferedValuesTest(unittest.TestCase):
    def plan(self, gateway, name, service_type, command):
        """The answer to a dry run, asked for again until the vehicle's pose is known."""
        call = gateway.service("external_command/" + name, service_type)
        command.dry_run = True
        support.wait_until(lambda: call(command).status.error_code != CommandStatus.NOT_READY, "it is ready to plan")
        answer = call(command)
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, (gateway.values, support.describe(answer.status)))
        return answer

    def assert_plans(self, gateway, x, y):
        """From (x, y) on a lane of the town, heading east; what depends on fewer parameters, only where these are new."""
        wall = RoiPolygon(points=[Point(x + 8.0, y - 3.0, 0.0), Point(x + 9.0, y - 3.0, 0.0), Point(x + 9.0, y + 9.0, 0.0)])
        self.plan(gateway, "free_space", FreeSpace, FreeSpaceCommand(
            parking_spot_pose=Pose(x=x + 25.0, y=y, has_heading=True), non_drivable_roi=[wall]))
        if gateway.number < len(OFFERED["valet_parking_command_processor/parking_direction"]):
            self.assert_parks(gateway)
        if gateway.number < len(OFFERED["zone_cover_command_processor/coverage/objective"]):
            self.assert_sweeps(gateway, x, y)

    def assert_parks(self, gateway):
        parked = self.plan(gateway, "valet_parking", ValetParking, ValetParkingCommand(parking_spot_id="n_out_5"))
        direction = gateway.values["valet_parking_command_processor/parking_direction"]
        if direction != "cheaper":
            self.assertEqual(parked.path.points[-1].direction, 1 if direction == "nose_in" else -1)

    def assert_sweeps(self, gateway, x, y):
        zone = [(-5.0, -20.0), (50.0, -20.0), (50.0, 20.0), (-5.0, 20.0)]  # with room to turn forward
        swept = self.plan(gateway, "zone_cover", ZoneCover, ZoneCoverCommand(
            drivable_roi=RoiPolygon(points=[Point(x + dx, y + dy, 0.0) for dx, dy in zone])))
        self.assertGreater(swept.report.coverage_ratio, 0.8)

    def test_a_gateway_plans_with_every_value(self):
        localization = Localization(0.0, 0.0)
        localization.start()
        for number in range(VARIANTS):
            with Variant(number) as gateway:
                origin = gateway.origin
                localization.x, localization.y = 90.0 - origin[0], 194.75 - origin[1]
                wanted = gateway.values["external_command/map_origin"]
                if isinstance(wanted, list):
                    self.assertEqual(origin, wanted)
                else:
                    self.assertEqual(origin == [0.0, 0.0], wanted == "none")
                self.assert_plans(gateway, localization.x, localization.y)
                self.assertNotIn("nothing reads it", gateway.output)
        localization.stop()

    def test_the_launch_file_takes_the_origins_that_it_offers(self):
        for origin in ("auto", "[60.0, 60.0]"):
            with Launch("external_command_process.launch", ns=NAMESPACE[1:] + "_launched", map=MAP, map_origin=origin):
                name = NAMESPACE + "_launched/external_command/map_origin_resolved"
                support.wait_until(lambda: rospy.has_param(name), "it is up")  # pylint: disable=cell-var-from-loop
                resolved = rospy.get_param(name)
            self.assertNotEqual(resolved, [0.0, 0.0], origin)
            if origin != "auto":
                self.assertEqual(resolved, yaml.safe_load(origin))
            rospy.delete_param(NAMESPACE + "_launched")

    def test_no_value_is_offered_that_is_not_set_here(self):
        known = set(OFFERED) | set(ELSEWHERE)
        last_parts = {name.split("_command_processor/")[-1] for name in known}
        offering = {name for name, comment in commented_parameters().items() if offers_values(comment)}
        self.assertGreater(len(offering), 15)
        self.assertEqual({name for name in offering - known if name.split("_command_processor/")[-1] not in last_parts}, set())
        for name, file in ELSEWHERE.items():
            with open(os.path.join(ROOT, "test", "integration", file), encoding="utf-8") as text:
                self.assertIn(name.rsplit("/", 1)[1].replace("goal_name", "goal"), text.read())


if __name__ == "__main__":
    rospy.init_node("offered_values_test")
    rostest.rosrun("external_command", "offered_values", OfferedValuesTest)
