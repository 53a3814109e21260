#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""doc/command_line.md: its examples, typed into a shell as they stand there, the exit codes, and completion."""
import os
import re
import shutil
import subprocess
import sys
import unittest

import rospkg
import rospy
import rostest

import support
from external_command.client import CommandClient

PACKAGE = rospkg.RosPack().get_path("external_command")
sys.path.insert(0, os.path.join(PACKAGE, "test", "python"))
import doc_examples  # noqa: E402  (lies there)

PAGE = "command_line.md"
TIMEOUT = 120.0  # [s]; a command that takes longer hangs


class CommandLinePageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        support.wait_until_ready(CommandClient("apollo", support.DEADLINE))

    def test_every_example_of_the_page_works(self):
        examples = doc_examples.commands(PAGE)
        head, examples = examples[0], examples[1:]
        self.assertGreater(len(examples), 25)
        for line in examples:
            expected = re.search(r"# exits with (\d)", line)
            result = subprocess.run(["bash", "-c", "set -o pipefail\n%s\n%s" % (head, line)], stdout=subprocess.PIPE,
                                    stderr=subprocess.STDOUT, check=False, timeout=TIMEOUT)
            self.assertEqual(result.returncode, int(expected.group(1)) if expected else 0,
                             "%s: %s" % (line, result.stdout.decode()))

    def test_the_page_has_the_exit_codes_of_the_help(self):
        page = doc_examples.page(PAGE)
        told = subprocess.run(["rosrun", "external_command", "external_command_client", "--help"],
                              stdout=subprocess.PIPE, check=True, timeout=TIMEOUT).stdout.decode()
        codes = re.findall(r"^  (\d)  (.+)$", told, re.MULTILINE)
        self.assertEqual(len(codes), 8)
        for number, meaning in re.findall(r"^\| (\d) \| (.+) \|$", page, re.MULTILINE):
            self.assertEqual(dict(codes)[number], meaning.replace("`", ""))

    def test_ids_are_completed(self):
        try:
            import argcomplete  # noqa: F401
        except ImportError:
            self.skipTest("python3-argcomplete is not installed")
        setup = doc_examples.blocks(PAGE, "bash")[0]
        if not shutil.which("register-python-argcomplete"):
            setup = setup.replace("$(register-python-argcomplete ", "$(register-python-argcomplete3 ")
        line = "external_command_client valet-parking n_out_1"
        script = setup + '\nCOMP_LINE="%s" COMP_POINT=%d COMP_TYPE=9\n' % (line, len(line)) + \
            '_python_argcomplete external_command_client; printf "%s\\n" "${COMPREPLY[@]}"'
        offered = subprocess.run(["bash", "-c", script], stdout=subprocess.PIPE, check=False, timeout=TIMEOUT).stdout
        self.assertEqual({word.strip() for word in offered.decode().split()},
                         {"n_out_1"} | {"n_out_1%d" % n for n in range(10)})


if __name__ == "__main__":
    rospy.init_node("command_line_page_test")
    rostest.rosrun("external_command", "command_line_page", CommandLinePageTest)
