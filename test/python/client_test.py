# SPDX-License-Identifier: Apache-2.0
"""The parts of the Python client that need no gateway: messages of plain values, exceptions, words, JSON."""
import inspect
import json
import math
import unittest

from external_command import client, commands, errors, msg
from external_command.any_message import unpack
from external_command.command_line_output import progress_bar
from external_command.command_line_verbs import outcome
from external_command.plain import plain
from geometry_msgs.msg import Point
from message_fields import fields_of, set_fields_of
from std_msgs.msg import String

START = commands.pose(5.0, 6.0, 7.0, z=8.0, lane_id="m")
AREA = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0)]
ALL = {"id": 9, "frame": "odom"}
MOTION = dict(ALL, speed=4.0, dry_run=True)
LANES = {"start": START, "via": [(3.0, 4.0)]}
# Of each service, commands which together have every field of its message.
COMPLETE = {
    "lane_follow": [commands.lane_follow(1.0, 2.0, 3.0, z=4.0, lane_id="l", avoid_lanes=["a", ("b", 1.0, 2.0)],
                                         avoid_roads=["r"], **LANES, **MOTION)],
    "valet_parking": [commands.valet_parking("p", avoid_lanes=[("b", 1.0, 2.0)], avoid_roads=["r"], **LANES, **MOTION)],
    "precise_parking": [commands.precise_parking(1.0, 2.0, 3.0, inwards=True, mission="dump", **LANES, **MOTION)],
    "free_space": [commands.free_space(1.0, 2.0, 3.0, drivable=AREA, obstacles=[AREA], **MOTION)],
    "path_follow": [commands.path_follow(AREA, headings=[1.0, 2.0, 3.0], left_width=1.0, right_width=2.0, **MOTION),
                    commands.path_follow(AREA, end_heading=1.0, left_boundary=AREA, right_boundary=AREA)],
    "zone_cover": [commands.zone_cover("yard", drivable=AREA, obstacles=[AREA], swath_width=2.0, resume=True,
                                       skip_swaths=[3], **LANES, **MOTION)],
    "action": [commands.action("stop", **ALL)],
    "speed": [commands.speed(3.0, **ALL), commands.speed(factor=0.5)],
    "chassis": [commands.chassis(turn_signal="left", high_beam=True, low_beam=False, horn=True, emergency_light=False,
                                 custom_operation=String("wipe"), **ALL)],
}
WITHOUT_LANES = {"parking_spot_pose.z", "parking_spot_pose.has_z", "parking_spot_pose.lane_id"}


class CommandsTest(unittest.TestCase):
    def test_every_field_of_every_command_can_be_given(self):
        self.assertEqual(set(COMPLETE), set(client.SERVICES))
        for service, made in COMPLETE.items():
            self.assertIsInstance(made[0], client.SERVICES[service][1])
            given = set().union(*(set_fields_of(command) for command in made))
            missing = fields_of(client.SERVICES[service][1]) - given - {"header.seq", "header.stamp"}
            self.assertEqual(missing - WITHOUT_LANES, set(), service)

    def test_what_is_not_given_is_as_in_a_fresh_message(self):
        self.assertEqual(set_fields_of(commands.lane_follow(1.0, 2.0)), {"end_pose.x", "end_pose.y"})
        self.assertEqual(set_fields_of(commands.path_follow([(0.0, 0.0), (1.0, 0.0)])), {"way_point.x"})
        self.assertEqual(set_fields_of(commands.chassis()), set())

    def test_poses_may_be_messages_or_numbers(self):
        made = commands.lane_follow(1.0, 2.0, via=[(1.0, 2.0), (1.0, 2.0, 0.0), msg.Pose(x=3.0)])
        self.assertEqual(made.way_point, [msg.Pose(x=1.0, y=2.0), msg.Pose(x=1.0, y=2.0, has_heading=True), msg.Pose(x=3.0)])
        self.assertEqual(commands.path_follow([Point(1.0, 2.0, 3.0), (4.0, 5.0)]).way_point,
                         [Point(1.0, 2.0, 3.0), Point(4.0, 5.0, 0.0)])

    def test_a_start_is_the_first_way_point(self):
        made = commands.zone_cover("yard", start=(1.0, 2.0), via=[(3.0, 4.0)])
        self.assertTrue(made.is_start_pose_set)
        self.assertEqual([pose.x for pose in made.way_point], [1.0, 3.0])
        self.assertFalse(commands.zone_cover("yard", via=[(3.0, 4.0)]).is_start_pose_set)

    def test_a_custom_operation_is_packed(self):
        self.assertEqual(unpack(commands.chassis(custom_operation=String("wipe")).custom_operation, String), String("wipe"))

    def test_what_makes_no_command_is_named(self):
        for make, told in ((lambda: commands.action("dance"), "action is 'dance'; it must be one of"),
                           (lambda: commands.speed(), "exactly one of target, factor and restore"),
                           (lambda: commands.speed(1.0, factor=0.5), "exactly one"),
                           (lambda: commands.lane_follow(1.0, 2.0, via=[(1.0,)]), "not 1 values"),
                           (lambda: commands.chassis(turn_signal="up"), "turn_signal is 'up'"),
                           (lambda: commands.precise_parking(1, 2, 3, mission="fly"), "mission is 'fly'")):
            with self.assertRaisesRegex(ValueError, told):
                make()


