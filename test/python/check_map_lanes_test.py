# SPDX-License-Identifier: Apache-2.0
"""What check_map finds of lanes, kind by kind, in a small map that is right but for the one fault; and that it finds
nothing where the same thing is just as it may be."""
import copy
import math
import os
import resource
import unittest

from external_command import map_check
from small_town import ROOT, MapCheckTest, in_turn


class CleanMapTest(MapCheckTest):
    def test_nothing_is_found_in_the_small_town(self):
        report = map_check.check_map(self.written())
        self.assertEqual((report["findings"], report["notes"]), ([], []))
        self.assertEqual((report["lanes"], report["driving_lanes"], report["parking_spaces"], report["areas"]),
                         (16, 16, 3, 1))

    def test_nothing_is_found_in_the_demo_town(self):
        for name in ("base_map.bin", "base_map.txt"):
            report = map_check.check_map(os.path.join(ROOT, "maps", "demo_town", name))
            self.assertEqual((report["findings"], report["notes"]), ([], []))


class LaneTest(MapCheckTest):
    def test_a_lane_that_cannot_be_used(self):
        def cut(town):
            del town.center("main_0_f1")[1:]
        self.assert_finds("lane_unusable", cut, "main_0_f1", what="1 distinct points; at least 2", severity="error")
        self.assert_passes("lane_unusable", None)

    def test_an_id_of_two_lanes(self):
        def change(town):
            town["main_0_f1"].id.id = b"main_0_f0"
        self.assert_finds("lane_id_repeated", change, "main_0_f0", severity="error")
        self.assert_passes("lane_id_repeated", lambda town: town.add_island())

    def test_a_type_that_is_missing_or_unknown(self):
        def set_type(value):
            def change(town):
                data = town["main_0_f1"].SerializePartialToString()
                town["main_0_f1"].ClearField("type")
                if value is not None:  # as a file of a later format has it
                    town["main_0_f1"].MergeFromString(bytes([12 << 3, value]))
                self.assertNotEqual(data, b"")
            return change
        self.assert_finds("lane_type_missing", set_type(None), "main_0_f1")
        self.assert_finds("lane_type_unknown", set_type(77), "main_0_f1")
        self.assert_passes("lane_type_unknown", set_type(2))

    def test_a_lane_of_no_length(self):
        def squeeze(town):
            points = town.center("main_0_f1")
            for point in points:
                point.CopyFrom(points[-1])
        self.assert_finds("lane_without_length", squeeze, "main_0_f1")
        self.assert_passes("lane_without_length", None)

    def test_a_wrong_length(self):
        def state(metres):
            def change(town):
                town["main_0_f1"].length = metres
            return change
        self.assert_finds("lane_length_wrong", state(110.0), "main_0_f1", what="110.00 m stated, 100.00 m measured")
        self.assert_passes("lane_length_wrong", state(102.0))

    def test_a_centre_line_that_folds_back(self):
        def step(metres):
            def change(town):
                points = town.center("main_0_f1")
                last = points[-1]
                points.add(x=last.x, y=last.y)
                last.x += metres
            return change
        self.assert_finds("fold", step(3.0), "main_0_f1", what="by 3.00 m")
        self.assert_passes("fold", step(-3.0))

    def test_a_lane_stated_to_be_driven_backwards(self):
        def state(direction):
            def change(town):
                town["main_0_f1"].direction = direction
            return change
        self.assert_finds("direction_backward", state(self.format.Lane.BACKWARD), "main_0_f1")
        self.assert_passes("direction_backward", state(self.format.Lane.BIDIRECTION))

    def test_speed_limits(self):
        def state(limit):
            def change(town):
                town["main_0_f1"].speed_limit = limit
            return change
        self.assert_finds("speed_limit_missing", state(0.0), "main_0_f1")
        self.assert_finds("speed_limit_absurd", state(50.0), "main_0_f1", what="50 m/s, which is 180 km/h")
        self.assert_finds("speed_limit_absurd", state(0.5), "main_0_f1")
        self.assert_finds("speed_limit_unusable", state(-3.0), "main_0_f1")
        for limit in (2.0, 36.2):
            for kind in ("speed_limit_missing", "speed_limit_absurd", "speed_limit_unusable"):
                self.assert_passes(kind, state(limit))

    def test_a_bend_that_the_vehicle_cannot_drive(self):
        def bend(radius):
            def change(town):
                lane = town.add_island()
                points = town.line(lane.central_curve)
                point_class = points[0].__class__
                del points[:]
                points.extend(point_class(x=radius * math.sin(a / 10.0), y=200.0 + radius * (1.0 - math.cos(a / 10.0)))
                              for a in range(48))
            return change
        self.assert_finds("lane_sharp_bend", bend(2.3), "island", what="the vehicle turns on 5.00 m")
        self.assert_passes("lane_sharp_bend", bend(5.0))
        self.assert_passes("lane_sharp_bend", bend(2.3), vehicle={"min_turning_radius": 3.0})


