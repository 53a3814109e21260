# SPDX-License-Identifier: Apache-2.0
"""What check_map finds of roads, junctions, spaces, areas and overlaps; each kind is found, and not where all is well."""
import copy
import math
import unittest

from external_command import map_check
from small_town import MapCheckTest


class RoadAndJunctionTest(MapCheckTest):
    def test_a_lane_that_no_road_or_two_roads_name(self):
        def leave_out(town):
            for road in town.message.road:
                for section in road.section:
                    town.set_ids(section.lane_id, *[one.id.decode() for one in section.lane_id if one.id != b"main_0_f1"])
        self.assert_finds("lane_without_road", leave_out, "main_0_f1")

        def name_twice(town):
            town.message.road[1].section[0].lane_id.add(id=b"main_0_f1")
        self.assert_finds("lane_of_two_roads", name_twice, "main_0_f1", "main", severity="warning")
        self.assert_passes("lane_without_road", name_twice)

    def test_a_map_without_roads_is_told_once(self):
        def clear(town):
            del town.message.road[:]
        report = map_check.check_map(self.written(clear))
        self.assertIn("the map states no roads", report["notes"][0])
        self.assert_passes("lane_without_road", clear)

    def test_a_junction_that_does_not_exist(self):
        def rename(town):
            town["main_0_f1"].junction_id.id = b"ghost"
        self.assert_finds("junction_dangling", rename, "main_0_f1", "ghost")
        self.assert_passes("junction_dangling", None)

    def test_a_junction_or_road_whose_id_another_has(self):
        def repeat(town):
            town.message.road.add().CopyFrom(town.message.road[0])
        self.assert_finds("id_repeated", repeat, "main", what="road main")
        self.assert_passes("id_repeated", None)


class ObjectTest(MapCheckTest):
    def test_a_polygon_that_crosses_itself(self):
        def cross(town):
            points = town.message.ad_area[0].polygon.point
            points[1].y, points[2].y = points[2].y, points[1].y
        self.assert_finds("polygon_unusable", cross, "yard", what="area yard crosses or touches itself", severity="error")
        self.assert_passes("polygon_unusable", None)

    def test_corners_in_crossed_order(self):
        def cross(town):
            points = town.space().polygon.point
            first = copy.deepcopy(points[0])
            points[0].CopyFrom(points[1])
            points[1].CopyFrom(first)
        self.assert_finds("corners_crossed", cross, "row_0")
        self.assert_passes("polygon_unusable", cross)

    def test_an_id_of_two_spaces(self):
        def repeat(town):
            town.space(1).id.id = b"row_0"
        self.assert_finds("object_id_repeated", repeat, "row_0", severity="error")

    def test_headings_of_spaces(self):
        def turn(heading):
            def change(town):
                if heading is None:
                    town.space().ClearField("heading")
                else:
                    town.space().heading = heading
            return change
        self.assert_finds("space_heading_missing", turn(None), "row_0")
        self.assert_finds("space_heading_in_degrees", turn(-90.0), "row_0", what="-90")
        self.assert_finds("space_heading_across", turn(0.0), "row_0")
        for kind in ("space_heading_missing", "space_heading_in_degrees", "space_heading_across"):
            self.assert_passes(kind, turn(math.pi / 2.0))

    def test_overlaps_of_a_space(self):
        def drop(town):
            del town.space().overlap_id[:]
            kept = [overlap for overlap in town.message.overlap if not overlap.id.id.startswith(b"row_0_")]
            del town.message.overlap[:]
            town.message.overlap.extend(kept)
        self.assert_finds("space_without_overlap", drop, "row_0")
        self.assert_finds("overlap_dangling", lambda town: town.space().overlap_id.add(id=b"ghost"), "row_0", "ghost")
        self.assert_passes("overlap_dangling", None)

    def test_an_overlap_that_only_one_side_states(self):
        def drop(town):
            town.set_ids(town["main_0_f1"].overlap_id, "row_1_main_0_f1", "row_2_main_0_f1")
        self.assert_finds("overlap_one_sided", drop, "main_0_f1", "row_0_main_0_f1",
                          what="names lane main_0_f1, which does not name it")
        self.assert_finds("overlap_one_sided", lambda town: town["main_0_f1"].overlap_id.add(id=b"ghost"), "main_0_f1",
                          "ghost", what="which does not exist")

    def test_ranges_of_overlaps(self):
        def put(start, end):
            def change(town):
                part = town.overlap().object[0].lane_overlap_info
                part.start_s, part.end_s = start, end
            return change
        self.assert_finds("overlap_range_unusable", put(40.0, 30.0), "main_0_f1")
        self.assert_finds("overlap_beyond_lane", put(28.0, 120.0), "row_0_main_0_f1", "main_0_f1",
                          what="which is 100.00 m long")
        self.assert_finds("overlap_elsewhere", put(90.0, 95.0), "row_0_main_0_f1", "main_0_f1", "row_0")
        for kind in ("overlap_range_unusable", "overlap_beyond_lane", "overlap_elsewhere"):
            self.assert_passes(kind, put(20.0, 40.0))

    def test_two_lanes_that_overlap_elsewhere(self):
        def overlap(start):
            def change(town):
                added = town.message.overlap.add()
                added.id.id = b"crossing"
                for lane_id, from_s in ((b"main_0_f1", 10.0), (b"main_0_f0", start)):
                    part = added.object.add()
                    part.id.id = lane_id
                    part.lane_overlap_info.start_s, part.lane_overlap_info.end_s = from_s, from_s + 5.0
                    town[lane_id.decode()].overlap_id.add(id=b"crossing")
            return change
        self.assert_finds("overlap_elsewhere", overlap(60.0), "crossing", "main_0_f1", "main_0_f0")
        self.assert_passes("overlap_elsewhere", overlap(12.0))

    def test_spaces_that_the_vehicle_does_not_get_to_or_into(self):
        def carry_off(town):
            del town.space().overlap_id[:]
            for point in town.space().polygon.point:
                point.y -= 40.0
            kept = [overlap for overlap in town.message.overlap if not overlap.id.id.startswith(b"row_0_")]
            del town.message.overlap[:]
            town.message.overlap.extend(kept)
        self.assert_finds("space_without_access", carry_off, "row_0", severity="error")
        self.assert_passes("space_without_access", None)
        self.assertEqual(len(self.findings(None, "space_small", vehicle={"wheelbase": 4.0})), 3)
        self.assertEqual(len(self.findings(None, "space_too_small", vehicle={"wheelbase": 5.5})), 3)
        self.assert_passes("space_small", None)
        self.assert_passes("space_too_small", None, vehicle={"wheelbase": 4.0})


if __name__ == "__main__":
    unittest.main()
