# SPDX-License-Identifier: Apache-2.0
"""The demo's client: chooses where to drive, sends the lane-follow command, and watches the drive."""
import itertools
import math
import random
import threading
import time

import numpy
import rospy
import tf2_ros
from external_command.client import STATUS_NAMES, CommandClient
from external_command.msg import Chassis, CommandStatus, LaneFollowCommand, Pose
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Path
from visualization_msgs.msg import MarkerArray

from demo_stack import DemoError

NAMESPACE = "/apollo/"
SERVICE = NAMESPACE + "external_command/"
START_TIMEOUT = 120.0  # for nodes to come up and a large map to load [s]
SILENCE_TIMEOUT = 60.0  # for a vehicle that does not get on [s]
CANDIDATES = 8  # places between all pairs of which a route is tried
END_LENGTH = 15.0  # [m]
MAX_END_CURVATURE = 0.1  # [1/m]
PICTURE_AT = 0.3  # of the way left
MAP_SHOWN = 1.5  # times as large as the route, at most, for all of the map to be shown


class Drive:
    def __init__(self, stack):
        self.extent = None  # that shows start, goal and route: (min x, min y, max x, max y) [m], once chosen
        self.length = 0.0  # of the route [m], once chosen
        self.lane_ids = []  # of the route, once chosen
        self.start = None  # where the vehicle was placed
        self.command_id = 0  # once sent
        self._stack = stack
        self._path = None
        self._scene = {}  # what the gateway draws into rviz, by its namespace
        self._speed = 0.0
        self._origin = (0.0, 0.0)

    def connect(self):
        """Waits for master and component."""
        import rosgraph
        self._stack.wait_for(rosgraph.is_master_online, "the ROS master", 30.0)
        rospy.init_node("demo", anonymous=True, disable_signals=True)
        origin = SERVICE[:-1] + "/map_origin_resolved"
        self._stack.wait_for(lambda: rospy.has_param(origin), "the component with its map", START_TIMEOUT)
        self._origin = rospy.get_param(origin)
        self._client = CommandClient(NAMESPACE, START_TIMEOUT)
        self._tf_buffer = tf2_ros.Buffer()
        self._tf_listener = tf2_ros.TransformListener(self._tf_buffer)
        rospy.Subscriber(NAMESPACE + "canbus/chassis", Chassis, self._on_chassis)
        rospy.Subscriber(SERVICE + "path", Path, self._on_path)
        rospy.Subscriber(SERVICE + "markers", MarkerArray, self._on_markers)
        self._stack.wait_for(lambda: "center_lines" in self._scene, "the map as it is drawn", START_TIMEOUT)

    def choose(self, start, goal):
        """Start and goal poses in the map frame; a dry run has found a route between them.

        `start` and `goal` are in the map file's coordinates; None: a pair with a long route is looked for.
        """
        if start is None:
            start, goal, answer = self._longest_route()
        else:
            start = self.in_map(start)
            goal = Pose(x=goal[0] - self._origin[0], y=goal[1] - self._origin[1])
            answer = self._dry_run(start, goal)
            if answer.status.status == CommandStatus.ERROR:
                raise DemoError(f"no route from --from to --to: {answer.status.message}")
        points = [(point.x, point.y) for point in answer.path.points] + [(start.x, start.y), (goal.x, goal.y)]
        self.length = answer.report.route_length
        self.lane_ids = answer.report.lane_ids
        self.extent = with_map(bounds(points), bounds([(point.x, point.y) for point in self._scene["lanes"].points]))
        print(f"from {self._in_file(start)}, heading {start.heading:.3f}, to {self._in_file(goal)}: "
              f"{self.length:.0f} m over {len(answer.report.lane_ids)} lanes, "
              f"{answer.report.lane_changes} lane change(s)", flush=True)
        return start, goal

    def command_status(self, command_id):
        return self._client.status(command_id)

    def in_map(self, pose):
        """Pose of (x, y, heading) in the map file's coordinates."""
        return Pose(x=pose[0] - self._origin[0], y=pose[1] - self._origin[1], heading=pose[2], has_heading=True)

    def _in_file(self, pose):
        """The position in the map file's coordinates, as --from and --to take it."""
        return f"{pose.x + self._origin[0]:.2f},{pose.y + self._origin[1]:.2f}"

    def _longest_route(self):
        places = far_apart(self._lane_points(), CANDIDATES)
        found = []
        for start, goal in itertools.permutations(places, 2):
            answer = self._dry_run(Pose(x=start[0], y=start[1]), Pose(x=goal[0], y=goal[1]))
            if answer.status.status != CommandStatus.ERROR:
                found.append((ends_straight(answer.path.points), answer.report.route_length, goal, answer))
        if not found:
            raise DemoError(f"no route between any two of {len(places)} lanes of this map; try --from and --to")
        *_, goal, answer = max(found, key=lambda route: route[:2])
        first = answer.path.points[0]
        return Pose(x=first.x, y=first.y, heading=first.heading, has_heading=True), Pose(x=goal[0], y=goal[1]), answer

    def _lane_points(self):
        """Points on the centre lines of the lanes to drive on, from the markers for rviz."""
        centers = self._scene["center_lines"]
        if not centers.points:
            raise DemoError("the map has no lanes to drive on")
        points = numpy.array([(point.x, point.y) for point in centers.points])
        return (points[0::2] + points[1::2]) / 2.0  # a marker is pairs of ends; a lane's own ends are ambiguous

    def _dry_run(self, start, goal):
        return self._client.call("lane_follow", LaneFollowCommand(way_point=[start], end_pose=goal,
                                                                  is_start_pose_set=True, dry_run=True))

    def place(self, pose):
        """Puts the simulated vehicle at `pose`."""
        self.start = pose
        publisher = rospy.Publisher(NAMESPACE + "initialpose", PoseWithCovarianceStamped, queue_size=1, latch=True)
        message = PoseWithCovarianceStamped()
        message.header.frame_id = "map"
        message.pose.pose.position.x, message.pose.pose.position.y = pose.x, pose.y
        message.pose.pose.orientation.z = math.sin(pose.heading / 2.0)
        message.pose.pose.orientation.w = math.cos(pose.heading / 2.0)
        publisher.publish(message)
        self._stack.wait_for(publisher.get_num_connections, "the simulated vehicle", START_TIMEOUT)

        def has_arrived():
            position = self._position()
            return position is not None and math.hypot(position[0] - pose.x, position[1] - pose.y) < 0.5
        self._stack.wait_for(has_arrived, "the simulated vehicle at its start", START_TIMEOUT)
        publisher.unregister()
        self._stack.wait_for(lambda: not self._client.unmet("lane_follow"), "the gateway to be ready", START_TIMEOUT)

    def go(self, goal, camera):
        """Drives to `goal`; `camera`, where there is one, takes its picture on the way. Returns whether the command has
        FINISHED."""
        self._path = None
        answer = self._client.call("lane_follow", LaneFollowCommand(end_pose=goal)).status
        print(f"lane-follow command {answer.command_id}: {STATUS_NAMES[answer.status]} {answer.message}", flush=True)
        if answer.status == CommandStatus.ERROR:
            return False
        self.command_id = answer.command_id
        progress = Progress(self._stack.wait_for(lambda: self._path, "the path", 10.0))
        overlay = camera.overlay if camera else None
        if overlay:
            overlay.show_path(progress.points())
            ids = rospy.wait_for_message(SERVICE + "map_ids", MarkerArray, START_TIMEOUT)
        late = PICTURE_AT * progress.left
        photographer = threading.Thread(target=camera.take if camera else lambda: None, daemon=True)  # nobody waits for it
        is_over = False
        while not is_over:
            status = self._wait_for_news(progress, overlay)
            is_over = status.status in (CommandStatus.FINISHED, CommandStatus.ERROR)
            print(f"  {progress.left:7.1f} m to go, {self._speed:5.1f} m/s  {STATUS_NAMES[status.status]} "
                  f"{status.message}", flush=True)
            if overlay:
                overlay.publish()
                camera.captions.show(self._scene, ids.markers, self.lane_ids)  # of what is drawn by now
            if photographer.ident is None and (is_over or progress.left < late):
                photographer.start()
        photographer.join()
        return status.status == CommandStatus.FINISHED

    def _wait_for_news(self, progress, overlay):
        """The command's status, after a second or when the command has ended."""
        deadline = time.monotonic() + 1.0
        while True:
            status = self._client.status(self.command_id)
            position = self._position()
            progress.update(position)
            if overlay:
                overlay.add_position(position)
            if status.status in (CommandStatus.FINISHED, CommandStatus.ERROR) or time.monotonic() > deadline:
                return status
            if progress.seconds_standing() > SILENCE_TIMEOUT:
                raise DemoError(f"the vehicle has not moved for {SILENCE_TIMEOUT:.0f} s: {status.message}")
            self._stack.check()
            time.sleep(0.1)

    def _position(self):
        try:
            position = self._tf_buffer.lookup_transform("map", "base_link", rospy.Time(0)).transform.translation
        except tf2_ros.TransformException:
            return None
        return position.x, position.y

    def _on_chassis(self, chassis):
        self._speed = chassis.speed_mps

    def _on_markers(self, array):
        self._scene.update((marker.ns, marker) for marker in array.markers)

    def _on_path(self, path):
        if path.poses:  # an empty one follows when the command has ended
            self._path = path


