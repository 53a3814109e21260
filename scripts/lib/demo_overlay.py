# SPDX-License-Identifier: Apache-2.0
"""What the demo itself draws into rviz: the drive, in lines that are visible however large the map is.

The component clears its path once a command has ended; this one stays.
"""
import rospy
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

TOPIC = "/apollo/demo/markers"
PATH_COLOUR, TRAIL_COLOUR, VEHICLE_COLOUR = (255, 170, 0), (255, 120, 200), (255, 255, 255)
LINE_WIDTH = 0.8  # [m], at least
LINE_PIXELS = 4.0  # at least
VEHICLE_LENGTH = 5.0  # [m]; one that is drawn shorter than VEHICLE_PIXELS gets an arrow of that size
VEHICLE_PIXELS = 32.0
TRAIL_STEP = 1.0  # between two points of the trail [m]


def line_width(scale):
    """[m], for a scale of the picture [pixels/m]."""
    return max(LINE_WIDTH, LINE_PIXELS / scale)


class Overlay:
    """The path of the command, how far it is driven, and the vehicle where it would be a dot."""

    def __init__(self, scale):
        self._scale = scale
        self._path = []
        self._trail = []
        self._publisher = rospy.Publisher(TOPIC, MarkerArray, queue_size=1, latch=True)

    def show_path(self, points):
        self._path = points
        self._trail = []
        self.publish()

    def add_position(self, position):
        if position is None:
            return
        last = self._trail[-1] if self._trail else None
        if last is None or abs(position[0] - last[0]) + abs(position[1] - last[1]) > TRAIL_STEP:
            self._trail.append(position)

    def publish(self):
        markers = [self._line("path", self._path, PATH_COLOUR, 1.0), self._line("trail", self._trail, TRAIL_COLOUR, 1.5)]
        if VEHICLE_LENGTH * self._scale < VEHICLE_PIXELS:
            markers.append(self._vehicle())
        self._publisher.publish(MarkerArray(markers=markers))

    def _line(self, name, points, colour, height):
        line = marker("map", name, Marker.LINE_STRIP, colour)
        line.scale.x = line_width(self._scale)
        line.points = [Point(x, y, height) for x, y in points]
        if len(points) < 2:
            line.action = Marker.DELETE
        return line

    def _vehicle(self):
        """An arrow that points ahead."""
        length = VEHICLE_PIXELS / self._scale
        arrow = marker("base_link", "vehicle", Marker.ARROW, VEHICLE_COLOUR)
        arrow.frame_locked = True
        arrow.scale.x, arrow.scale.y, arrow.scale.z = 0.3 * length, 0.7 * length, 0.6 * length  # shaft, head, its length
        arrow.points = [Point(-0.5 * length, 0.0, 2.0), Point(0.5 * length, 0.0, 2.0)]
        return arrow


def marker(frame, name, kind, colour):
    made = Marker(ns=name, type=kind, action=Marker.ADD)
    made.header.frame_id = frame
    made.pose.orientation.w = 1.0
    made.color = ColorRGBA(*(part / 255.0 for part in colour), 1.0)
    return made
