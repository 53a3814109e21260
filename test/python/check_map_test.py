# SPDX-License-Identifier: Apache-2.0
"""The command check_map: what it prints, draws, and ends with."""
import json
import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import doc_examples
from external_command import map_check
from small_town import ROOT, MapCheckTest, in_turn

SHARED_MAPS = os.path.join(ROOT, "..", "shared", "data", "maps")


class CommandTest(MapCheckTest):
    def run_command(self, *words):
        """(exit code, stdout, stderr) of scripts/check_map."""
        result = subprocess.run([sys.executable, os.path.join(ROOT, "scripts", "check_map"), *words],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        return result.returncode, result.stdout.decode(), result.stderr.decode()

    @staticmethod
    def warn(town):
        town["main_0_f1"].speed_limit = 0.0

    @staticmethod
    def break_link(town):
        town["main_0_f1"].successor_id.add(id=b"gho<st")

    def test_a_clean_map_ends_with_0(self):
        code, out, _ = self.run_command(self.written())
        self.assertEqual(code, 0)
        self.assertIn("16 lanes, 1.0 km of them to drive on, 3 parking spaces, 1 area, 2 junctions", out)
        self.assertTrue(out.endswith("0 errors, 0 warnings\n"), out)

    def test_the_exit_code_depends_on_what_is_asked_for(self):
        warned, failed = self.written(self.warn, "warned.bin"), self.written(self.break_link, "failed.bin")
        for map_file, fail_on, expected in ((warned, "error", 0), (warned, "warning", 1), (failed, "error", 1),
                                            (failed, "warning", 1), (failed, "never", 0)):
            self.assertEqual(self.run_command(map_file, "--fail-on", fail_on)[0], expected, (map_file, fail_on))
        self.assertEqual(self.run_command(failed)[0], 1)
        self.assertEqual(self.run_command(failed, "--ignore", "reference_dangling")[0], 0)

    def test_a_finding_tells_which_where_and_what_next(self):
        _, out, _ = self.run_command(self.written(self.break_link))
        self.assertIn("ERROR reference_dangling: 1 references to lanes that do not exist", out)
        self.assertIn("    successor gho<st of main_0_f1   at (0.00, -5.25)", out)
        self.assertIn("  what next: put the id right, or leave the reference out", out)

    def test_of_many_findings_the_largest_are_shown(self):
        def clear(town):
            for lane in town.message.lane:
                lane.speed_limit = 0.0
        map_file = self.written(clear)
        _, out, _ = self.run_command(map_file)
        self.assertIn("and 11 more (--max 0 shows all)", out)
        _, out, _ = self.run_command(map_file, "--max", "0")
        self.assertNotIn("more (--max", out)
        self.assertEqual(out.count("   at ("), 16)

    def test_json_holds_the_same(self):
        code, out, _ = self.run_command(self.written(self.break_link), "--format", "json")
        report = json.loads(out)
        self.assertEqual((code, report["errors"]), (1, 1))
        self.assertEqual(report["findings"][0]["ids"], ["main_0_f1", "gho<st"])
        self.assertEqual(report["findings"][0]["advice"], "put the id right, or leave the reference out")

    def test_the_drawing_marks_each_finding(self):
        drawing = os.path.join(self.folder.name, "map.svg")
        self.run_command(self.written(in_turn(self.break_link, self.warn)), "--svg", drawing)
        root = ElementTree.parse(drawing).getroot()
        titles = [element.text for element in root.iter("{http://www.w3.org/2000/svg}title")]
        self.assertEqual(titles, ["speed_limit_missing: main_0_f1", "reference_dangling: successor gho<st of main_0_f1"])
        self.assertGreater(len(list(root.iter("{http://www.w3.org/2000/svg}polyline"))), 16)

    def test_the_vehicle_is_read_from_its_file(self):
        vehicle = os.path.join(self.folder.name, "vehicle.yaml")
        for text in ("width: 3.6", "vehicle: {width: 3.6}"):
            with open(vehicle, "w", encoding="utf-8") as file:
                file.write(text + "\n")
            code, out, _ = self.run_command(self.written(), "--vehicle", vehicle)
            self.assertEqual(code, 1)
            self.assertIn("ERROR lane_narrow: 16 driving lanes narrower than the vehicle", out)
        self.assertEqual(self.run_command(self.written(), "--vehicle", os.path.join(ROOT, "config/vehicle.yaml"))[0], 0)

    def test_what_cannot_be_read_ends_with_2_and_says_why(self):
        nothing = os.path.join(self.folder.name, "nothing.bin")
        open(nothing, "wb").close()
        vehicle = os.path.join(self.folder.name, "bad.yaml")
        with open(vehicle, "w", encoding="utf-8") as file:
            file.write("widht: 2.0\n")
        for words, told in (([nothing], "nothing.bin"), (["/no/such/map.bin"], "/no/such/map.bin"),
                            ([], "a map file is needed"), ([self.written(), "--vehicle", vehicle], "did you mean 'width'"),
                            ([self.written(), "--vehicle", "/no/such.yaml"], "/no/such.yaml"),
                            ([self.written(), "--ignore", "link_gab"], "did you mean 'link_gap'"),
                            ([self.written(), "--max-link-gap", "-1"], "max_link_gap"),
                            ([self.written(), "--max", "-1"], "--max"),
                            ([self.written(), "--svg", "/no/such/folder/a.svg"], "cannot be written")):
            with self.subTest(words):
                code, out, error = self.run_command(*words)
                self.assertEqual((code, out), (2, ""))
                self.assertIn(told, error)

    def test_the_kinds_are_listed(self):
        code, out, _ = self.run_command("--kinds")
        self.assertEqual(code, 0)
        self.assertEqual(len(out.splitlines()), len(map_check.kinds()))
        self.assertIn("error    link_broken", out)


class PageTest(MapCheckTest):
    def test_every_example_works(self):
        examples = doc_examples.commands("check_map.md")
        self.assertGreater(len(examples), 2)
        for line in examples:
            result = subprocess.run(["bash", "-c", line], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                    check=False)
            self.assertEqual(result.returncode, 0, "%s: %s" % (line, result.stdout.decode()))
            self.assertIn("0 errors, 0 warnings", result.stdout.decode(), line)

    def test_every_kind_is_described_as_it_is(self):
        page = doc_examples.page("check_map.md")
        for kind in map_check.kinds():
            self.assertIn("| `%(kind)s` | %(severity)s | %(what)s | %(advice)s |\n" % kind, page)

    def test_a_finding_has_the_fields_of_the_example(self):
        example = json.loads(doc_examples.blocks("check_map.md", "json")[0])
        finding = map_check.check_map(self.written(CommandTest.break_link))["findings"][0]
        self.assertEqual(list(finding), list(example))


class SharedMapsTest(MapCheckTest):
    """Maps of others, of which each kind of finding was looked at by hand."""

    def setUp(self):
        if not os.path.isdir(SHARED_MAPS):
            self.skipTest("there is no " + SHARED_MAPS)

    def test_the_towns_are_clean(self):
        for town in ("town01", "town10hd"):
            for name in ("base_map.bin", "sim_map.bin", "sim_map.txt"):
                report = map_check.check_map(os.path.join(SHARED_MAPS, town, name))
                self.assertEqual((report["findings"], report["notes"]), ([], []), (town, name))

    def test_the_car_park_has_what_its_file_says_wrong(self):
        map_file = os.path.join(SHARED_MAPS, "autonomoustuff", "base_map.bin")
        report = map_check.check_map(map_file)
        found = {}
        for finding in report["findings"]:
            found.setdefault(finding["kind"], []).append(finding)
        self.assertEqual(report["errors"], 0)
        self.assertEqual(sorted(found), ["lane_dead_end", "lane_unreachable", "neighbours_missing", "overlap_elsewhere",
                                         "overlap_one_sided", "space_heading_across", "space_small"])
        stated = self.format.Map()
        with open(map_file, "rb") as file:
            stated.MergeFromString(file.read())
        overlaps = {overlap.id.id for overlap in stated.overlap}
        named = sum(one.id not in overlaps for lane in stated.lane for one in lane.overlap_id)
        self.assertEqual(len([f for f in found["overlap_one_sided"] if "does not exist" in f["what"]]), named)
        begins = {lane.id.id.decode() for lane in stated.lane if not lane.predecessor_id}
        for finding in found["lane_unreachable"]:
            self.assertTrue(begins & set(finding["ids"]), "the map begins there: %s" % finding)
        for finding in found["overlap_elsewhere"]:
            part = next(o for o in stated.overlap if o.id.id.decode() == finding["ids"][0]).object[0].lane_overlap_info
            self.assertEqual(part.start_s, part.end_s, "a range of no length, at an end of the lane")


if __name__ == "__main__":
    unittest.main()
