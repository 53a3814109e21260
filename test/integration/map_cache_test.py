#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A large map is kept for the next start, which says so and gives the same routes; whatever becomes of the file."""
import glob
import os
import shutil
import subprocess
import tempfile
import unittest

import rospkg
import rospy
import rostest
from geometry_msgs.msg import Point

import support
from component import LANE_FOLLOW, Component
from external_command.msg import CommandStatus, LaneFollowCommand, MapObject
from external_command.srv import FindMapObjects, FindMapObjectsRequest, LaneFollow
from localization import Localization

NAMESPACE = "/map_cache_test"
PACKAGE = rospkg.RosPack().get_path("external_command")
FROM_CACHE = " s from its cache "
KEPT = "kept for the next start in"


class MapCacheTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="map_cache_")
        cls.map_file = os.path.join(cls.folder, "city.bin")
        subprocess.run(["/usr/bin/python3", os.path.join(PACKAGE, "scripts", "make_city_map"), "--lanes", "5000",
                        "--output", cls.map_file], check=True)
        cls.vehicle = Localization(0.0, 0.0)
        cls.vehicle.start()

    @classmethod
    def tearDownClass(cls):
        cls.vehicle.stop()
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.ros_home = os.path.join(self.folder, self.id())

    def started(self, **parameters):
        own = dict({"processors": [LANE_FOLLOW], "map_file": self.map_file}, **parameters)
        return Component(NAMESPACE, {"external_command": own}, {"ROS_HOME": self.ros_home})

    def files(self):
        return glob.glob(os.path.join(self.ros_home, "external_command", "maps", "*"))

    def first_start(self):
        """The route of a start without a cache, which is there on return."""
        with self.started() as component:
            route = self.route(component)
            support.wait_until(lambda: KEPT in component.output, "the map is kept")
            self.assertNotIn(FROM_CACHE, component.output)
        self.assertEqual(len(self.files()), 1)
        return route

    def route(self, component):
        """Across the city: what a dry run answers, without times."""
        find = component.service("external_command/map_objects", FindMapObjects)
        ends = [find(FindMapObjectsRequest(kind=MapObject.LANE, is_near=True, point=Point(x, y, 0.0),
                                           max_count=1)).objects[0].pose for x, y in ((150.0, 150.0), (1000.0, 1000.0))]
        call = component.service("external_command/lane_follow", LaneFollow)
        command = LaneFollowCommand(dry_run=True, is_start_pose_set=True, way_point=ends[:1], end_pose=ends[1])
        answers = []

        def is_answered():
            answers.append(call(command))
            return answers[-1].status.error_code != CommandStatus.NOT_READY
        support.wait_until(is_answered, "the vehicle is known")
        answer = answers[-1]
        self.assertEqual(answer.status.error_code, CommandStatus.OK, support.describe(answer.status))
        self.assertGreater(len(answer.report.lane_ids), 10)
        return answer.report.lane_ids, answer.report.route_length, [(p.x, p.y, p.s) for p in answer.path.points]

    def test_the_second_start_is_from_the_cache_and_gives_the_same_route(self):
        route = self.first_start()
        with self.started() as component:
            self.assertEqual(self.route(component), route)
            self.assertIn(FROM_CACHE + self.files()[0], component.output)
            self.assertNotIn(KEPT, component.output)

    def test_a_damaged_cache_is_told_of_and_written_anew(self):
        route = self.first_start()
        with open(self.files()[0], "r+b") as file:
            file.seek(1000)
            byte = file.read(1)
            file.seek(1000)
            file.write(bytes([byte[0] ^ 4]))
        with self.started() as component:
            self.assertEqual(self.route(component), route)
            support.wait_until(lambda: KEPT in component.output, "the map is kept")
            self.assertIn("is damaged", component.output)
            self.assertIn("WARN", component.output)
            self.assertNotIn(FROM_CACHE, component.output)
        with self.started() as component:
            self.assertEqual(self.route(component), route)
            self.assertIn(FROM_CACHE, component.output)

    def test_other_parameters_are_told_of_and_the_only_file_is_written_anew(self):
        self.first_start()
        with self.started(map_origin="auto") as component:
            support.wait_until(lambda: KEPT in component.output, "the map is kept")
            self.assertIn("other parameters", component.output)
        self.assertEqual(len(self.files()), 1)

    def test_what_was_not_used_for_long_is_removed(self):
        self.first_start()
        kept = self.files()[0]
        old, used = (os.path.join(os.path.dirname(kept), name + "-0123456789abcdef.cache") for name in ("old", "used"))
        for path in (old, used):
            shutil.copyfile(kept, path)
        os.utime(old, (0.0, 0.0))
        with self.started(map_origin="auto") as component:
            support.wait_until(lambda: old + ": removed" in component.output, "it is told")
        self.assertEqual(sorted(self.files()), sorted([kept, used]))

    def test_nothing_is_kept_where_that_is_said(self):
        with self.started(map_cache_folder="none") as component:
            self.route(component)
        self.assertEqual(self.files(), [])

    def test_a_folder_that_cannot_be_written_is_told_of(self):
        blocked = os.path.join(self.folder, "a_file")
        with open(blocked, "w", encoding="utf-8") as file:
            file.write("x")
        with self.started(map_cache_folder=blocked + "/maps") as component:
            self.route(component)
            support.wait_until(lambda: "not kept for the next start" in component.output, "it is told")
            self.assertIn("~map_cache_folder", component.output)
            self.assertTrue(component.is_running)


if __name__ == "__main__":
    rospy.init_node("map_cache_test")
    rostest.rosrun("external_command", "map_cache", MapCacheTest)
