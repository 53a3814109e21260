# SPDX-License-Identifier: Apache-2.0
import importlib.machinery
import importlib.util
import math
import os
import shutil
import tempfile
import unittest

from external_command import map_curves as curves
from external_command.map_builder import Arm, MapBuilder, StreetKind
from external_command.map_file import load_format
from external_command.plane import direction, distance, wrap_angle

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))


def load_script(name):
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(ROOT, "scripts", name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


def reachable(start, lanes):
    seen, open_ids = {start}, [start]
    while open_ids:
        lane = lanes[open_ids.pop()]
        for next_id in lane.successors + lane.left_forward + lane.right_forward:
            if next_id not in seen:
                seen.add(next_id)
                open_ids.append(next_id)
    return seen


class DemoMapTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.script = load_script("make_demo_map")
        cls.map = cls.script.make_map()

    def test_every_lane_is_reachable_from_every_other(self):
        for lane_id in self.map.lanes:
            self.assertEqual(len(reachable(lane_id, self.map.lanes)), len(self.map.lanes), lane_id)

    def test_lanes_continue_each_other_without_a_gap_or_a_kink(self):
        for lane in self.map.lanes.values():
            for after in (self.map.lanes[i] for i in lane.successors):
                self.assertIn(lane.id, after.predecessors)
                self.assertLess(distance(lane.center[-1], after.center[0]), 1e-6)
                turn = wrap_angle(direction(*after.center[:2]) - direction(*lane.center[-2:]))
                self.assertLess(abs(turn), 0.05, "%s -> %s" % (lane.id, after.id))

    def test_no_bend_is_tighter_than_a_car_can_drive(self):
        for lane in self.map.lanes.values():
            for a, b, c in zip(lane.center, lane.center[1:], lane.center[2:]):
                turn = abs(wrap_angle(direction(b, c) - direction(a, b)))
                self.assertLess(turn / (0.5 * (distance(a, b) + distance(b, c))), 1.0 / 5.5, lane.id)

    def test_borders_lie_at_their_side_half_a_width_away(self):
        for lane in self.map.lanes.values():
            for s in (0.0, 0.5 * lane.length, lane.length):
                point, heading = curves.at(lane.center, s)
                for border, side in ((lane.left, 1.0), (lane.right, -1.0)):
                    foot, _ = curves.at(border, curves.project(border, point))
                    across = (foot[1] - point[1]) * math.cos(heading) - (foot[0] - point[0]) * math.sin(heading)
                    self.assertAlmostEqual(side * across, 0.5 * lane.width, delta=0.05, msg=lane.id)

    def test_neighbours_know_each_other(self):
        for lane in self.map.lanes.values():
            for other in lane.left_forward:
                self.assertIn(lane.id, self.map.lanes[other].right_forward)
            for other in lane.left_reverse:
                self.assertIn(lane.id, self.map.lanes[other].left_reverse)

    def test_every_lane_belongs_to_one_road(self):
        of_roads = [lane for road in self.map.roads for section in road.sections for lane in section]
        self.assertEqual(sorted(of_roads), sorted(self.map.lanes))
        self.assertEqual(len({road.id for road in self.map.roads}), len(self.map.roads))

    def test_parking_spaces_lie_beside_a_lane_that_overlaps_them(self):
        for space in self.map.parking_spaces:
            self.assertTrue(space.lanes, space.id)
            gaps = []
            for lane_id, start_s, end_s in space.lanes:
                lane = self.map.lanes[lane_id]
                self.assertTrue(0.0 <= start_s < end_s <= lane.length + 1e-6)
                near, _ = curves.at(lane.center, 0.5 * (start_s + end_s))
                gaps.append(distance(near, [(a + b) / 2 for a, b in zip(space.polygon[0], space.polygon[3])]))
            self.assertAlmostEqual(min(gaps), 1.75, delta=0.05)

    def test_no_lane_runs_through_a_parking_space(self):
        middles = [p for lane in self.map.lanes.values() for p in curves.resampled(lane.center, 1.0)]
        for space in self.map.parking_spaces:
            self.assertFalse([p for p in middles if curves.contains(space.polygon, p)], space.id)

    def test_areas_are_crossed_by_lanes(self):
        self.assertEqual(len(self.map.areas), 2)
        for area in self.map.areas:
            for lane_id, start_s, end_s in area.lanes:
                middle, _ = curves.at(self.map.lanes[lane_id].center, 0.5 * (start_s + end_s))
                self.assertTrue(curves.contains(area.polygon, middle))
            self.assertEqual(len(area.lanes), 2)

    @unittest.skipUnless(shutil.which("protoc"), "protoc is not installed")
    def test_the_files_in_maps_are_what_the_script_makes(self):
        proto = os.path.join(ROOT, "proto")
        with tempfile.TemporaryDirectory() as folder:
            self.script.write_map(self.map, proto, folder, self.script.VERSION, self.script.PROJECTION)
            for name in ("base_map.txt", "base_map.bin"):
                with open(os.path.join(folder, name), "rb") as made, \
                        open(os.path.join(ROOT, "maps", "demo_town", name), "rb") as kept:
                    self.assertTrue(made.read() == kept.read(), name + " differs: run scripts/make_demo_map")

    @unittest.skipUnless(shutil.which("protoc"), "protoc is not installed")
    def test_the_binary_file_holds_the_map(self):
        message = load_format(os.path.join(ROOT, "proto")).Map()
        with open(os.path.join(ROOT, "maps", "demo_town", "base_map.bin"), "rb") as file:
            message.ParseFromString(file.read())
        self.assertEqual([lane.id.id.decode() for lane in message.lane], list(self.map.lanes))
        self.assertEqual(len(message.overlap), sum(len(s.lanes) for s in self.map.parking_spaces + self.map.areas))


class MapBuilderTest(unittest.TestCase):
    def test_an_id_can_be_used_once(self):
        builder = MapBuilder()
        center = curves.rounded([(0.0, 0.0), (50.0, 0.0)])
        street = builder.add_street("a", center, StreetKind(1, 10.0))
        with self.assertRaisesRegex(ValueError, "two lanes a_0_f0"):
            builder.add_street("a", center, StreetKind(1, 10.0))
        builder.add_junction("j", [Arm(street, at_start=True)])
        with self.assertRaisesRegex(ValueError, "two junctions j"):
            builder.add_junction("j", [Arm(street, at_start=False)])

    def test_turns_take_the_outer_lane_to_the_right_and_the_inner_one_to_the_left(self):
        #        | b
        #   a ===+=== c      a and c have two lanes in each direction
        builder = MapBuilder()
        a, b, c = (builder.add_street(name, curves.rounded([(20.0 * x, 20.0 * y), (80.0 * x, 80.0 * y)]),
                                      StreetKind(count, 10.0))
                   for name, x, y, count in (("a", -1.0, 0.0, 2), ("b", 0.0, 1.0, 1), ("c", 1.0, 0.0, 2)))
        builder.add_junction("j", [Arm(street, at_start=True) for street in (a, b, c)])
        lanes = builder.lanes
        self.assertEqual([(lanes[i].turn, lanes[i].predecessors, lanes[i].successors) for i in
                          ("j_a_b_0", "j_c_b_0", "j_b_a_0", "j_b_c_0", "j_a_c_0", "j_a_c_1")],
                         [("LEFT_TURN", ["a_0_b0"], ["b_0_f0"]), ("RIGHT_TURN", ["c_0_b1"], ["b_0_f0"]),
                          ("RIGHT_TURN", ["b_0_b0"], ["a_0_f1"]), ("LEFT_TURN", ["b_0_b0"], ["c_0_f0"]),
                          ("NO_TURN", ["a_0_b0"], ["c_0_f0"]), ("NO_TURN", ["a_0_b1"], ["c_0_f1"])])


if __name__ == "__main__":
    unittest.main()
