# SPDX-License-Identifier: Apache-2.0
"""What the tests of the running system share, seen by the runner of rostest."""
import contextlib
import io
import unittest
import xml.etree.ElementTree as ElementTree

from rosunit import xmlrunner

import support


class Parts(support.TestCase):
    """Test cases for the cases below: unittest is not to find them in this file."""

    def all_pass(self):
        for number in range(3):
            with self.subTest(number):
                self.assertLess(number, 3)

    def two_fail(self):
        for number in range(4):
            with self.subTest("a number", number=number):
                self.assertEqual(number % 2, 0, "%d is odd" % number)

    def one_breaks(self):
        with self.subTest("the key"):
            raise KeyError("nowhere")

    def one_is_skipped(self):
        with self.subTest("the data"):
            self.skipTest("no data")


def run(name):
    """The result of one of the cases above, and its `testcase` in the file of results."""
    file = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()):  # the runner tells of failures there too
        result = xmlrunner.XMLTestRunner(stream=file).run(unittest.TestSuite([Parts(name)]))
    return result, ElementTree.fromstring(file.getvalue()).find("testcase")


class SubTestsTest(support.TestCase):
    def test_a_test_whose_parts_pass_passes(self):
        result, case = run("all_pass")
        self.assertTrue(result.wasSuccessful())
        self.assertEqual(list(case), [])

    def test_a_failed_part_fails_its_test_and_all_are_told_of(self):
        result, case = run("two_fail")
        self.assertFalse(result.wasSuccessful())
        text = case.find("failure").text
        for words in ("failed in 2 subTests", "[a number, number=1]", "1 is odd", "[a number, number=3]", "3 is odd"):
            self.assertIn(words, text)
        self.assertNotIn("number=2", text)

    def test_an_error_in_a_part_is_told_of(self):
        result, case = run("one_breaks")
        self.assertFalse(result.wasSuccessful())
        self.assertIn("KeyError: 'nowhere'", case.find("failure").text)

    def test_a_part_that_is_skipped_skips_its_test(self):
        result, _ = run("one_is_skipped")
        self.assertTrue(result.wasSuccessful())
        self.assertEqual([reason for _, reason in result.skipped], ["no data"])


class DeadlineTest(support.TestCase):
    def test_what_came_instead_is_told(self):
        seen = []
        with self.assertRaisesRegex(AssertionError, "not within 0 s: the third, after 1"):
            support.wait_until(lambda: seen.append(1), lambda: "the third, after %d" % len(seen), deadline=0.0)


if __name__ == "__main__":
    unittest.main()