class WidthTest(MapCheckTest):
    def test_a_lane_narrower_than_the_vehicle(self):
        def set_half(half):
            return lambda town: town.set_widths("main_0_f1", half)
        found = self.assert_finds("lane_narrow", set_half(0.9), "main_0_f1", what="1.80 m wide; the vehicle is 2.00 m",
                                  severity="error")
        self.assertAlmostEqual(found["size"], 0.2)
        self.assert_passes("lane_narrow", set_half(1.1))
        self.assert_finds("lane_narrow", set_half(1.1), "main_0_f1", vehicle={"width": 2.5})

    def test_a_lane_that_nobody_drives_on_may_be_narrow(self):
        def change(town):
            town.set_widths("main_0_f1", 0.5)
            town["main_0_f1"].type = self.format.Lane.BIKING
        self.assert_passes("lane_narrow", change)

    def test_a_lane_wider_than_10_m(self):
        self.assert_finds("lane_wide", lambda town: town.set_widths("main_0_f1", 5.5), "main_0_f1", what="11.00 m")
        self.assert_passes("lane_wide", lambda town: town.set_widths("main_0_f1", 4.5))

    def test_a_side_of_which_nothing_tells_the_width(self):
        def clear(*fields):
            def change(town):
                for field in fields:
                    town["main_0_f1"].ClearField(field)
            return change
        self.assert_finds("width_missing", clear("left_sample", "left_boundary"), "main_0_f1", what="at its left")
        self.assert_passes("width_missing", clear("left_sample", "right_boundary"))

    def test_samples_that_the_boundary_disagrees_with(self):
        def sample(width):
            def change(town):
                for one in town["main_0_f1"].right_sample:
                    one.width = width
            return change
        self.assert_finds("width_disagrees", sample(2.5), "main_0_f1", what="2.50 m by the samples, 1.75 m to the")
        self.assert_passes("width_disagrees", sample(2.0))
        self.assert_finds("width_sample_unusable",
                          lambda town: setattr(town["main_0_f1"].left_sample[0], "width", -1.0), "main_0_f1")

    def test_boundaries_that_changed_sides(self):
        def swap(town):
            lane = town["main_0_f1"]
            left = copy.deepcopy(lane.left_boundary)
            lane.left_boundary.CopyFrom(lane.right_boundary)
            lane.right_boundary.CopyFrom(left)
        found = self.findings(swap, "boundary_wrong_side")
        self.assertEqual(sorted(finding["what"].split(" of")[0] for finding in found), ["the left one", "the right one"])
        self.assert_passes("boundary_wrong_side", None)

    def test_a_boundary_drawn_against_the_lane(self):
        def turn(town):
            town.reverse(town.line(town["main_0_f1"].left_boundary.curve))
        self.assert_finds("boundary_reversed", turn, "main_0_f1", what="the left one")
        self.assert_passes("boundary_reversed", None)

    def test_a_boundary_that_is_nowhere(self):
        def spoil(town):
            town.line(town["main_0_f1"].left_boundary.curve)[0].x = math.inf
        self.assert_finds("boundary_unusable", spoil, "main_0_f1", severity="error")


