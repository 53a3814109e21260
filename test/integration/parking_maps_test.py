#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Valet parking on maps that name no lanes for their parking spaces, and on one of a real car park."""
import math
import os
import re
import tempfile
import unittest

import rospkg
import rospy
import rostest

import support
from component import Component, patient
from external_command import map_file
from external_command.msg import CommandStatus, Pose, ValetParkingCommand
from external_command.srv import ValetParking

PACKAGE = rospkg.RosPack().get_path("external_command")
TOWN = os.path.join(PACKAGE, "maps", "demo_town", "base_map.txt")
CAR_PARK = os.path.join(PACKAGE, "..", "shared", "data", "maps", "autonomoustuff", "base_map.bin")
# Some spaces of it are drawn too narrow or on top of others, or lie where no lane leads to from the start.
MAY_BE = (CommandStatus.OK, CommandStatus.NO_ROUTE, CommandStatus.GOAL_BLOCKED, CommandStatus.NO_PATH)
OVERLAPS = re.compile(r"^overlap \{\n.*?^\}\n|^  overlap_id \{\n.*?^  \}\n", re.MULTILINE | re.DOTALL)


def space(name, corners, heading):
    points = " ".join("point { x: %g y: %g }" % corner for corner in corners)
    return 'parking_space { id { id: "%s" } polygon { %s } heading: %r }\n' % (name, points, heading)


def valet_parking_on(path):
    processors = ["external_command/ValetParkingCommandProcessor"]
    return Component("/parking_maps", {"external_command": {"processors": processors, "map_file": path},
                                       "valet_parking_command_processor": patient("valet_parking_command_processor")})


class ParkingMapsTest(unittest.TestCase):
    def plan(self, component, start, space):
        """The answer to a dry run from the lane nearest to `start`."""
        call = component.service("external_command/valet_parking", ValetParking)
        return call(ValetParkingCommand(parking_spot_id=space, is_start_pose_set=True, way_point=[start],
                                        dry_run=True))

    def test_without_overlaps_the_lanes_are_chosen_by_distance_and_a_warning_says_so(self):
        with open(TOWN, encoding="utf-8") as file:
            text = file.read()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "base_map.txt")
            with open(path, "w", encoding="utf-8") as file:
                file.write(OVERLAPS.sub("", text))
            with valet_parking_on(TOWN) as component:
                with_overlaps = self.plan(component, Pose(x=90.0, y=195.0), "n_out_10")
            with valet_parking_on(path) as component:
                without = self.plan(component, Pose(x=90.0, y=195.0), "n_out_10")
        self.assertEqual(without.status.status, CommandStatus.FINISHED, support.describe(without.status))
        self.assertTrue([w for w in without.report.warnings if "n_out_10" in w and "parking_lane_radius" in w])
        self.assertEqual(without.report.lane_ids[-1], with_overlaps.report.lane_ids[-1])
        self.assertEqual([w for w in with_overlaps.report.warnings if "overlap" in w], [])

    def test_spaces_of_a_real_car_park_can_be_driven_to(self):
        if not os.path.exists(CAR_PARK):
            self.skipTest("there is no map " + CAR_PARK)
        car_park = map_file.load_format(os.path.join(PACKAGE, "proto")).Map()
        with open(CAR_PARK, "rb") as file:
            car_park.ParseFromString(file.read())
        self.assertEqual(len(car_park.parking_space), 236)
        first = car_park.parking_space[0].polygon.point[0]
        with valet_parking_on(CAR_PARK) as component:
            spaces = car_park.parking_space[::20]
            answers = [self.plan(component, Pose(x=first.x, y=first.y), space.id.id.decode()) for space in spaces]
        for answer in answers:
            self.assertIn(answer.status.error_code, MAY_BE, support.describe(answer.status))
            self.assertEqual([w for w in answer.report.warnings if "overlap" in w], [])
        planned = [answer for answer in answers if answer.status.status == CommandStatus.FINISHED]
        self.assertGreater(len(planned), 0.9 * len(answers))

    def test_spaces_that_are_drawn_wrong_are_mended_or_refused(self):
        lane = 'lane { id { id: "a" } central_curve { segment { line_segment { %s } } } length: 200 type: CITY_DRIVING }\n'
        text = lane % " ".join("point { x: %d y: 0 }" % x for x in range(0, 201, 20))
        text += space("deg", [(50, -8.5), (52.7, -8.5), (52.7, -3), (50, -3)], -90.0)
        text += space("crossed", [(80, -8.5), (82.7, -3), (82.7, -8.5), (80, -3)], -math.pi / 2.0)
        text += space("tiny", [(110, -5), (111, -5), (111, -3), (110, -3)], -math.pi / 2.0)
        text += space("line", [(130, -5), (140, -5), (150, -5)], -math.pi / 2.0)
        text += space("tight", [(160, -8.5), (162.4, -8.5), (162.4, -3), (160, -3)], -math.pi / 2.0)
        text += space("over", [(162.2, -8.5), (165, -8.5), (165, -7), (162.2, -7)], -math.pi / 2.0)
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(text)
            file.flush()
            with valet_parking_on(file.name) as component:
                answers = {name: self.plan(component, Pose(x=5.0, y=0.0), name)
                           for name in ("deg", "crossed", "tiny", "line", "tight")}
                output = component.output
        for name in ("deg", "crossed", "tight"):
            answer = answers[name]
            self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
            self.assertAlmostEqual(abs(math.sin(answer.path.points[-1].heading)), 1.0, places=2)
        self.assertTrue([w for w in answers["tight"].report.warnings if "parking_position_tolerance" in w])
        self.assertEqual(answers["deg"].report.warnings[1:], [])
        self.assertEqual(answers["tiny"].status.error_code, CommandStatus.GOAL_BLOCKED)
        self.assertIn("2.00 m long and 1.00 m wide", answers["tiny"].status.message)
        self.assertEqual(answers["line"].status.error_code, CommandStatus.INVALID_REQUEST)
        self.assertIn("cannot be used", answers["line"].status.message)
        for words in ("heading is in degrees", "crossed order", "smaller than the vehicle", "the smallest is tiny"):
            self.assertIn(words, output)


if __name__ == "__main__":
    rospy.init_node("parking_maps_test")
    rostest.rosrun("external_command", "parking_maps", ParkingMapsTest)
