#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How late scripts/fuzz lets an answer come."""
import os
import sys
import unittest

import rospkg

sys.path.append(os.path.join(rospkg.RosPack().get_path("external_command"), "scripts", "lib"))
from answer_times import ANSWER_LIMIT, latest_answer  # noqa: E402


class LatestAnswerTest(unittest.TestCase):
    def test_counts_the_line_of_who_plans(self):
        self.assertEqual(latest_answer("zone_cover", is_dry_run=True, limit=5.0, cores=2), 5.0 + 6 * 3.0)
        self.assertEqual(latest_answer("free_space", is_dry_run=True, limit=5.0, cores=3), 5.0 + 3 * 3.0)
        self.assertEqual(latest_answer("free_space", is_dry_run=False, limit=1.0, cores=8), 1.0 + 3 * 3.0)
        self.assertEqual(latest_answer("free_space", is_dry_run=True, limit=5.0, cores=1), 5.0 + 6 * 3.0)

    def test_counts_none_for_what_waits_for_no_plan(self):
        for service in ("speed", "chassis", "action"):
            self.assertEqual(latest_answer(service), ANSWER_LIMIT)
            self.assertEqual(latest_answer(service, limit=0.1), 0.1)


if __name__ == "__main__":
    unittest.main()
