#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Goals and cancels as no well-behaved client sends them: repeated, out of order, damaged, too many; and what becomes of
goals when their processor goes."""
import os
import struct
import sys
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

import support
from component import Component
from external_command import msg
from external_command.srv import Action, FreeSpace, LaneFollow, PathFollow, ZoneCover
from goals import ACTIONS, ENDS, BareClient, large_zone, name_of
from localization import Localization
from processes import MOST_MEMORY, Process, most_resident

sys.path.append(os.path.join(rospkg.RosPack().get_path("external_command"), "scripts", "lib"))
import fuzz_bytes  # noqa: E402  what scripts/fuzz sends

NAMESPACE = "/hostile_goals_test"
BASE = NAMESPACE + "/external_command/"
PROCESSORS = ["external_command/%sCommandProcessor" % name for name in (
    "Action", "FreeSpace", "LaneFollow", "PathFollow", "PreciseParking", "ValetParking", "ZoneCover")]
SLOW = {"zone_cover_command_processor": {"coverage": {"time_budget": 60.0}}}
LATEST_STOP = 2.0  # on a machine that others use too [s]
MOST_LISTED = 160  # goals in one status message


def component(others=None, processors=None):
    return Component(NAMESPACE, dict(SLOW, **(others or {}), external_command={"processors": processors or PROCESSORS}))


def dry_path():
    return fuzz_bytes.example("path_follow")


def planned_for_long():
    return large_zone(dry_run=True)


class HostileGoalsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        Localization(100.0, 195.0).start()

    def setUp(self):
        self.clients = []

    def tearDown(self):
        for client in self.clients:
            client.close()

    def client(self, name):
        self.clients.append(BareClient(name, BASE))
        return self.clients[-1]

    def assert_ended(self, result, state, error_code=None):
        seen = "%s, %s" % (name_of(result.status.status), support.describe(result.result.status))
        self.assertEqual(result.status.status, state, seen)
        if error_code is not None:
            self.assertEqual(result.result.status.error_code, error_code, seen)

    def planner(self):
        """A client of zone_cover, the component knowing the vehicle's pose."""
        drive = support.service(BASE + "free_space", FreeSpace)
        support.wait_until(lambda: drive(fuzz_bytes.example("free_space")).status.error_code !=
                           msg.CommandStatus.NOT_READY, "the vehicle's pose is known")
        return self.client("zone_cover")

    @staticmethod
    def plan_for_long(client, goal_id, stamp=None):
        """A goal that is being planned, or waits for that."""
        client.send(goal_id, planned_for_long(), stamp)
        client.wait_until_known(goal_id, GoalStatus.ACTIVE)

    def assert_works(self, client, goal_id):
        client.send(goal_id, dry_path())
        self.assert_ended(client.end(goal_id), GoalStatus.SUCCEEDED)

    def assert_stops(self, started, within=support.DEADLINE):
        begin = time.monotonic()
        stop = started.service("external_command/action", Action)(msg.ActionCommand(command=msg.ActionCommand.STOP))
        self.assertLess(time.monotonic() - begin, within)
        self.assertEqual(stop.status.status, msg.CommandStatus.RUNNING, support.describe(stop.status))
        self.assertTrue(started.is_running)

    def test_a_goal_that_comes_twice_is_one_command(self):
        with component():
            client = self.client("path_follow")
            log = support.Collector(BASE + "log", msg.CommandLogEntry)
            for _ in range(3):
                client.send("again", dry_path())
            self.assert_works(client, "after it")
            log.wait_for(lambda m: m.reply.command_id == client.end("after it").result.status.command_id, "a log entry")
            self.assertEqual(len(log.messages), 2)
            self.assert_ended(client.end("again"), GoalStatus.SUCCEEDED)
            self.assertEqual(len(client.results_of("again")), 1)
            log.close()

    def test_a_goal_without_an_id_is_given_one(self):
        with component():
            client = self.client("path_follow")
            client.send("", dry_path())
            result = client.results.wait_for(lambda m: True, "a result")
            self.assert_ended(result, GoalStatus.SUCCEEDED)
            self.assertNotEqual(result.status.goal_id.id, "")

    def test_a_cancel_that_comes_before_its_goal_counts(self):
        with component():
            client = self.client("path_follow")
            log = support.Collector(BASE + "log", msg.CommandLogEntry)
            client.cancel("late")
            client.wait_until_known("late", GoalStatus.RECALLING)
            client.send("late", dry_path())
            self.assert_ended(client.end("late"), GoalStatus.RECALLED)
            self.assert_works(client, "another")
            log.wait_for(lambda m: True, "the log entry of the other")
            self.assertEqual(len(log.messages), 1)
            log.close()

    def test_a_cancel_of_all_ends_what_is_planned_and_what_waits(self):
        with component() as started:
            client = self.planner()
            names = ["goal %d" % i for i in range(4)]
            for name in names:
                self.plan_for_long(client, name)
            client.cancel()
            for name in names:
                self.assert_ended(client.end(name), GoalStatus.PREEMPTED, msg.CommandStatus.CANCELLED)
            self.assert_stops(started)

    def test_a_cancel_by_time_ends_what_is_not_newer(self):
        with component():
            client = self.planner()
            now = rospy.Time.now()
            older, newer = now - rospy.Duration(20.0), now - rospy.Duration(10.0)
            for name, stamp in (("older", older), ("newer", newer)):
                self.plan_for_long(client, name, stamp)
            client.cancel(stamp=older)
            self.assert_ended(client.end("older"), GoalStatus.PREEMPTED, msg.CommandStatus.CANCELLED)
            client.send("late", planned_for_long(), older)
            self.assert_ended(client.end("late"), GoalStatus.RECALLED)
            self.assertEqual(client.results_of("newer"), [])
            client.cancel("newer")
            self.assert_ended(client.end("newer"), GoalStatus.PREEMPTED, msg.CommandStatus.CANCELLED)

    def test_a_cancel_of_the_future_does_not_end_goals_that_are_still_to_come(self):
        with component():
            client = self.planner()
            self.plan_for_long(client, "there")
            client.cancel(stamp=rospy.Time(4000000000))
            self.assert_ended(client.end("there"), GoalStatus.PREEMPTED)
            self.plan_for_long(client, "to come", rospy.Time.now())
            client.cancel("to come")
            self.assert_ended(client.end("to come"), GoalStatus.PREEMPTED)

    def test_a_cancel_by_a_clock_that_is_a_little_ahead_ends_goals_until_then(self):
        with component():
            client = self.planner()
            until = rospy.Time.now() + rospy.Duration(0.4)
            client.cancel(stamp=until)
            client.send("before", planned_for_long(), until - rospy.Duration(0.1))
            self.assert_ended(client.end("before"), GoalStatus.RECALLED)
            self.plan_for_long(client, "after", until + rospy.Duration(0.1))

    def test_cancels_of_unknown_goals_and_goals_that_ended_are_forgotten(self):
        with component():
            client = self.client("path_follow")
            for i in range(1000):
                client.cancel("unknown %d" % i)
            self.assert_works(client, "one that is known")
            support.wait_until(lambda: not client.states.messages[-1].status_list, "all is forgotten")
            self.assertLess(max(len(message.status_list) for message in client.states.messages), MOST_LISTED)

    def test_goals_that_state_more_than_they_hold_are_rejected_and_take_no_memory(self):
        with component({"zone_cover_command_processor": {"actions": True}}) as started:
            clients = {name: self.client(name) for name in ACTIONS}
            self.assert_works(clients["path_follow"], "first")
            before = most_resident(started.pid)
            for name, client in clients.items():
                goal = client.goal("lies", fuzz_bytes.example(name))
                whole = fuzz_bytes.serialized(goal)
                begin = whole.index(b"lies") + 4
                raw = fuzz_bytes.raw_class(type(goal))
                publisher = rospy.Publisher(BASE + name + "/goal", raw, queue_size=1000)
                support.wait_until(lambda: publisher.get_num_connections() > 0, "somebody listens to goals")
                counts = [at for at in range(begin, len(whole) - 4) if whole[at + 1:at + 4] == b"\0\0\0"]
                for number, at in enumerate(counts[:10]):
                    named = whole[:begin - 4] + b"%04d" % number + whole[begin:]
                    publisher.publish(raw(data=named[:at] + struct.pack("<I", 100000000) + named[at + 4:]))
                results = [client.end("%04d" % number) for number in range(len(counts[:10]))]
                rejected = [result for result in results if result.status.status == GoalStatus.REJECTED]
                self.assertGreater(len(rejected), 0, name)
                for result in rejected:
                    self.assert_ended(result, GoalStatus.REJECTED, msg.CommandStatus.INVALID_REQUEST)
                for data in (b"", b"\0", whole[:begin - 6], whole[:12] + struct.pack("<I", 2000000000)):
                    publisher.publish(raw(data=data))
                support.wait_until(lambda: "a message on %s%s/goal from" % (BASE, name) in started.output or
                                   "a message on " + BASE in started.output, "the loss is told of")
                publisher.unregister()
            self.assert_works(clients["path_follow"], "last")
            self.assertLess(most_resident(started.pid) - before, MOST_MEMORY)
            self.assert_stops(started)

    def test_goals_that_are_too_large_are_rejected_and_say_why(self):
        with component() as started:
            client = self.client("path_follow")
            command = dry_path()
            command.way_point = command.way_point * 21000
            client.send("large", command)
            self.assert_ended(client.end("large"), GoalStatus.REJECTED, msg.CommandStatus.INVALID_REQUEST)
            self.assertIn("goal.command.way_point", client.end("large").result.status.message)
            command = dry_path()
            command.header.frame_id = "x" * 2000
            client.send("wordy", command)
            self.assert_ended(client.end("wordy"), GoalStatus.REJECTED, msg.CommandStatus.INVALID_REQUEST)
            self.assertIn("~requests/max_text", client.end("wordy").result.status.message)
            client.send("y" * 2000, dry_path())
            self.assert_works(client, "last")
            self.assertEqual(client.results_of("y" * 2000), [])
            self.assertIn("goal_id.id has 2000 bytes", started.output)

    def test_goals_of_callers_that_may_not_call_are_rejected(self):
        others = {"path_follow_command_processor": {"allowed_callers": ["/dispatch"]},
                  "lane_follow_command_processor": {"enabled": False},
                  "free_space_command_processor": {"allowed_callers": [rospy.get_name()]}}
        with component(others):
            for name, word in (("path_follow", "~allowed_callers"), ("lane_follow", "~enabled")):
                client = self.client(name)
                client.send("no", fuzz_bytes.example(name))
                self.assert_ended(client.end("no"), GoalStatus.REJECTED, msg.CommandStatus.INVALID_REQUEST)
                self.assertIn(word, client.end("no").result.status.message)
            client = self.client("free_space")
            client.send("yes", fuzz_bytes.example("free_space"))
            self.assertIn(client.end("yes").status.status, (GoalStatus.ABORTED, GoalStatus.SUCCEEDED))

    def test_actions_that_are_switched_off_are_not_there_and_their_services_are(self):
        with component({"lane_follow_command_processor": {"actions": False}}) as started:
            started.service("external_command/lane_follow", LaneFollow)
            self.client("path_follow")
            topics = [name for name, _ in rospy.get_published_topics(BASE)]
            self.assertIn(BASE + "path_follow/status", topics)
            self.assertNotIn(BASE + "lane_follow/status", topics)

    def test_a_flood_of_goals_and_cancels_does_not_hold_up_a_stop(self):
        with component() as started:
            client = self.client("path_follow")
            self.assert_works(client, "first")
            before = most_resident(started.pid)
            command = dry_path()
            command.target_speed = -1.0
            end = time.monotonic() + 5.0
            sent = 0
            while time.monotonic() < end:
                for _ in range(100):
                    sent += 1
                    client.send("flood %d" % sent, command)
                    client.cancel("flood %d" % (sent - 50))
                self.assert_stops(started, LATEST_STOP)
            support.wait_until(lambda: client.states.messages and not client.states.messages[-1].status_list,
                               "all is over")
            self.assertLess(max(len(message.status_list) for message in client.states.messages), MOST_LISTED)
            self.assert_works(client, "last")
            self.assertLess(most_resident(started.pid) - before, MOST_MEMORY)

    def test_more_goals_than_can_be_planned_are_told_so(self):
        with component() as started:
            client = self.planner()
            names = ["goal %d" % i for i in range(40)]
            self.plan_for_long(client, "first")
            for name in names:
                client.send(name, planned_for_long())
                time.sleep(0.02)
            support.wait_until(lambda: client.results.messages, "some are refused")
            self.assert_stops(started)
            client.cancel()
            ends = [client.end(name) for name in names]
            self.assertEqual({end.status.status for end in ends} - set(ENDS), set())
            busy = [end for end in ends if end.result.status.error_code == msg.CommandStatus.NOT_READY]
            self.assertTrue(busy)
            for end in busy:
                self.assertIn("busy", end.result.status.message)

    def test_goals_of_a_processor_that_is_unloaded_end_and_the_next_one_serves(self):
        others = dict(zone_cover=SLOW["zone_cover_command_processor"])
        with component(others, processors=PROCESSORS[:-1]) as started:
            for run in ("first", "second"):
                nodelet = roslib.packages.find_node("nodelet", "nodelet")[0]
                with Process(nodelet, "load", "external_command/ZoneCoverCommandProcessor", "external_command",
                             "__ns:=" + NAMESPACE, "__name:=zone_cover"):
                    started.service("external_command/zone_cover", ZoneCover)
                    client = self.planner()
                    names = ["%s %d" % (run, i) for i in range(3)]
                    for name in names:
                        self.plan_for_long(client, name)
                for name in names:
                    self.assertIn(client.end(name).status.status, (GoalStatus.PREEMPTED, GoalStatus.ABORTED))
                    self.assertIn("unloaded", client.end(name).status.text)
                self.assert_stops(started)

    def test_a_goal_of_a_driven_command_ends_when_its_processor_is_unloaded_and_the_command_goes_on(self):
        with component(processors=[PROCESSORS[0]]) as started:
            nodelet = roslib.packages.find_node("nodelet", "nodelet")[0]
            with Process(nodelet, "load", "external_command/PathFollowCommandProcessor", "external_command",
                         "__ns:=" + NAMESPACE, "__name:=path_follow"):
                started.service("external_command/path_follow", PathFollow)
                client = self.client("path_follow")
                command = dry_path()
                command.dry_run = False
                command.command_id = 5
                goal_id = self.drive(client, command)
            result = client.end(goal_id)
            self.assert_ended(result, GoalStatus.ABORTED)
            self.assertIn("goes on", result.status.text)
            known = support.command_status(5, BASE + "command_status")
            self.assertEqual(known.status, msg.CommandStatus.RUNNING, support.describe(known))

    @staticmethod
    def drive(client, command):
        """The id of a goal that is driven: the first that is sent once the vehicle's pose is known."""
        for number in range(1000):
            goal_id = "driven %d" % number
            client.send(goal_id, command)
            client.wait_until_known(goal_id, GoalStatus.ACTIVE, *ENDS)
            time.sleep(0.1)
            if not client.results_of(goal_id):
                return goal_id
        raise AssertionError("no goal was driven")


if __name__ == "__main__":
    rospy.init_node("hostile_goals_test")
    rostest.rosrun("external_command", "hostile_goals", HostileGoalsTest)
