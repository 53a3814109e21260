# SPDX-License-Identifier: Apache-2.0
import os
import sys
import unittest

import rospkg

sys.path.append(os.path.join(rospkg.RosPack().get_path("external_command"), "scripts", "lib"))
import benchmark_table  # noqa: E402

CALL = {"benchmark": "service", "map": "/maps/town/base_map.bin", "lane_follow_us": 300.0, "lane_follow_p99_us": 450.0,
        "empty_us": 100.0, "empty_p99_us": 300.0, "vehicles": 1}


class BenchmarkTableTest(unittest.TestCase):
    def rows(self, *measurements):
        return benchmark_table.text_of(measurements).splitlines()[1:]

    def test_shows_what_was_timed_beside_what_it_is_compared_with(self):
        row, = self.rows(CALL)
        self.assertEqual(row.split(), "lane follow town 300 us 450 us empty service 100 us 300 us 3.00 1.50".split())

    def test_tells_many_vehicles_and_the_memory_of_each(self):
        call, memory = self.rows(dict(CALL, vehicles=50, further_vehicle_mb=1.5, first_vehicle_mb=60.0))
        self.assertTrue(call.startswith("lane follow, 50 vehicles"))
        self.assertEqual(memory.split()[-3:], ["60", "MB", "0.03"])

    def test_names_the_file_where_it_is_not_the_usual_one(self):
        row, = self.rows(dict(CALL, map="/maps/town/sim_map.txt"))
        self.assertIn(" town/sim_map.txt ", row)

    def test_leaves_out_what_was_not_compared(self):
        row, = self.rows({"benchmark": "map_benchmark", "file": "/maps/town/sim_map.txt", "lanes": 7, "load_ms": 2.0})
        self.assertEqual(row.split(), ["load", "town/sim_map.txt", "7", "2", "ms"])

    def test_ends_with_what_failed(self):
        self.assertEqual(self.rows(CALL, {"benchmark": "map_benchmark", "error": "no such file"})[-1],
                         "FAILED: map_benchmark: no such file")


if __name__ == "__main__":
    unittest.main()