class LinkTest(MapCheckTest):
    def test_a_successor_that_does_not_exist(self):
        def add(lane_id):
            return lambda town: town["main_0_f1"].successor_id.add(id=lane_id)
        found = self.assert_finds("reference_dangling", add(b"ghost"), "main_0_f1", "ghost", severity="error")
        self.assertEqual((found["x"], found["y"]), (0.0, -5.25))
        self.assert_passes("reference_dangling", add(b"main_1_f1"))

    def test_what_a_lane_dangles_that_nobody_drives_on_is_a_warning(self):
        def change(town):
            town["main_0_f1"].successor_id.add(id=b"ghost")
            town["main_0_f1"].type = self.format.Lane.SHOULDER
        self.assert_finds("reference_dangling", change, "main_0_f1", severity="warning")

    def test_a_map_linked_backwards_only(self):
        def clear(town):
            for lane in town.message.lane:
                lane.ClearField("successor_id")
        self.assertEqual(len(self.findings(clear, "link_backwards_only")), 14)
        self.assert_passes("link_one_sided", clear)

    def test_ends_that_do_not_meet(self):
        def move(dx):
            return in_turn(lambda town: town.move("main_1_f1", dx, 0.0),
                           lambda town: town["main_1_f1"].ClearField("successor_id"))
        self.assert_finds("link_broken", move(5.0), "main_0_f1", "main_1_f1", what="5.00 m", severity="error")
        self.assert_finds("link_gap", move(1.0), "main_0_f1", "main_1_f1", what="1.00 m")
        self.assert_finds("link_overlap", move(-3.0), "main_0_f1", "main_1_f1", what="by 3.00 m")
        for kind in ("link_broken", "link_gap", "link_overlap"):
            self.assert_passes(kind, move(0.2))
        self.assert_passes("link_broken", move(5.0), max_link_gap=6.0)

    def test_a_link_at_which_the_heading_jumps(self):
        def turn(angle):
            def change(town):
                points = town.center("main_1_f1")
                x, y, length = points[0].x, points[0].y, points[-1].x - points[0].x
                del points[1:]
                points.add(x=x + length * math.cos(angle), y=y + length * math.sin(angle))
                town["main_1_f1"].ClearField("successor_id")
            return change
        self.assert_finds("link_kink", turn(-1.5), "main_0_f1", "main_1_f1", what="by 1.50 rad")
        self.assert_passes("link_kink", turn(-0.5))

    def test_a_link_that_only_one_of_the_two_states(self):
        def drop(lane_id, field):
            return lambda town: town[lane_id].ClearField(field)
        self.assert_finds("link_one_sided", drop("main_0_f1", "successor_id"), "main_0_f1", "main_1_f1",
                          what="it is not driven")
        self.assert_finds("link_one_sided", drop("main_1_f1", "predecessor_id"), "main_0_f1", "main_1_f1",
                          what="it is driven")
        both = in_turn(drop("main_0_f1", "successor_id"), drop("main_1_f1", "predecessor_id"))
        self.assert_passes("link_one_sided", both)
        self.assert_finds("link_missing", both, "main_0_f1", "main_1_f1", what="0.00 m apart")
        self.assert_passes("link_missing", None)

    def test_a_link_that_is_broken_is_not_missing(self):
        def part(town):
            town.move("main_1_f1", 0.1, 0.0)
        self.assert_finds("link_broken", part, "main_0_f1", "main_1_f1", max_link_gap=0.05)
        self.assert_passes("link_missing", part, max_link_gap=0.05)
        self.assert_passes("link_broken", part)

    def test_a_link_is_missing_of_several_that_meet(self):
        def meet(is_linked):
            def change(town):
                for name in ("a", "b", "c"):
                    links = [("predecessor_id", "main_0_f1")] if is_linked or name != "b" else []
                    town.add_island(100.0, 0.0, name, links)
                    town.move(name, 0.0, town.center("main_0_f1")[-1].y - town.center(name)[0].y)
                    if links:
                        town["main_0_f1"].successor_id.add(id=name.encode())
            return change
        self.assert_finds("link_missing", meet(False), "main_0_f1", "b")
        self.assert_passes("link_missing", meet(True))

    def test_a_lane_into_which_thousands_lead_is_looked_at_once_for_each(self):
        def lead(town):
            last = town["main_0_f1"]
            for i in range(80000):
                lane = town.message.lane.add(type=last.type)
                lane.id.id = b"one of many lanes, number %d" % i
                line = lane.central_curve.segment.add().line_segment
                line.point.add(x=0.0, y=1000.0 + 20.0 * i)
                line.point.add(x=50.0, y=1000.0 + 20.0 * i)
                lane.successor_id.add().CopyFrom(last.id)
                last.predecessor_id.add().CopyFrom(lane.id)
        kinds = [kind["kind"] for kind in map_check.kinds() if kind["kind"] != "link_one_sided"]
        path = self.written(lead)
        begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        self.assertEqual([], map_check.check_map(path, ignore=kinds)["findings"])
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin, 12.0)

    def test_a_link_at_which_the_height_jumps(self):
        def lift(metres):
            def change(town):
                for lane in town.message.lane:
                    for point in town.line(lane.central_curve):
                        point.z = 10.0
                for point in town.center("main_1_f1"):
                    point.z = 10.0 + metres
            return change
        self.assert_finds("link_height_jump", lift(1.0), "main_0_f1", "main_1_f1", what="by 1.00 m")
        self.assert_passes("link_height_jump", lift(0.3))


