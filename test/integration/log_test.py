#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The command log: recorded by rosbag, read back, and sent again."""
import itertools
import os
import subprocess
import tempfile
import threading
import unittest
import xmlrpc.client

import rosbag
import rosgraph
import rospy
import rostest

import support
from external_command import any_message
from external_command.msg import ActionCommand, CommandLogEntry, CommandStatus, LaneFollowCommand, Pose
from external_command.srv import Action, LaneFollow

NODE = "/apollo/external_command"
LOG = "/apollo/external_command/log"
STATUS = "/apollo/external_command/status"
LANE_FOLLOW = "/apollo/external_command/lane_follow"
ACTION = "/apollo/external_command/action"
EACH, BAD_OF = 16, 8  # requests of one caller; what three of them say at once fits the queues of 100 that a topic has
WEST, EAST = Pose(x=100.0, y=195.0), Pose(x=300.0, y=195.0)


def connected_topics(node, to):
    """Topics of which `node` sends messages to the node `to`."""
    uri = rosgraph.Master(rospy.get_name()).lookupNode(node)
    connections = xmlrpc.client.ServerProxy(uri).getBusInfo(rospy.get_name())[2]
    return {connection[4] for connection in connections if connection[2] == "o" and connection[1].startswith(to)}


class Recorder:
    """`rosbag record` of `count` messages of a topic; connected when the constructor returns."""

    names = itertools.count(1)  # else one that is left from a test that failed would be taken for the next

    def __init__(self, path, topic, count):
        name = "/recorder_%d" % next(self.names)
        self._process = subprocess.Popen(
            ["rosrun", "rosbag", "record", "--output-name=" + path, "--limit=%d" % count, topic, "__name:=" + name[1:]])
        support.wait_until(lambda: topic in connected_topics(NODE, name), "rosbag records " + topic)

    def wait(self):
        """Until all are recorded."""
        try:
            self._process.wait(support.DEADLINE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise


def dry_run(**fields):
    command = LaneFollowCommand(is_start_pose_set=True, way_point=[WEST], end_pose=EAST, dry_run=True, **fields)
    return command, support.service(LANE_FOLLOW, LaneFollow)(command).status


def read(path):
    with rosbag.Bag(path) as bag:
        return [message for _, message, _ in bag.read_messages()]


def replay(*arguments):
    return subprocess.run(["rosrun", "external_command", "replay_commands"] + list(arguments), check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=support.DEADLINE,
                          universal_newlines=True)


class LogTest(unittest.TestCase):
    def setUp(self):
        support.wait_until(lambda: dry_run()[1].status == CommandStatus.FINISHED, "the component answers")
        self._folder = tempfile.TemporaryDirectory()
        self.bag = os.path.join(self._folder.name, "run.bag")

    def tearDown(self):
        self._folder.cleanup()

    def record(self, count, send):
        """The log while `send()` sends `count` requests."""
        recorder = Recorder(self.bag, LOG, count)
        send()
        recorder.wait()

    def test_a_recorded_bag_holds_every_request_and_answer(self):
        sent = []

        def burst(first):
            for i in range(EACH):
                bad = i % BAD_OF == 0
                sent.append(dry_run(command_id=first + i, target_speed=-1.0 if bad else 5.0 + i))

        def send():
            threads = [threading.Thread(target=burst, args=(1000 * n,)) for n in (1, 2, 3)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()

        statuses = os.path.join(self._folder.name, "statuses.bag")
        status_recorder = Recorder(statuses, STATUS, 3 * (2 * EACH - EACH // BAD_OF))  # being planned and done; or refused
        self.record(3 * EACH, send)
        status_recorder.wait()
        entries = {entry.reply.command_id: entry for entry in read(self.bag)}
        self.assertEqual(sorted(entries), sorted(command.command_id for command, _ in sent))
        for command, status in sent:
            entry = entries[command.command_id]
            logged = any_message.unpack(entry.request, LaneFollowCommand)
            logged.header.seq = command.header.seq
            self.assertEqual(logged, command)
            self.assertEqual((entry.reply.status, entry.reply.error_code, entry.reply.message),
                             (status.status, status.error_code, status.message))
            self.assertEqual((entry.service, entry.caller), (LANE_FOLLOW, rospy.get_name()))
            self.assertGreater(entry.duration, 0.0)
            self.assertGreater(entry.header.stamp.to_sec(), 0.0)
        ends = {status.command_id for status in read(statuses) if status.status != CommandStatus.RUNNING}
        self.assertEqual(ends, set(entries))

    def test_a_recorded_bag_is_sent_again(self):
        def send():
            dry_run(command_id=41, target_speed=7.0)
            dry_run(command_id=42, target_speed=-7.0)
            support.service(ACTION, Action)(ActionCommand(command_id=43, command=ActionCommand.STOP))

        self.record(3, send)
        for extra, keeps_ids in (("--immediate",), False), (("--rate", "10", "--keep-ids"), True):
            log = support.Collector(LOG, CommandLogEntry)
            result = replay(self.bag, *extra)
            self.assertEqual(result.returncode, 0, result.stdout)
            support.wait_until(lambda: len(log.messages) == 3, "three commands are sent again")
            log.close()
            entries = {entry.request.type.split("/")[1]: entry for entry in log.messages[1:]}
            self.assertEqual(set(entries), {"LaneFollowCommand", "ActionCommand"})
            first = any_message.unpack(log.messages[0].request, LaneFollowCommand)
            self.assertEqual(first.target_speed, 7.0)
            self.assertEqual(first.command_id, 41 if keeps_ids else 0)
            self.assertEqual(log.messages[0].reply.status, CommandStatus.FINISHED)
            self.assertEqual(log.messages[1].reply.error_code, CommandStatus.INVALID_REQUEST)
            self.assertLess(abs((rospy.Time.now() - first.header.stamp).to_sec()), support.DEADLINE)
            self.assertIn("recorded: command 42 ERROR", result.stdout)

    def test_a_dry_run_of_the_replay_lists_and_sends_nothing(self):
        self.record(1, lambda: dry_run(command_id=41, target_speed=7.0))
        log = support.Collector(LOG, CommandLogEntry)
        result = replay(self.bag, "--dry-run", "--topic", LOG)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn(LANE_FOLLOW, result.stdout)
        self.assertIn("target_speed: 7.0", result.stdout)
        self.assertEqual(log.messages, [])
        log.close()

    def test_the_replay_says_what_it_cannot_do(self):
        self.record(1, lambda: dry_run(command_id=41))
        for arguments, words in (
                ([self.bag, "--topic", "/nowhere"], ["/nowhere", LOG]),
                ([self.bag + ".missing"], ["cannot be read", ".missing"]),
                ([__file__], ["cannot be read"]),
                ([self.bag, "--timeout", "0.1", LANE_FOLLOW + ":=/nobody/lane_follow"], ["/nobody/lane_follow"])):
            result = replay(*arguments)
            self.assertEqual(result.returncode, 1, result.stdout)
            for word in words:
                self.assertIn(word, result.stdout)


if __name__ == "__main__":
    rospy.init_node("log_test")
    rostest.rosrun("external_command", "log", LogTest)
