# SPDX-License-Identifier: Apache-2.0
"""What scripts/demo shows on a terminal: the count of the build, and the examples of its tour."""
import os
import subprocess
import sys
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts", "lib"))
import demo_tour  # noqa: E402  (of the scripts)
from external_command.msg import CommandStatus  # noqa: E402

BUILD = "s/^\\[ *([0-9]+)%\\].*/building \\1/p"
APT = "s/^dlstatus:[^:]*:([0-9]+).*/fetching \\1/p; s/^pmstatus:[^:]*:([0-9]+).*/installing \\1/p"


def counted(script, *lines):
    """What ec_count makes of the lines, where no terminal is."""
    command = 'source "$0/scripts/lib/workspace.sh" && ec_count "$1"'
    result = subprocess.run(["bash", "-euc", command, ROOT, script], input="".join(line + "\n" for line in lines).encode(),
                            stdout=subprocess.PIPE, check=True)
    return result.stdout.decode().splitlines()


class FakeStack:
    def check(self):
        pass


class FakeExample(demo_tour.Example):
    def __init__(self, answer):
        super().__init__("", "", "")
        self._answer = answer

    def answer(self):
        return self._answer


def status(number, **fields):
    return dict(status=number, command_id=7, message="", **fields)


class Statuses:
    """The status service: RUNNING once, then `end`."""

    def __init__(self, end):
        self._statuses = [CommandStatus(status=CommandStatus.RUNNING), CommandStatus(status=end)]

    def __call__(self, command_id):
        return self._statuses.pop(0)


class DemoTest(unittest.TestCase):
    def test_the_build_is_counted_in_tens_without_the_compilers_words(self):
        self.assertEqual(counted(BUILD, "[  3%] Building CXX object a.o", "warning: Boost", "[  4%] Built target a",
                                 "[ 25%] Linking", "[100%] Built target b"),
                         ["building: 0 %, 0 min", "building: 20 %, 0 min", "building: 100 %, 0 min"])

    def test_what_is_fetched_and_installed_is_counted(self):
        self.assertEqual(counted(APT, "dlstatus:1:0.5:Retrieving", "Preparing to unpack", "dlstatus:9:99.9:Retrieving",
                                 "pmstatus:rviz:50:Unpacking"),
                         ["fetching: 0 %, 0 min", "fetching: 90 %, 0 min", "installing: 50 %, 0 min"])

    def test_nothing_is_counted_where_nothing_is_told(self):
        self.assertEqual(counted(BUILD, "make: nothing to be done"), [])

    def test_the_tour_has_an_example_of_each_service_and_says_what_it_does(self):
        examples = demo_tour.read_examples(os.path.join(ROOT, "README.md"))
        self.assertGreater(len(examples), 10)
        self.assertEqual(len({example.service for example in examples}), len(examples))
        for example in examples:
            self.assertTrue(example.purpose, example.service)

    def test_a_tour_is_a_success_only_where_all_commands_have_finished(self):
        for end, is_good in ((CommandStatus.FINISHED, True), (CommandStatus.ERROR, False)):
            tour = demo_tour.Tour(FakeStack(), Statuses(end))
            self.assertEqual(tour.go([FakeExample({"status": status(CommandStatus.RUNNING)})]), is_good)
        for number, is_good in ((CommandStatus.FINISHED, True), (CommandStatus.ERROR, False)):
            tour = demo_tour.Tour(FakeStack(), None)
            self.assertEqual(tour.go([FakeExample({"status": status(number)})]), is_good)
        for answer, is_good in (({"objects": []}, True), ({"error_code": 1, "error_message": "wrong"}, False)):
            self.assertEqual(demo_tour.Tour(FakeStack(), None).go([FakeExample(answer)]), is_good)


if __name__ == "__main__":
    unittest.main()
