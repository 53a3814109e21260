# SPDX-License-Identifier: Apache-2.0
"""A small map that is right, to be spoilt by tests of check_map, and what these share."""
import copy
import math
import os
import tempfile
import unittest

from external_command import map_check
from external_command.map_builder import Arm, MapBuilder, StreetKind
from external_command.map_file import load_format, to_message

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))


def small_town():
    """Two lanes each way, cut in the middle, and a roundabout at either end; three spaces at the right, and a yard.

         west                                                       east
        /----\\   <- main_0_b1 --- main_1_b1 <-    outer            /----\\
       |      |  <- main_0_b0 --- main_1_b0 <-    inner            |      |
       |      |  -> main_0_f0 --- main_1_f0 ->                     |      |
        \\----/   -> main_0_f1 --- main_1_f1 ->                      \\----/
      x = 0               100             200
    """
    builder = MapBuilder()
    street = builder.add_street("main", [(float(x), 0.0) for x in range(201)], StreetKind(2, 13.9), 2)
    for name, x, at_start in (("west", -25.0, True), ("east", 225.0, False)):
        builder.add_roundabout(name, (x, 0.0), 12.0, [Arm(street, at_start)], 8.0)
        builder.junctions[name] = [(x + 25.0 * math.cos(a), 25.0 * math.sin(a)) for a in (0.0, 1.0, 2.0, 3.0, 4.0, 5.0)]
    builder.add_parking_row("row", street, "right", (30.0, 0.0), 3, False, (2.8, 5.5))
    builder.add_area("yard", "the yard", [(60.0, 10.0), (90.0, 10.0), (90.0, 40.0), (60.0, 40.0)])
    return builder


class Town:
    """The map as a message that a test changes, with short ways to its objects."""

    def __init__(self, message):
        self.message = message

    def __getitem__(self, lane_id):
        return next(lane for lane in self.message.lane if lane.id.id == lane_id.encode())

    def space(self, index=0):
        return self.message.parking_space[index]

    def overlap(self, overlap_id="row_0_main_0_f1"):
        return next(overlap for overlap in self.message.overlap if overlap.id.id == overlap_id.encode())

    @staticmethod
    def line(curve):
        return curve.segment[0].line_segment.point

    def center(self, lane_id):
        return self.line(self[lane_id].central_curve)

    @staticmethod
    def reverse(points):
        turned = list(copy.deepcopy(list(points)))[::-1]
        del points[:]
        points.extend(turned)

    @staticmethod
    def set_ids(field, *ids):
        del field[:]
        for lane_id in ids:
            field.add(id=lane_id.encode())

    def move(self, lane_id, dx, dy):
        """The centre line and the boundaries."""
        lane = self[lane_id]
        for curve in (lane.central_curve, lane.left_boundary.curve, lane.right_boundary.curve):
            for point in self.line(curve):
                point.x += dx
                point.y += dy

    def set_widths(self, lane_id, half):
        """Samples, and no boundaries that could say something else."""
        lane = self[lane_id]
        for sample in list(lane.left_sample) + list(lane.right_sample):
            sample.width = half
        lane.ClearField("left_boundary")
        lane.ClearField("right_boundary")

    def add_island(self, x=0.0, y=200.0, name="island", links=()):
        """A copy of a lane, far away from all others."""
        lane = self.message.lane.add()
        lane.CopyFrom(self["main_0_f0"])
        lane.id.id = name.encode()
        for field in ("successor_id", "predecessor_id", "right_neighbor_forward_lane_id",
                      "left_neighbor_reverse_lane_id", "overlap_id"):
            lane.ClearField(field)
        self.move(name, x, y)
        self.message.road[0].section[0].lane_id.add(id=name.encode())
        for field, lane_id in links:
            getattr(lane, field).add(id=lane_id.encode())
        return lane


class MapCheckTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.format = load_format(os.path.join(ROOT, "proto"))
        cls.town = to_message(small_town(), cls.format, "town", "")
        cls.folder = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def written(self, change=None, name="map.bin"):
        """The file of the town with `change(town)`."""
        message = self.format.Map()
        message.CopyFrom(self.town)
        if change:
            change(Town(message))
        path = os.path.join(self.folder.name, name)
        with open(path, "wb") as file:
            file.write(message.SerializePartialToString(deterministic=True))
        return path

    def findings(self, change, kind, **options):
        report = map_check.check_map(self.written(change), **options)
        return [finding for finding in report["findings"] if finding["kind"] == kind]

    def assert_finds(self, kind, change, *ids, what="", severity=None, **options):
        """Exactly one finding of the kind, with these ids, a text that holds `what`, and a place."""
        found = self.findings(change, kind, **options)
        self.assertEqual(len(found), 1, found)
        self.assertEqual(found[0]["ids"][:len(ids)], list(ids))
        self.assertIn(what, found[0]["what"])
        if severity:
            self.assertEqual(found[0]["severity"], severity)
        return found[0]

    def assert_passes(self, kind, change, **options):
        self.assertEqual([], self.findings(change, kind, **options))


def in_turn(*changes):
    def change(town):
        for one in changes:
            one(town)
    return change
