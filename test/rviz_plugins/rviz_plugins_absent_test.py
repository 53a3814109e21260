#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""In place of the tests of the panel, where that is not built."""
import unittest


class RvizPluginsTest(unittest.TestCase):
    def test_the_panel(self):
        self.skipTest("the headers of rviz or of its Qt are not installed (librviz-dev; qtbase5-dev, from Debian 13 on "
                      "qt6-base-dev), or EC_RVIZ_PLUGINS=OFF")


if __name__ == "__main__":
    unittest.main()
