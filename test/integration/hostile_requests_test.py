#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Requests and messages that state more than they hold, or are too large; and limits against slips of callers."""
import os
import socket
import struct
import sys
import threading
import time
import urllib.request

import genpy
import rosgraph
import rospkg
import rospy
import rosservice
import rostest
from geometry_msgs.msg import Point

import support
from component import Component
from external_command import msg
from external_command.client import SERVICES
from external_command.srv import (Action, CancelCommand, FindMapObjects, FreeSpace, GetCommandStatus, GetCurrentCommand,
                                  LaneFollow, PathFollow, Speed, ZoneCover)
from processes import MOST_MEMORY, most_resident

sys.path.append(os.path.join(rospkg.RosPack().get_path("external_command"), "scripts", "lib"))
import fuzz_bytes  # noqa: E402  what scripts/fuzz sends

NAMESPACE = "/hostile_requests_test"
PROCESSORS = ["external_command/%sCommandProcessor" % name for name in (
    "Action", "Chassis", "FreeSpace", "LaneFollow", "PathFollow", "PreciseParking", "Speed", "ValetParking",
    "ZoneCover")]


def component(others=None, **parameters):
    return Component(NAMESPACE, dict(others or {}, external_command=dict(parameters, processors=PROCESSORS)))


def counts_in(service):
    """Requests of a service, of which each states 100,000,000 elements, or letters, in another place."""
    whole = fuzz_bytes.serialized(SERVICES[service][0]._request_class(fuzz_bytes.example(service)))
    for at in range(0, len(whole) - 4):
        if whole[at + 1:at + 4] == b"\0\0\0":  # it may be a small count
            yield whole[:at] + struct.pack("<I", 100000000) + whole[at + 4:]


