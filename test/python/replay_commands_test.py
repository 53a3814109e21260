#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What replay_commands makes of a bag of somebody else's."""
import importlib.machinery
import importlib.util
import io
import os
import tempfile
import unittest

import rosbag
import rospy

from external_command import any_message
from external_command.msg import CommandLogEntry, SpeedCommand

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "replay_commands")


def load_script():
    loader = importlib.machinery.SourceFileLoader("replay_commands", SCRIPT)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("replay_commands", loader))
    loader.exec_module(module)
    return module


replay_commands = load_script()


def some_entry():
    entry = CommandLogEntry(service="/apollo/external_command/speed", request=any_message.pack(SpeedCommand(kind=3)))
    entry.header.stamp = rospy.Time(10)
    return entry


class ReplayCommandsTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "some.bag")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, data, md5sum=CommandLogEntry._md5sum, definition=CommandLogEntry._full_text):
        """A bag with one message that says to be an entry of a command log."""
        header = {"topic": "/log", "type": CommandLogEntry._type, "md5sum": md5sum, "message_definition": definition}
        with rosbag.Bag(self.path, "w") as bag:
            bag.write("/log", (CommandLogEntry._type, data, md5sum, CommandLogEntry), rospy.Time(10), raw=True,
                      connection_header=header)

    @staticmethod
    def bytes_of(message):
        buffer = io.BytesIO()
        message.serialize(buffer)
        return buffer.getvalue()

    def refusal(self):
        with self.assertRaises(replay_commands.ReplayError) as refused:
            replay_commands.read_log(self.path, None)
        return str(refused.exception)

    def test_reads_a_log(self):
        self.write(self.bytes_of(some_entry()))
        (entry,) = replay_commands.read_log(self.path, None)
        self.assertEqual(entry, some_entry())
        self.assertEqual(replay_commands.unpack_command(entry), SpeedCommand(kind=3))

    def test_reads_a_log_by_its_own_class_whatever_the_bag_says_that_it_holds(self):
        for definition in ("this is no definition", "int32 other_field\n", "string X='''\nimport os\n"):
            self.write(self.bytes_of(some_entry()), definition=definition)
            self.assertEqual(replay_commands.read_log(self.path, None), [some_entry()], definition)

    def test_refuses_a_log_of_another_version(self):
        self.write(self.bytes_of(some_entry()), md5sum="0" * 32)
        self.assertIn("with md5 " + "0" * 32, self.refusal())

    def test_refuses_a_broken_entry(self):
        self.write(self.bytes_of(some_entry())[:-3])
        self.assertIn("broken", self.refusal())

    def test_refuses_a_file_that_is_no_bag(self):
        for content in (b"", b"#ROSBAG V2.0\n" + b"\xff" * 100, b"\0" * 1000):
            with open(self.path, "wb") as file:
                file.write(content)
            self.assertIn("cannot be read", self.refusal())

    def test_refuses_a_command_whose_type_is_no_type(self):
        for name in ("", "../x", "os", "a/b/c", "a.b/C"):
            entry = some_entry()
            entry.request.type = name
            with self.assertRaises(replay_commands.ReplayError):
                replay_commands.unpack_command(entry)


if __name__ == "__main__":
    unittest.main()
