#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The code in doc/add_a_processor.md is that of the example."""
import os
import re
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
EXAMPLE = os.path.join(ROOT, "examples", "parcel_station")
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
ONLY_IN_THE_PAGE = ("sh",)  # commands to type


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class AddAProcessorTest(unittest.TestCase):
    def test_every_block_of_code_stands_in_a_file_of_the_example(self):
        paths = [os.path.join(folder, name) for folder, _, names in os.walk(EXAMPLE) for name in names]
        sources = [read(path) for path in paths if not path.endswith(".pyc")]
        blocks = BLOCK.findall(read(os.path.join(ROOT, "doc", "add_a_processor.md")))
        self.assertGreater(len(blocks), 10)
        for language, block in blocks:
            if language not in ONLY_IN_THE_PAGE:
                self.assertTrue(any(block in source for source in sources), "not in the example:\n" + block)


if __name__ == "__main__":
    unittest.main()
