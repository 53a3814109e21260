# SPDX-License-Identifier: Apache-2.0
import io
import os
import shutil
import unittest

from demo_map_test import load_script, reachable, ROOT
from external_command.map_file import load_format, MapWriter
from external_command.plane import distance

PROTO = os.path.join(ROOT, "proto")


class Parts:
    """Keeps what would be written."""

    def __init__(self):
        self.lanes, self.roads, self.spaces = {}, [], []

    def write(self, builder):
        assert not self.lanes.keys() & builder.lanes.keys()
        self.lanes.update(builder.lanes)
        self.roads += builder.roads
        self.spaces += builder.parking_spaces


class CityMapTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.script = load_script("make_city_map")
        cls.city = cls.script.city_of(1500)
        cls.parts = Parts()
        cls.city.write(cls.parts)

    def test_has_about_the_lanes_asked_for(self):
        for lanes in (1000, 1500, 10000, 100000):
            self.assertAlmostEqual(self.script.city_of(lanes).count_lanes() / lanes, 1.0, delta=0.1)

    def test_has_the_lanes_it_says(self):
        self.assertEqual(len(self.parts.lanes), self.city.count_lanes())

    def test_lanes_continue_each_other(self):
        for lane in self.parts.lanes.values():
            for after in (self.parts.lanes[i] for i in lane.successors):
                self.assertIn(lane.id, after.predecessors)
                self.assertLess(distance(lane.center[-1], after.center[0]), 1e-6)

    def test_every_lane_is_reachable_from_the_first(self):
        self.assertEqual(reachable(next(iter(self.parts.lanes)), self.parts.lanes), self.parts.lanes.keys())

    def test_every_lane_belongs_to_one_road(self):
        of_roads = [lane for road in self.parts.roads for section in road.sections for lane in section]
        self.assertEqual(sorted(of_roads), sorted(self.parts.lanes))

    def test_parking_spaces_lie_beside_lanes(self):
        self.assertGreater(len(self.parts.spaces), 100)
        for space in self.parts.spaces:
            self.assertIn(space.lanes[0][0], self.parts.lanes)

    @unittest.skipUnless(shutil.which("protoc"), "protoc is not installed")
    def test_is_one_file_which_is_the_same_each_time(self):
        def made():
            file = io.BytesIO()
            self.script.City(3).write(MapWriter(file, PROTO, "a city", "+proj=tmerc"))
            return file.getvalue()
        message = load_format(PROTO).Map()
        message.ParseFromString(made())
        self.assertEqual(message.header.version, b"a city")
        self.assertEqual(len(message.lane), self.script.City(3).count_lanes())
        self.assertEqual(made(), made())


if __name__ == "__main__":
    unittest.main()