class Progress:
    """How far along a path the vehicle is."""

    def __init__(self, path):
        self._points = numpy.array([(pose.pose.position.x, pose.pose.position.y) for pose in path.poses])
        steps = numpy.hypot(*numpy.diff(self._points, axis=0).T)
        self._left = numpy.append(numpy.cumsum(steps[::-1])[::-1], 0.0)
        self._index = 0
        self._moved = time.monotonic()
        self.left = self._left[0]  # [m]

    def points(self):
        return [tuple(point) for point in self._points]

    def update(self, position):
        """Takes the nearest of the next points; a path may meet itself further on."""
        if position is None:
            return
        reach = 20.0 + 2.0 * math.hypot(*(position - self._points[self._index]))
        ahead = numpy.searchsorted(-self._left, reach - self.left, side="right")
        distances = numpy.hypot(*(self._points[self._index:max(ahead, self._index + 1)] - position).T)
        step = int(numpy.argmin(distances))
        if step > 0:
            self._moved = time.monotonic()
        self._index += step
        self.left = self._left[self._index]

    def seconds_standing(self):
        return time.monotonic() - self._moved


def bounds(points):
    """(min x, min y, max x, max y)"""
    return (*numpy.min(points, axis=0), *numpy.max(points, axis=0))


def with_map(route, whole_map):
    """What a picture of the route shows: all of the map, where that is not much larger."""
    size = max(route[2] - route[0], route[3] - route[1])
    map_size = max(whole_map[2] - whole_map[0], whole_map[3] - whole_map[1])
    return whole_map if map_size <= MAP_SHOWN * size else route


def ends_straight(points):
    """A kink just before the end, as thinned maps have them, leaves no room to stop there with the right heading."""
    return all(abs(point.kappa) < MAX_END_CURVATURE for point in points if point.s > points[-1].s - END_LENGTH)


def far_apart(points, count):
    """Up to `count` of the points, each as far as can be from those before it."""
    chosen = [points[random.Random(1).randrange(len(points))]]
    distances = numpy.hypot(*(points - chosen[0]).T)
    chosen[0] = points[int(numpy.argmax(distances))]
    distances = numpy.hypot(*(points - chosen[0]).T)
    while len(chosen) < count and distances.max() > 1.0:
        chosen.append(points[int(numpy.argmax(distances))])
        distances = numpy.minimum(distances, numpy.hypot(*(points - chosen[-1]).T))
    return chosen
