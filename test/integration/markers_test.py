#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What rviz is shown of a large map: what is near the vehicle, and near where somebody looks."""
import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import PointStamped
from visualization_msgs.msg import Marker, MarkerArray

import support
from vehicle import Vehicle
from external_command.msg import CommandStatus, LaneFollowCommand, Pose
from external_command.srv import LaneFollow

MARKERS, IDS = "external_command/markers", "external_command/map_ids"
RADIUS = 60.0
NEAR = 30.0  # the points of a straight lane are 25 m apart
LONGEST_LANE = 250.0  # of the town [m]


class Scene:
    """What a display of markers holds after all messages of a topic."""

    def __init__(self, topic):
        self._collector = support.Collector(topic, MarkerArray)

    def close(self):
        self._collector.close()

    def wait_for_next(self):
        count = len(self._collector.messages)
        support.wait_until(lambda: len(self._collector.messages) > count, "another message")

    @property
    def markers(self):
        held = {}
        for message in self._collector.messages:
            for marker in message.markers:
                if marker.action == Marker.DELETEALL:
                    held.clear()
                elif marker.action == Marker.DELETE:
                    held.pop((marker.ns, marker.id), None)
                else:
                    held[marker.ns, marker.id] = marker
        return held

    def of(self, namespace):
        return [marker for (ns, _), marker in sorted(self.markers.items()) if ns == namespace]

    def has_points_near(self, namespace, place, radius):
        return any(distance(point, place) < radius for marker in self.of(namespace) for point in marker.points)


def distance(point, place):
    return math.hypot(point.x - place[0], point.y - place[1])


def look_at(x, y, frame="map"):
    message = PointStamped()
    message.header.frame_id = frame
    message.point.x, message.point.y = x, y
    publisher = rospy.Publisher("external_command/look_at", PointStamped, queue_size=1, latch=True)
    support.wait_until(lambda: publisher.get_num_connections() > 0, "somebody takes what is looked at")
    publisher.publish(message)
    return publisher


def drive_to(x, y):
    """Id of the command."""
    call = support.service("external_command/lane_follow", LaneFollow)
    status = call(LaneFollowCommand(end_pose=Pose(x=x, y=y))).status
    assert status.status == CommandStatus.RUNNING, support.describe(status)
    return status.command_id


class MarkersTest(unittest.TestCase):
    def setUp(self):
        self.vehicle = Vehicle()

    def scene(self, topic):
        scene = Scene(topic)
        self.addCleanup(scene.close)
        support.wait_until(lambda: scene.markers, "markers on " + topic)
        return scene

    def test_the_map_is_drawn_around_the_vehicle_and_moves_along(self):
        scene = self.scene(MARKERS)
        start = self.vehicle.pose
        support.wait_until(lambda: scene.has_points_near("lanes", start, NEAR), "the lanes at the vehicle are drawn")
        for marker in scene.of("lanes") + scene.of("center_lines"):
            for point in marker.points:
                self.assertLess(distance(point, start), RADIUS + LONGEST_LANE)
        there = (478.0, 338.25) if start[0] < 300.0 else (100.0, 195.0)
        self.assertFalse(scene.has_points_near("lanes", there, NEAR))
        command_id = drive_to(*there)
        support.wait_for_status(command_id, CommandStatus.FINISHED, deadline=90.0)
        support.wait_until(lambda: scene.has_points_near("lanes", there, NEAR), "the lanes at the goal are drawn")
        support.wait_until(lambda: not scene.has_points_near("lanes", start, NEAR), "those at the start are not")

    def test_who_comes_late_gets_map_vehicle_and_command(self):
        x, y, _ = self.vehicle.pose
        drive_to(*((300.0, 195.0) if x < 250.0 else (100.0, 195.0)))
        first = self.scene(MARKERS)
        support.wait_until(lambda: first.of("route"), "the route is drawn")
        support.wait_until(lambda: len(first.of("lanes")) == 1, "the map is drawn")
        late = self.scene(MARKERS)
        for namespace in ("lanes", "route", "path", "goal", "footprint", "vehicle_ring"):
            support.wait_until(lambda ns=namespace: len(late.of(ns)) == 1, namespace + " is drawn once")

    def test_ids_are_those_near_the_vehicle_and_come_again(self):
        ids = self.scene(IDS)
        near = [marker.pose.position for marker in ids.of("lane_ids")]
        self.assertTrue(near)
        self.assertLessEqual(len(near), 20)
        self.assertTrue(ids.of("area_ids"))
        self.assertTrue(ids.of("legend"))
        ids.wait_for_next()

    def test_what_somebody_looks_at_is_drawn_too(self):
        scene = self.scene(MARKERS)
        place = (505.0, 205.0) if self.vehicle.pose[0] < 300.0 else (90.0, 195.0)
        ids = self.scene(IDS)
        for wrong in (look_at(*place, frame="elsewhere"), look_at(math.nan, place[1])):
            ids.wait_for_next()  # the thread that draws has had its turn since
            ids.wait_for_next()
            self.assertFalse(scene.has_points_near("lanes", place, NEAR))
            wrong.unregister()
        right = look_at(*place)
        support.wait_until(lambda: scene.has_points_near("lanes", place, NEAR), "the lanes there are drawn")
        support.wait_until(lambda: scene.has_points_near("lanes", self.vehicle.pose, NEAR), "and those at the vehicle")
        right.unregister()


if __name__ == "__main__":
    rospy.init_node("markers_test")
    rostest.rosrun("external_command", "markers", MarkersTest)
