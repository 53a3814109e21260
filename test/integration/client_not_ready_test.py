#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the Python client and the command line tell of a gateway that lacks map, pose and chassis."""
import json
import subprocess
import unittest

import rospy
import rostest

import support
from external_command.client import CommandClient, NotReady
from external_command.msg import CommandStatus


def run(*words):
    """(exit code, stdout, stderr) of `external_command_client`."""
    result = subprocess.run(["rosrun", "external_command", "external_command_client", *words], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, check=False, timeout=60.0)
    return result.returncode, result.stdout.decode(), result.stderr.decode()


class ClientNotReadyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.client = CommandClient("apollo", timeout=support.DEADLINE)
        cls.client.readiness()

    def unmet(self, service=None):
        return {condition.name: condition.message for condition in self.client.unmet(service)}

    def test_what_is_missing_is_told_in_the_words_of_the_refusal(self):
        missing = self.unmet("lane_follow")
        self.assertIn("map", missing)
        with self.assertRaises(NotReady) as caught:
            self.client.lane_follow(x=1.0, y=2.0)
        self.assertIn(caught.exception.status.message, missing.values())

    def test_each_service_lacks_what_it_needs(self):
        self.assertIn("map", self.unmet())
        self.assertIn("map", self.unmet("valet_parking"))
        self.assertNotIn("map", self.unmet("free_space"))
        self.assertIn("pose", self.unmet("free_space"))

    def test_why_not_tells_it_and_ends_with_1(self):
        code, out, _ = run("why-not", "free-space")
        self.assertEqual(code, 1)
        self.assertRegex(out, r"(?m)^pose: .*free-space")
        self.assertNotRegex(out, r"(?m)^map:")
        code, out, _ = run("why-not", "--json")
        answer = json.loads(out)
        self.assertEqual((code, answer["is_ready"]), (1, False))
        self.assertEqual({one["name"]: one["message"] for one in answer["unmet"]}.keys(), self.unmet().keys())

    def test_without_a_map_nothing_is_listed(self):
        with self.assertRaises(NotReady):
            self.client.map_objects("spaces")
        for words in (("list", "spaces"), ("map", "info")):
            code, out, told = run(*words)
            self.assertEqual((code, out), (1, ""))
            self.assertIn("NOT_READY: ", told)

    def test_a_refused_command_ends_with_1(self):
        code, out, _ = run("lane-follow", "--to", "1", "2")
        self.assertEqual(code, 1)
        self.assertIn("(NOT_READY)", out)

    def test_where_nothing_was_driven_there_is_nothing_to_watch(self):
        self.assertEqual(self.client.current().motion.status, CommandStatus.UNKNOWN)
        code, _, told = run("watch")
        self.assertEqual(code, 6)
        self.assertIn("no command runs", told)
        self.assertIn("no motion command so far", run("current")[1])


if __name__ == "__main__":
    rospy.init_node("client_not_ready_test")
    rostest.rosrun("external_command", "client_not_ready", ClientNotReadyTest)
