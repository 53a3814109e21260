#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The README's example calls, typed into a shell as they stand there."""
import os
import re
import subprocess
import unittest

import rospkg
import rospy
import rostest
import yaml

import support
from external_command.msg import CommandStatus, LaneFollowCommand, Pose
from external_command.srv import LaneFollow

README = os.path.join(rospkg.RosPack().get_path("external_command"), "README.md")
SERVICES = {"lane_follow", "valet_parking", "free_space", "path_follow", "precise_parking", "zone_cover", "action",
            "speed", "chassis", "command_status", "current_command", "cancel_command", "map_objects"}


def examples():
    with open(README, encoding="utf-8") as file:
        return re.findall(r"^rosservice call /apollo/external_command/.*$", file.read(), re.MULTILINE)


def answer_of(call):
    return yaml.safe_load(subprocess.run(["bash", "-c", call], stdout=subprocess.PIPE, check=True, timeout=60).stdout)


class ReadmeTest(unittest.TestCase):
    def setUp(self):
        call = support.service("/apollo/external_command/lane_follow", LaneFollow)
        ask = LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True)
        support.wait_until(lambda: call(ask).status.status == CommandStatus.FINISHED, "the vehicle is known")

    def test_has_an_example_of_every_service(self):
        self.assertEqual({call.split()[2].rsplit("/", 1)[1] for call in examples()}, SERVICES)

    def test_every_example_works(self):
        for call in examples():
            with self.subTest(call=call):
                answer = answer_of(call)
                if "map_objects" in call:
                    self.assertEqual(len(answer["objects"]), 5, answer)
                    continue
                status = answer["motion"] if "current_command" in call else answer["status"]
                if "command_status" in call or "cancel_command" in call:
                    self.assertEqual(status["status"], CommandStatus.UNKNOWN, status)
                else:
                    self.assertIn(status["status"], (CommandStatus.RUNNING, CommandStatus.FINISHED), status)


if __name__ == "__main__":
    rospy.init_node("readme_test")
    rostest.rosrun("external_command", "readme", ReadmeTest)
