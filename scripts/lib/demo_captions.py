# SPDX-License-Identifier: Apache-2.0
"""What makes the demo's picture readable: ids, what the colours mean, and a scale, in letters of one size on any map."""
import math

import rospy
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from demo_overlay import PATH_COLOUR, TRAIL_COLOUR, marker

TOPIC = "/apollo/demo/captions"
STRIP = 190  # at the left of the picture, for the legend [pixels]
LETTER = 15.0  # high [pixels]
LETTER_WIDTH = 0.5  # of its height, about
ROW = 1.9  # this and the following in heights of a letter
SAMPLE = 2.5
THICKNESS = 0.5
HEIGHT = 3.0  # above the map [m]
WHITE = (255, 255, 255)
OF_MAP = (("lanes", "lane"), ("center_lines", "centre line"), ("junctions", "junction"),
          ("parking_spaces", "parking space"), ("areas", "area"))  # namespace of the gateway's markers, words


class Captions:
    def __init__(self, scale, left, bottom):
        """`scale` [pixels/m]; `left` and `bottom` of the picture in the frame map [m]."""
        self._letter = LETTER / scale
        self._left, self._bottom = left + 1.5 * self._letter, bottom + 1.5 * self._letter
        self._width = (STRIP / LETTER - 3.0) * self._letter
        self._markers = []
        self._publisher = rospy.Publisher(TOPIC, MarkerArray, queue_size=1, latch=True)

    def show(self, scene, id_markers, lane_ids):
        """`scene`, markers by namespace, and `id_markers` as the gateway draws them; of the lanes those with `lane_ids` are
        named."""
        self._markers = []
        self._name(id_markers, set(lane_ids))
        self._explain(scene)
        self._publisher.publish(MarkerArray(markers=self._markers))

    def _name(self, id_markers, lane_ids):
        for text in id_markers:
            if text.ns == "area_ids" or (text.ns == "lane_ids" and text.text in lane_ids):
                place = text.pose.position
                self._write(text.text, place.x, place.y, WHITE if text.ns == "lane_ids" else _parts(text.color))

    def _explain(self, scene):
        """From below: the scale, and a row for each colour that is there."""
        length = round_length(self._width / 1.5)
        self._sample(length, self._bottom, WHITE)
        self._write_from(self._left + length + 0.6 * self._letter, self._bottom, f"{length:g} m")
        colours = {name: _parts(each.color) for name, each in scene.items() if each.points}
        rows = [("path", PATH_COLOUR), ("driven", TRAIL_COLOUR), ("route", colours.get("route"))]
        rows += [(words, colours.get(name)) for name, words in OF_MAP]
        y = self._bottom
        for words, colour in reversed([row for row in rows if row[1]]):
            y += ROW * self._letter
            self._sample(SAMPLE * self._letter, y, colour)
            self._write_from(self._left + (SAMPLE + 0.8) * self._letter, y, words)

    def _sample(self, length, y, colour):
        line = marker("map", "legend", Marker.LINE_STRIP, colour)
        line.scale.x = THICKNESS * self._letter
        line.points = [Point(self._left, y, HEIGHT), Point(self._left + length, y, HEIGHT)]
        self._add(line)

    def _write_from(self, left, y, words):
        self._write(words, left + 0.5 * LETTER_WIDTH * len(words) * self._letter, y, WHITE)

    def _write(self, words, x, y, colour):
        text = marker("map", "texts", Marker.TEXT_VIEW_FACING, colour)
        text.text = words
        text.scale.z = self._letter
        text.pose.position = Point(x, y, HEIGHT)
        self._add(text)

    def _add(self, made):
        made.id = len(self._markers)
        made.color = ColorRGBA(made.color.r, made.color.g, made.color.b, 1.0)
        self._markers.append(made)


def round_length(most):
    """The largest of 1, 2, 5, 10, 20, ... that is not above `most`."""
    power = 10.0 ** math.floor(math.log10(most))
    return max(digit * power for digit in (1.0, 2.0, 5.0) if digit * power <= most)


def _parts(colour):
    return tuple(255.0 * part for part in (colour.r, colour.g, colour.b))
