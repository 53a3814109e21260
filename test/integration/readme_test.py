#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The README's example calls, typed into a shell as they stand there."""
import os
import re
import shlex
import subprocess
import unittest

import genpy
import rospkg
import rospy
import rosservice
import rostest
import yaml

import support
from external_command.msg import CommandStatus, LaneFollowCommand, Pose
from external_command.srv import LaneFollow

README = os.path.join(rospkg.RosPack().get_path("external_command"), "README.md")
GATEWAY = "/apollo/external_command/"
OF_EVERY_NODE = {"get_loggers", "set_logger_level", "load_nodelet", "unload_nodelet", "list"}
DEADLINE = 100.0  # for a command to end; the machine may have other things to do [s]


def examples():
    with open(README, encoding="utf-8") as file:
        return re.findall(r"^rosservice call /apollo/external_command/.*$", file.read(), re.MULTILINE)


def service_of(call):
    return call.split()[2].rsplit("/", 1)[1]


def typed(call):
    """The answer that a shell prints."""
    printed = subprocess.run(["bash", "-c", call], stdout=subprocess.PIPE, check=True, timeout=DEADLINE).stdout
    return yaml.safe_load(printed)


def sent(call):
    """The same, without the seconds that a shell and rosservice take on a machine that is loaded."""
    name, *arguments = shlex.split(call)[2:]
    service_type = rosservice.get_service_class_by_name(name)
    request = service_type._request_class()  # pylint: disable=protected-access
    genpy.message.fill_message_args(request, [yaml.safe_load(text) for text in arguments])
    return yaml.safe_load(str(support.service(name, service_type)(request)))


class ReadmeTest(unittest.TestCase):
    def setUp(self):
        call = support.service(GATEWAY + "lane_follow", LaneFollow)
        ask = LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True)
        support.wait_until(lambda: call(ask).status.status == CommandStatus.FINISHED, "the vehicle is known")

    def assert_finishes(self, call, answer_of):
        answer = answer_of(call)
        if "status" not in answer:  # no command, a question
            self.assertEqual(answer.get("error_code", CommandStatus.OK), CommandStatus.OK, (call, answer))
            return
        status = answer["status"]
        self.assertIn(status["status"], (CommandStatus.RUNNING, CommandStatus.FINISHED), (call, status))
        support.wait_for_status(status["command_id"], CommandStatus.FINISHED, GATEWAY + "command_status", DEADLINE)

    def test_has_an_example_of_every_service(self):
        served = {name[len(GATEWAY):] for name in rosservice.get_service_list() if name.startswith(GATEWAY)}
        self.assertEqual({service_of(call) for call in examples()}, served - OF_EVERY_NODE)

    def test_every_example_ends_finished_in_the_order_of_the_page_and_after_others(self):
        for call in examples():
            self.assert_finishes(call, typed)
        for call in reversed(examples()):
            if service_of(call) != "zone_cover":  # which takes as long as all others
                self.assert_finishes(call, sent)


if __name__ == "__main__":
    rospy.init_node("readme_test")
    rostest.rosrun("external_command", "readme", ReadmeTest)