class NeighbourTest(MapCheckTest):
    def test_a_neighbour_on_the_other_side_than_stated(self):
        def swap(town):
            for inner, outer in (("main_0_f0", "main_0_f1"),):
                town[inner].ClearField("right_neighbor_forward_lane_id")
                town[inner].left_neighbor_forward_lane_id.add(id=outer.encode())
        self.assert_finds("neighbour_wrong_side", swap, "main_0_f0", "main_0_f1", what="left neighbour")
        self.assert_passes("neighbour_one_sided", swap)

    def test_a_forward_neighbour_that_comes_towards_one(self):
        def add(town):
            town["main_0_f0"].left_neighbor_forward_lane_id.add(id=b"main_0_b0")
        self.assert_finds("neighbour_oncoming", add, "main_0_f0", "main_0_b0", severity="error")

    def test_a_neighbour_far_away(self):
        def add(town):
            town.add_island()
            town["main_0_f0"].left_neighbor_forward_lane_id.add(id=b"island")
        self.assert_finds("neighbour_far", add, "main_0_f0", "island", what="200.00 m off", severity="error")

    def test_a_neighbour_that_only_one_of_the_two_states(self):
        def drop(*fields):
            def change(town):
                for field in fields:
                    town["main_0_f1"].ClearField(field)
            return change
        self.assert_finds("neighbour_one_sided", drop("left_neighbor_forward_lane_id"), "main_0_f0", "main_0_f1",
                          what="right forward neighbour of main_0_f0")
        self.assert_passes("neighbour_one_sided", drop("overlap_id"))

    def test_a_reverse_neighbour_that_runs_the_same_way(self):
        def add(town):
            for one, other in (("main_0_f0", b"main_0_f1"), ("main_0_f1", b"main_0_f0")):
                town[one].right_neighbor_reverse_lane_id.add(id=other)
        found = self.findings(add, "neighbour_not_oncoming")
        self.assertEqual([finding["ids"] for finding in found], [["main_0_f0", "main_0_f1"], ["main_0_f1", "main_0_f0"]])
        self.assert_passes("neighbour_not_oncoming", None)

    def test_a_map_without_any_neighbours(self):
        def clear(town):
            for lane in town.message.lane:
                lane.ClearField("left_neighbor_forward_lane_id")
                lane.ClearField("right_neighbor_forward_lane_id")
        self.assertEqual(len(self.findings(clear, "neighbours_missing")), 8)


class ReachTest(MapCheckTest):
    def test_a_lane_with_no_way_to_the_others(self):
        found = self.assert_finds("lane_isolated", lambda town: town.add_island(), "island", what="100.00 m",
                                  severity="error")
        self.assertEqual((found["x"], found["y"]), (50.0, 198.25))
        self.assert_passes("lane_isolated", None)

    def test_lanes_that_lead_only_out_or_only_in(self):
        def out(town):
            town.add_island(-100.0, -3.5, "source", [("successor_id", "main_0_f1")])
        self.assert_finds("lane_unreachable", out, "source", what="100.00 m", severity="warning")
        self.assert_passes("lane_dead_end", out)

        def into(town):
            town["main_1_f1"].successor_id.add(id=b"sink")
            town.add_island(200.0, -3.5, "sink")
        self.assert_finds("lane_dead_end", into, "sink", severity="warning")
        self.assert_passes("lane_unreachable", into)

    def test_a_map_of_a_single_road_is_not_judged(self):
        def keep_one_way(town):
            lanes = [copy.deepcopy(town[lane_id]) for lane_id in ("main_0_f0", "main_1_f0")]
            del town.message.lane[:]
            town.message.lane.extend(lanes)
        report = map_check.check_map(self.written(keep_one_way))
        self.assertIn("lane_isolated, lane_unreachable and lane_dead_end are not judged", report["notes"][0])


class EveryKindTest(unittest.TestCase):
    def test_every_kind_is_looked_for_by_a_test(self):
        tests = ""
        for name in ("check_map_lanes_test.py", "check_map_objects_test.py"):
            with open(os.path.join(os.path.dirname(os.path.realpath(__file__)), name), encoding="utf-8") as file:
                tests += file.read()
        self.assertEqual([], [kind["kind"] for kind in map_check.kinds() if '"%s"' % kind["kind"] not in tests])


if __name__ == "__main__":
    unittest.main()