class ClientTest(unittest.TestCase):
    def test_has_a_method_for_each_service_with_its_arguments(self):
        for service in client.SERVICES:
            method = getattr(client.CommandClient, service)
            self.assertEqual(inspect.signature(method), inspect.signature(getattr(commands, service)))
            self.assertIn("Raises RefusedCommand", method.__doc__)

    def test_sends_nothing_but_commands(self):
        with self.assertRaisesRegex(TypeError, "a Pose is no command"):
            client.CommandClient().send(msg.Pose())
        with self.assertRaisesRegex(TypeError, "the service speed takes a SpeedCommand, not a ActionCommand"):
            client.CommandClient().call("speed", msg.ActionCommand())

    def test_knows_the_kinds_of_map_objects(self):
        with self.assertRaisesRegex(ValueError, "kind is 'towns'; it must be one of areas, lanes, roads, spaces"):
            client.CommandClient().map_objects("towns")


def status_of(state, code=0, **fields):
    return msg.CommandStatus(command_id=4, status=state, error_code=code, **fields)


def codes():
    """(number, name) of each error of CommandStatus."""
    known = ("RUNNING", "FINISHED", "ERROR", "UNKNOWN", "OK")
    return [(value, name) for name, value in vars(msg.CommandStatus).items()
            if name.isupper() and isinstance(value, int) and name not in known]


class ErrorsTest(unittest.TestCase):
    def test_every_code_has_an_exception_of_its_name(self):
        self.assertEqual(len(codes()), 15)
        for value, name in codes():
            with self.assertRaises(errors.RefusedCommand) as caught:
                errors.raise_refusal(status_of(msg.CommandStatus.ERROR, value, message="no way"))
            self.assertEqual(type(caught.exception).__name__, "".join(word.capitalize() for word in name.split("_")))
            self.assertIs(getattr(client, type(caught.exception).__name__), type(caught.exception))
            self.assertEqual((caught.exception.code, caught.exception.code_name, caught.exception.command_id),
                             (value, name, 4))
            self.assertEqual(str(caught.exception), "command 4 ERROR (%s): no way" % name)

    def test_a_code_of_a_later_version_is_a_refusal_too(self):
        with self.assertRaises(errors.RefusedCommand) as caught:
            errors.raise_refusal(status_of(msg.CommandStatus.ERROR, 999))
        self.assertEqual(caught.exception.code_name, "999")

    def test_what_is_accepted_is_no_exception(self):
        for state in (msg.CommandStatus.RUNNING, msg.CommandStatus.FINISHED):
            errors.raise_refusal(status_of(state))
        errors.raise_failure(status_of(msg.CommandStatus.FINISHED))

    def test_a_command_that_was_waited_for_fails_by_its_own_exceptions(self):
        status = msg.CommandStatus
        for state, code, expected in ((status.ERROR, status.NO_PATH, errors.CommandFailed),
                                      (status.ERROR, status.CANCELLED, errors.CommandCancelled),
                                      (status.ERROR, status.SUPERSEDED, errors.CommandSuperseded),
                                      (status.UNKNOWN, 0, errors.LostCommand), (status.RUNNING, 0, errors.StillRunning)):
            with self.assertRaises(errors.CommandError) as caught:
                errors.raise_failure(status_of(state, code))
            self.assertIs(type(caught.exception), expected)
        self.assertTrue(issubclass(errors.StillRunning, TimeoutError))

    def test_the_exit_code_tells_the_outcome(self):
        status = msg.CommandStatus
        for state, code, expected in ((status.RUNNING, 0, 0), (status.FINISHED, 0, 0), (status.ERROR, status.NO_PATH, 1),
                                      (status.ERROR, status.CANCELLED, 5), (status.ERROR, status.SUPERSEDED, 5),
                                      (status.UNKNOWN, 0, 6)):
            self.assertEqual(outcome(status_of(state, code)), expected)


