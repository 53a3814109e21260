#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rviz with the panel and the tools, used by mouse and keys: drag, click, send, STOP."""
import os
import sys
import unittest

import rosgraph
import rospkg
import rospy
import rostest
from visualization_msgs.msg import Marker, MarkerArray

ROOT = rospkg.RosPack().get_path("external_command")
sys.path.insert(0, os.path.join(ROOT, "test/integration"))

import support  # noqa: E402
from screen import Screen, missing_programs  # noqa: E402
from vehicle import Vehicle  # noqa: E402
from external_command.msg import CommandStatus, MapObject  # noqa: E402
from external_command.srv import FindMapObjects, GetCurrentCommand  # noqa: E402

CONFIG = os.path.join(ROOT, "rviz/external_command.rviz")
DRY_RUN_COLOUR = (51, 255, 255)
# Keycodes of F1 and F4: of their names xdotool makes Alt+F1 and Alt+F4 with the keyboards of xkb-data from 2.44 on.
LANE_FOLLOW, VALET_PARKING = "67", "70"
DRIVING = 150.0  # how long a drive across the town may take [s]


def motion():
    return support.service("external_command/current_command", GetCurrentCommand)().motion


class RvizTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        missing = missing_programs()
        if missing:
            raise unittest.SkipTest("not installed: " + ", ".join(missing))
        cls.vehicle = Vehicle()
        cls.screen = Screen(CONFIG)
        cls.screen.__enter__()
        support.wait_until(cls._is_drawn, "rviz listens to the markers", 120.0)
        answers = support.Collector("external_command/status", CommandStatus)
        support.wait_until(lambda: cls._press_stop() or answers.messages, "the panel takes keys", 60.0)
        answers.close()

    @classmethod
    def tearDownClass(cls):
        if hasattr(cls, "screen"):
            cls.screen.__exit__()

    @classmethod
    def _press_stop(cls):
        cls.screen.click(300.0, 300.0)  # no window manager: this makes the window the active one
        cls.screen.keys("space")

    @staticmethod
    def _is_drawn():
        _, subscribers, _ = rosgraph.Master(rospy.get_name()).getSystemState()
        return any("shown_rviz" in node for topic, nodes in subscribers if topic.endswith("command/draft") for node in nodes)

    def setUp(self):
        self.statuses = support.Collector("external_command/status", CommandStatus)

    def tearDown(self):
        self.statuses.close()
        self.assertTrue(self.screen.is_running(), "rviz has ended")

    def drag_goal(self, x, y, ahead=40.0):
        self.screen.keys(LANE_FOLLOW)
        self.screen.point_at(300.0, 300.0)
        self.screen.keys("d")
        self.screen.drag((x, y), (x + ahead, y))

    def wait_for(self, service, status):
        return self.statuses.wait_for(lambda m: m.service == service and m.status == status,
                                      "%s %s" % (service, support.STATUS_NAMES[status]))

    def test_a_drag_drives_space_stops_and_another_drag_arrives(self):
        self.drag_goal(480.0, 194.75)
        self.screen.keys("ctrl+Return")
        self.wait_for("lane_follow", CommandStatus.RUNNING)
        self.vehicle.wait_until_moving()
        self.screen.keys("space")
        self.wait_for("action", CommandStatus.RUNNING)
        self.vehicle.wait_until_standing()
        self.assertEqual(motion().status, CommandStatus.RUNNING, "it is held, not ended")
        x = self.vehicle.pose[0]
        self.assertLess(x, 470.0)
        self.drag_goal(480.0, 194.75)
        self.screen.keys("ctrl+Return")
        support.wait_until(lambda: motion().status == CommandStatus.FINISHED, "the vehicle arrives", DRIVING)
        self.assertGreater(self.vehicle.pose[0], 470.0)

    def test_a_click_on_a_space_parks_there(self):
        found = support.service("external_command/map_objects", FindMapObjects)(
            kind=MapObject.PARKING_SPACE, id="ave_east_2").objects
        self.assertEqual(len(found), 1)
        space = found[0].pose
        self.screen.keys(VALET_PARKING, "k")
        self.screen.click(space.x, space.y)
        self.screen.keys("Escape")
        support.wait_until(lambda: self.sends_valet(), "the click has chosen the space")
        support.wait_until(lambda: motion().service == "valet_parking" and motion().status == CommandStatus.FINISHED,
                           "the vehicle is parked", DRIVING)
        x, y, _ = self.vehicle.pose
        self.assertLess(abs(x - space.x) + abs(y - space.y), 6.0)

    def sends_valet(self):
        """Nothing is sent while nothing is chosen: pressed until the command runs."""
        self.screen.keys("ctrl+Return")
        return any(status.service == "valet_parking" for status in self.statuses.messages)

    def test_a_dry_run_shows_its_path(self):
        drafts = support.Collector("external_command/draft", MarkerArray)
        before = self.screen.count_pixels(DRY_RUN_COLOUR)
        self.drag_goal(300.0, 194.75)
        self.screen.keys("ctrl+shift+Return")
        drafts.wait_for(lambda array: any(m.ns == "draft_path" and m.action == Marker.ADD for m in array.markers),
                        "the path is published")
        support.wait_until(lambda: self.screen.count_pixels(DRY_RUN_COLOUR) > before + 100, "the path is to be seen")
        drafts.close()

    def test_a_wrong_goal_is_refused(self):
        self.drag_goal(150.0, 300.0)
        self.screen.keys("ctrl+Return")
        refused = self.wait_for("lane_follow", CommandStatus.ERROR)
        self.assertEqual(refused.error_code, CommandStatus.OFF_MAP, support.describe(refused))


if __name__ == "__main__":
    rospy.init_node("rviz_test")
    rostest.rosrun("external_command", "rviz", RvizTest)
