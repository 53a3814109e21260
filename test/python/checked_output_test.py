#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Programs whose output cannot be written."""
import os
import subprocess
import sys
import unittest

PROGRAM = """
import sys
from external_command.checked_output import exit_code_of
def main():
    print("a line")
    return 3
sys.exit(exit_code_of(main, 7))
"""


def run(stdout):
    """(exit code, what it says to stderr)"""
    result = subprocess.run([sys.executable, "-c", PROGRAM], stdout=stdout, stderr=subprocess.PIPE, check=False)
    return result.returncode, result.stderr.decode()


class CheckedOutputTest(unittest.TestCase):
    def test_leaves_the_exit_code_alone_where_all_is_written(self):
        self.assertEqual(run(subprocess.DEVNULL), (3, ""))

    def test_a_full_disk_is_told(self):
        with open("/dev/full", "wb") as full:
            self.assertEqual(run(full), (7, "the output could not be written: [Errno 28] No space left on device\n"))

    def test_a_reader_that_has_gone_away_is_not(self):
        reader, writer = os.pipe()
        os.close(reader)
        self.assertEqual(run(writer), (7, ""))
        os.close(writer)

    def test_a_program_without_an_output_runs_as_ever(self):
        program = [sys.executable, "-c", "import os, sys\nos.close(1)\nos.execv(sys.executable, sys.argv)", "-c", PROGRAM]
        result = subprocess.run([program[0], *program[1:3], *program[3:]], stderr=subprocess.PIPE, check=False)
        self.assertEqual((result.returncode, result.stderr), (3, b""))


if __name__ == "__main__":
    unittest.main()