class HostileRequestsTest(support.TestCase):
    def assert_refused(self, status, *words):
        self.assertEqual(status.error_code, msg.CommandStatus.INVALID_REQUEST, support.describe(status))
        for word in words:
            self.assertIn(word, status.message)

    def assert_stops(self, started):
        """A stop acts, and the process is the one that was started."""
        stop = started.service("external_command/action", Action)(msg.ActionCommand(command=msg.ActionCommand.STOP))
        self.assertEqual(stop.status.status, msg.CommandStatus.RUNNING, support.describe(stop.status))
        self.assertTrue(started.is_running)

    def test_answers_requests_that_state_more_than_they_hold_and_takes_no_memory_for_them(self):
        with component() as started:
            self.assert_stops(started)
            before = most_resident(started.pid)
            for service, (service_class, _) in sorted(SERVICES.items()):
                name = NAMESPACE + "/external_command/" + service
                support.service(name, service_class)
                caller = fuzz_bytes.RawCaller(name, service_class)
                refused = 0
                for request in counts_in(service):
                    status = caller.call(request).status
                    refused += "is said to have" in status.message
                caller.close()
                self.assertGreater(refused, 0, service)
            self.assertLess(most_resident(started.pid) - before, MOST_MEMORY)
            self.assert_stops(started)

    def test_answers_damaged_questions_about_commands_and_map(self):
        questions = {"command_status": GetCommandStatus, "current_command": GetCurrentCommand,
                     "cancel_command": CancelCommand, "map_objects": FindMapObjects}
        with component() as started:
            self.assert_stops(started)
            for service, service_class in questions.items():
                name = NAMESPACE + "/external_command/" + service
                support.service(name, service_class)
                caller = fuzz_bytes.RawCaller(name, service_class)
                for request in (b"\xff" * 3, b"\xff" * 500):
                    answer = caller.call(request)
                    whole = getattr(answer, "status", None) or getattr(answer, "motion", answer)
                    self.assertEqual(whole.error_code, msg.CommandStatus.INVALID_REQUEST, answer)
                caller.close()
            self.assert_stops(started)

    def test_drops_messages_that_state_more_than_they_hold(self):
        topics = {"planning/command_status": msg.CommandStatus, "planning/state": msg.PlanningState,
                  "canbus/chassis": msg.Chassis}
        with component() as started:
            self.assert_stops(started)
            before = most_resident(started.pid)
            for name, message_class in topics.items():
                raw = fuzz_bytes.raw_class(message_class)
                publisher = rospy.Publisher(NAMESPACE + "/" + name, raw, queue_size=10)
                support.wait_until(lambda: publisher.get_num_connections() > 0, "somebody listens to " + name)
                for _ in range(10):
                    publisher.publish(raw(data=b"\0" * 12 + struct.pack("<I", 2000000000)))
                support.wait_until(lambda: "a message on %s/" % NAMESPACE in started.output, "the loss is told of")
                publisher.unregister()
            self.assertLess(most_resident(started.pid) - before, MOST_MEMORY)
            self.assert_stops(started)

    def test_drops_connections_whose_header_states_more_than_it_holds(self):
        """roscpp's own function would read beyond it, and tell of it in these words."""
        with component() as started:
            self.assert_stops(started)
            uri = rosservice.get_service_uri(NAMESPACE + "/external_command/action")
            host, _, port = uri[len("rosrpc://"):].rpartition(":")
            for stated in [5, 1000, 999999, 2 ** 31, 2 ** 32 - 1] * 20:
                lie = struct.pack("<I", stated) + b"a=b"
                with socket.create_connection((host, int(port)), support.DEADLINE) as connection:
                    connection.sendall(struct.pack("<I", len(lie)) + lie)
                    connection.settimeout(support.DEADLINE)
                    self.assertEqual(connection.recv(1), b"", "the connection is closed")
            self.assert_stops(started)
            self.assertNotIn("TCPROS header", started.output)

    def test_answers_each_call_while_others_connect_and_leave(self):
        """roscpp would close one connection of a few thousand for what happened to the one before it."""
        calls, lost = [], []

        def call(service, end):
            request = fuzz_bytes.serialized(SERVICES[service][0]._request_class())
            caller = fuzz_bytes.RawCaller(NAMESPACE + "/external_command/" + service, SERVICES[service][0], False)
            while time.monotonic() < end:
                try:
                    calls.append(caller.call(request).status.status)
                except OSError as error:
                    lost.append("%s: %s" % (service, error))
                    caller.close()

        with component() as started:
            self.assert_stops(started)
            for service, (service_class, _) in SERVICES.items():
                support.service(NAMESPACE + "/external_command/" + service, service_class)
            threads = [threading.Thread(target=call, args=(service, time.monotonic() + 10.0)) for service in SERVICES]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(lost, [], "of %d calls" % (len(calls) + len(lost)))
            self.assertGreater(len(calls), 100)
            self.assert_stops(started)

    def test_refuses_calls_of_xml_rpc_that_nest_too_deep(self):
        """Every node has such a server; the parameter server's answers nest, too."""
        with component() as started:
            self.assert_stops(started)
            node = rosgraph.Master(rospy.get_name()).lookupNode(NAMESPACE + "/external_command")
            for depth, is_refused in ((50, False), (101, True), (20000, True), (200000, True)):
                request = urllib.request.Request(node, fuzz_bytes.nested_call(depth), {"Content-Type": "text/xml"})
                with urllib.request.urlopen(request, timeout=support.DEADLINE) as answer:
                    self.assertEqual("the call nests" in answer.read().decode(), is_refused, depth)
            self.assert_stops(started)

    def test_drops_messages_of_no_bytes_for_all_its_subscribers(self):
        """Several processors listen to the planner's reports; roscpp goes through their callbacks one by one."""
        with component() as started:
            self.assert_stops(started)
            raw = fuzz_bytes.raw_class(msg.CommandStatus)
            publisher = rospy.Publisher(NAMESPACE + "/planning/command_status", raw, queue_size=100)
            support.wait_until(lambda: publisher.get_num_connections() > 0, "somebody listens to reports")
            for _ in range(100):
                publisher.publish(raw(data=b""))
            support.wait_until(lambda: "planning/command_status" in started.output, "the loss is told of")
            publisher.publish(raw(data=fuzz_bytes.serialized(msg.CommandStatus(command_id=5, status=99))))
            support.wait_until(lambda: "a report about command 5 is ignored" in started.output, "the next one is heard")
            publisher.unregister()
            self.assert_stops(started)

    def test_refuses_long_texts_shortly_but_stops_whatever_texts_a_stop_has(self):
        with component() as started:
            drive = started.service("external_command/free_space", FreeSpace)
            command = fuzz_bytes.example("free_space")
            command.header.frame_id = "x" * 1000000
            before = most_resident(started.pid)
            for _ in range(50):
                status = drive(command).status
                self.assert_refused(status, "command.header.frame_id", "1000000", "~requests/max_text")
                self.assertLess(len(status.message), 1000)
            self.assertLess(most_resident(started.pid) - before, MOST_MEMORY)
            stop = msg.ActionCommand(command=msg.ActionCommand.STOP)
            stop.header.frame_id = command.header.frame_id
            status = started.service("external_command/action", Action)(stop).status
            self.assertEqual(status.status, msg.CommandStatus.RUNNING, support.describe(status))

    def test_cuts_and_escapes_what_it_quotes(self):
        with component() as started:
            command = fuzz_bytes.example("free_space")
            command.header.frame_id = "a\n\x1b[2J" + 500 * "y"
            status = started.service("external_command/free_space", FreeSpace)(command).status
            self.assert_refused(status, "a\\x0a\\x1b[2J")
            self.assertLess(len(status.message), 1000)

    def test_refuses_points_in_sum(self):
        with component() as started:
            command = fuzz_bytes.example("zone_cover")
            command.non_drivable_roi = [msg.RoiPolygon(points=[Point(x, y, 0.0) for x in range(100)
                                                               for y in range(100)])] * 11
            status = started.service("external_command/zone_cover", ZoneCover)(command).status
            self.assert_refused(status, "command.non_drivable_roi[0].points", "~requests/max_points")

    def test_refuses_what_is_too_large_or_cut_under_the_id_that_it_came_with(self):
        with component() as started:
            command = fuzz_bytes.example("path_follow")
            command.command_id = 42
            name = NAMESPACE + "/external_command/path_follow"
            started.service("external_command/path_follow", PathFollow)
            caller = fuzz_bytes.RawCaller(name, PathFollow)
            whole = fuzz_bytes.serialized(PathFollow._request_class(command))
            self.assertEqual(caller.call(whole[:-1]).status.command_id, 42)
            self.assertGreater(caller.call(whole[:10]).status.command_id, 42, "its id is cut off: a fresh one")
            caller.close()
            command.way_point = [msg.Pose(x=float(i)) for i in range(200000)]
            status = started.service("external_command/path_follow", PathFollow)(command).status
            self.assert_refused(status, "~requests/max_points")
            self.assertEqual(status.command_id, 42)

    def test_refuses_a_zone_that_is_too_large_for_its_swaths_before_anything_is_planned(self):
        with component() as started:
            command = msg.ZoneCoverCommand(dry_run=True, is_start_pose_set=True, swath_width=0.5,
                                           way_point=[msg.Pose(x=9.0, y=9.0, has_heading=True)])
            command.drivable_roi.points = [Point(x, y, 0.0) for x, y in ((0, 0), (19e3, 0), (19e3, 19e3), (0, 19e3))]
            before = most_resident(started.pid)
            status = started.service("external_command/zone_cover", ZoneCover)(command).status
            self.assert_refused(status, "drivable_roi", "from corner to corner", "swath_width of 0.50 m")
            self.assertLess(most_resident(started.pid) - before, MOST_MEMORY)
            self.assert_stops(started)

    def test_refuses_callers_that_are_not_named_and_services_that_are_off_but_stops_for_anyone(self):
        others = {"speed_command_processor": {"allowed_callers": ["/dispatch"]},
                  "path_follow_command_processor": {"allowed_callers": [rospy.get_name()]},
                  "lane_follow_command_processor": {"enabled": False},
                  "action_command_processor": {"enabled": False, "allowed_callers": ["/dispatch"]}}
        with component(others) as started:
            speed = started.service("external_command/speed", Speed)(msg.SpeedCommand(kind=3)).status
            self.assert_refused(speed, rospy.get_name(), "~allowed_callers names /dispatch")
            lane_follow = started.service("external_command/lane_follow", LaneFollow)().status
            self.assert_refused(lane_follow, "~enabled")
            follow = started.service("external_command/path_follow", PathFollow)(
                fuzz_bytes.example("path_follow")).status
            self.assertEqual(follow.status, msg.CommandStatus.FINISHED, support.describe(follow))
            start = started.service("external_command/action", Action)(msg.ActionCommand(command=6)).status
            self.assert_refused(start, "~enabled")
            self.assert_stops(started)

    def test_refuses_what_leads_beyond_the_limits_of_the_vehicle(self):
        limits = {"geofence": [[0.0, 0.0], [200.0, 0.0], [200.0, 300.0], [0.0, 300.0]], "max_goal_distance": 50.0,
                  "max_speed": 4.0}
        with component(limits=limits) as started:
            follow = started.service("external_command/path_follow", PathFollow)

            def along(from_x, to_x, **fields):
                points = [Point(from_x, 150.0, 0.0), Point(to_x, 150.0, 0.0)]
                return follow(msg.PathFollowCommand(way_point=points, dry_run=True, **fields))

            inside = along(150.0, 190.0)
            self.assertEqual(inside.status.status, msg.CommandStatus.FINISHED, support.describe(inside.status))
            self.assertLessEqual(max(point.speed for point in inside.path.points), 4.0)
            self.assert_refused(along(160.0, 205.0).status, "leaves the geofence", "~limits/geofence")
            self.assert_refused(along(100.0, 190.0).status, "90.00 m", "~limits/max_goal_distance")
            self.assert_refused(along(150.0, 190.0, target_speed=5.0).status, "target_speed is 5", "~limits/max_speed")
            speed = started.service("external_command/speed", Speed)(msg.SpeedCommand(kind=1, target_speed=5.0))
            self.assert_refused(speed.status, "~limits/max_speed")

    def test_refuses_a_target_speed_that_no_vehicle_drives_at(self):
        motions = ("lane_follow", "valet_parking", "free_space", "path_follow", "precise_parking", "zone_cover")
        with component() as started:
            def status_of(name, target_speed):
                command = fuzz_bytes.example(name)
                command.dry_run, command.target_speed = True, target_speed
                return started.service("external_command/" + name, SERVICES[name][0])(command).status

            for name in motions:
                with self.subTest(name):
                    self.assert_refused(status_of(name, 1e-200), "target_speed is 1e-200 m/s", "0.01 at least")
                    self.assertNotIn("target_speed", status_of(name, 0.01).message)

    def test_takes_bytes_that_are_no_text_for_a_text(self):
        """rospy cannot send them, but others can."""
        with component() as started:
            name = NAMESPACE + "/external_command/free_space"
            support.service(name, FreeSpace)
            command = fuzz_bytes.example("free_space")
            command.header.frame_id = "abcdef"
            request = fuzz_bytes.serialized(SERVICES["free_space"][0]._request_class(command))
            caller = fuzz_bytes.RawCaller(name, FreeSpace)
            try:
                status = caller.call(request.replace(b"abcdef", b"\xff\xfe\0abc")).status
            except (genpy.DeserializationError, UnicodeDecodeError) as error:
                self.fail("the answer cannot be read: %s" % error)
            finally:
                caller.close()
            self.assert_refused(status, "\\xff\\xfe\\x00abc")


if __name__ == "__main__":
    rospy.init_node("hostile_requests_test")
    rostest.rosrun("external_command", "hostile_requests", HostileRequestsTest)