class WordsTest(unittest.TestCase):
    def test_a_status_is_described_in_one_line(self):
        status = status_of(msg.CommandStatus.ERROR, msg.CommandStatus.NO_ROUTE, message="no way")
        self.assertEqual(client.describe(status), "command 4 ERROR (NO_ROUTE): no way")
        status = status_of(msg.CommandStatus.RUNNING, has_progress=True, share_done=0.423, distance_left=120.04, time_left=15.2)
        self.assertEqual(client.describe(status), "command 4 RUNNING [42 %, 120.0 m and 15 s left]")

    def test_running_and_finished_are_accepted(self):
        self.assertEqual([client.accepted(msg.CommandStatus(status=n)) for n in (1, 2, 3, 4)], [True, True, False, False])

    def test_a_bar_is_as_long_as_the_share_and_never_too_wide(self):
        status = status_of(msg.CommandStatus.RUNNING, has_progress=True, share_done=0.25, distance_left=30.0, time_left=6.0)
        self.assertEqual(progress_bar(status, 80), "[%s%s] 25 %%, 30.0 m and 6 s left, command 4" % ("#" * 10, "." * 30))
        for share in (-1.0, 0.0, 0.5, 1.0, 2.0):
            status.share_done = share
            for width in range(1, 120):
                self.assertLessEqual(len(progress_bar(status, width)), width)
        self.assertIn("no progress known", progress_bar(status_of(msg.CommandStatus.RUNNING), 80))


class PlainTest(unittest.TestCase):
    def test_every_message_becomes_json_with_all_its_fields(self):
        for service_class, command_class in client.SERVICES.values():
            for message in (command_class(), service_class._response_class()):
                fields = json.loads(json.dumps(plain(message)))
                self.assertEqual(set(message.__slots__) - set(fields), set())

    def test_numbers_have_their_names_beside_them(self):
        fields = plain(status_of(msg.CommandStatus.ERROR, msg.CommandStatus.NO_ROUTE))
        self.assertEqual((fields["status"], fields["status_name"], fields["error_name"]), (3, "ERROR", "NO_ROUTE"))
        self.assertEqual(plain(msg.MapObject(kind=msg.MapObject.AREA))["kind_name"], "area")

    def test_what_json_has_no_number_for_is_null(self):
        self.assertIsNone(plain(msg.Pose(x=math.nan))["x"])
        self.assertIsNone(plain(msg.Pose(x=math.inf))["x"])

    def test_lists_and_bytes_are_lists(self):
        self.assertEqual(plain(msg.Any(data=b"\x01\x02"))["data"], [1, 2])
        self.assertEqual([pose["x"] for pose in plain([msg.Pose(x=1.0), msg.Pose(x=2.0)])], [1.0, 2.0])


if __name__ == "__main__":
    unittest.main()
