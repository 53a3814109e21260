#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The ROS master dies and is started anew: the gateway makes itself known to it, and everything works as before."""
import os
import signal
import socket
import time
import unittest

import rosgraph
import rospkg
import rospy
import rostest

import support
from external_command.msg import CommandLogEntry, CommandStatus, LaneFollowCommand, PlanningCommand, Pose
from external_command.srv import LaneFollow
from processes import Launch, Master, Node

NODE = "/apollo/external_command"
SERVICES = ["lane_follow", "valet_parking", "action", "free_space", "path_follow", "speed", "chassis", "precise_parking",
            "zone_cover", "command_status", "current_command", "cancel_command", "map_objects"]
NOTICED = 5.0  # at most from the new master to the old state [s]


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def registrations():
    """(topics published, topics subscribed, services) of the gateway at the master."""
    return [sorted(name for name, nodes in table if NODE in nodes)
            for table in rosgraph.Master("/test").getSystemState()]


def parameters():
    """Of what is loaded."""
    of_all = rosgraph.Master("/test").getParam("/apollo")
    for adapter in ("old_routing_adapter", "move_base_adapter"):
        of_all.pop(adapter, None)
    return of_all


class NewMasterTest(unittest.TestCase):
    def setUp(self):
        self.uri = "http://localhost:%d" % free_port()
        self.map = os.path.join(rospkg.RosPack().get_path("external_command"), "maps/demo_town/base_map.bin")

    def test_everything_works_at_the_new_master(self):
        with Master(self.uri) as first, Launch("external_command_process.launch", map=self.map) as launch:
            support.wait_until(lambda: "is ready" in launch.output, "the gateway is ready")
            pid = support.pid_of(NODE)
            had, had_parameters = registrations(), parameters()
            self.assertLessEqual({NODE + "/" + name for name in SERVICES}, set(had[2]))
            self.assertLessEqual({"/tf", "/tf_static", "/apollo/planning/command_status"}, set(had[1]))
            first.end()
            begin = time.monotonic()
            with Master(self.uri):
                support.wait_until(lambda: registrations() == had, "it is known as before", NOTICED)
                print("known to the new master %.1f s after that was started" % (time.monotonic() - begin))
                self.assertEqual(support.pid_of(NODE), pid)
                for key, had_value in had_parameters.items():
                    self.assertEqual(parameters().get(key), had_value)
                self.assertIn("is a new one and does not know this node", launch.output)
                self.assertIn("put back at the ROS master: %d services" % len(had[2]), launch.output)
                self.assert_drives()
                self.assert_respawns_complete(pid, had)

    def assert_drives(self):
        """With nodes that were started after the new master: vehicle, planner, and this test."""
        rospy.init_node("new_master_test", disable_signals=True)
        log = support.Collector("/apollo/external_command/log", CommandLogEntry)
        status = support.Collector("/apollo/external_command/status", CommandStatus)
        with Node("simulated_vehicle", "__ns:=/apollo", "_x:=90.0", "_y:=195.0",
                  "_real_time_factor:=10.0"):
            call = support.service("/apollo/external_command/lane_follow", LaneFollow)

            def drives():
                return call(LaneFollowCommand(end_pose=Pose(x=130.0, y=195.0))).status

            support.wait_until(lambda: drives().status == CommandStatus.RUNNING, "the pose is known, and a command runs")
            sent = support.Collector("/apollo/planning/command", PlanningCommand).wait_for(lambda _: True, "the command")
            log.wait_for(lambda entry: entry.reply.command_id == sent.command_id, "the log of the command")
            status.wait_for(lambda s: s.command_id == sent.command_id and s.status == CommandStatus.FINISHED,
                            "the vehicle has arrived")
            answer = support.command_status(sent.command_id, "/apollo/external_command/command_status")
            self.assertEqual(answer.status, CommandStatus.FINISHED, support.describe(answer))

    def assert_respawns_complete(self, pid, had):
        """roslaunch sets parameters once, at the first master."""
        os.kill(pid, signal.SIGKILL)
        support.wait_until(lambda: support.pid_of(NODE) not in (None, pid) and registrations() == had,
                           "it is back with all that it had")


if __name__ == "__main__":
    rostest.rosrun("external_command", "new_master", NewMasterTest)
