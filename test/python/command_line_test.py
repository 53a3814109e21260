# SPDX-License-Identifier: Apache-2.0
import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest

from external_command import commands, msg
from external_command.any_message import unpack
from external_command.client import SERVICES, pose
from external_command.command_line import make_command, make_parser, parse
from message_fields import fields_of, set_fields_of
from std_msgs.msg import String

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
# Poses that are not driven to on lanes have neither height nor lane.
WITHOUT_LANES = {"parking_spot_pose.z", "parking_spot_pose.has_z", "parking_spot_pose.lane_id"}
# Of each word, command lines which together give every field of its message.
COMPLETE = {
    "lane_follow": ["lane-follow --to 1 2 3 z=4 lane=l --from 5 6 7 z=8 lane=m --via 5 6 7 z=8 lane=m --avoid-lane a 1 2 "
                    "--avoid-road r --speed 4 --dry-run --id 9 --frame odom"],
    "valet_parking": ["valet-parking p --from 5 6 7 z=8 lane=m --avoid-lane a 1 2 --avoid-road r --speed 4 --dry-run "
                      "--id 9 --frame odom"],
    "action": ["action stop --id 9 --frame odom"],
    "free_space": ["free-space --to 1 2 3 --drivable 1 1 2 1 2 2 --obstacle 1 1 2 1 2 2 --speed 4 --dry-run --id 9 "
                   "--frame odom"],
    "path_follow": ["path-follow --points 1 1 2 1 --end-heading 1 --widths 1 2 --speed 4 --dry-run --id 9 --frame odom",
                    "path-follow --points 1 1 2 1 --left-boundary 1 2 2 2 --right-boundary 1 -1 2 -1", "path-follow "
                    "--file FILE"],
    "speed": ["speed --target 3 --id 9 --frame odom", "speed --factor 0.5"],
    "chassis": ["chassis --turn-signal left --high-beam on --low-beam on --horn on --emergency-light off --id 9 "
                "--frame odom --custom std_msgs/String wipe"],
    "precise_parking": ["precise-parking --to 1 2 3 --inwards --mission dump --from 5 6 7 z=8 lane=m --speed 4 --dry-run "
                        "--id 9 --frame odom"],
    "zone_cover": ["zone-cover --area yard --swath-width 2 --resume --skip-swath 3 --from 5 6 7 z=8 lane=m --speed 4 "
                   "--dry-run --id 9 --frame odom", "zone-cover --drivable 1 1 2 1 2 2 --obstacle 1 1 2 1 2 2"],
}


def command(line):
    return make_command(parse(line.split()))


class CommandLineTest(unittest.TestCase):
    def test_lane_follow_takes_start_way_points_and_black_lists(self):
        made = command("lane-follow --to -10 5 1.5 --from 1 2 --via 3 4 --via 5 6 0 --avoid-lane a --avoid-lane b 1 2 "
                       "--avoid-road r --speed 4 --dry-run --id 9 --frame odom")
        self.assertEqual(made.end_pose, pose(-10.0, 5.0, 1.5))
        self.assertTrue(made.is_start_pose_set)
        self.assertEqual(made.way_point, [pose(1.0, 2.0), pose(3.0, 4.0), pose(5.0, 6.0, 0.0)])
        self.assertEqual(made.blacklisted_lane, [msg.LaneSegment("a", 0.0, 0.0), msg.LaneSegment("b", 1.0, 2.0)])
        self.assertEqual((made.blacklisted_road, made.target_speed, made.dry_run), (["r"], 4.0, True))
        self.assertEqual((made.command_id, made.header.frame_id), (9, "odom"))

    def test_without_from_the_vehicle_is_the_start(self):
        made = command("lane-follow --to 1 2 --via 3 4")
        self.assertFalse(made.is_start_pose_set)
        self.assertEqual(made.way_point, [pose(3.0, 4.0)])
        self.assertFalse(made.end_pose.has_heading)

    def test_a_pose_may_name_its_height_and_lane(self):
        made = command("lane-follow --to 1 2 z=5.5 lane=bridge --via 3 4 0 lane=ramp")
        self.assertEqual(made.end_pose, pose(1.0, 2.0, None, 5.5, "bridge"))
        self.assertEqual(made.way_point, [pose(3.0, 4.0, 0.0, lane_id="ramp")])

    def test_every_service_has_its_command(self):
        self.assertEqual(set(COMPLETE), set(SERVICES))
        for service, lines in COMPLETE.items():
            for line in lines:
                if "FILE" not in line:
                    args = parse(line.split())
                    self.assertEqual(args.sends, service)
                    self.assertIsInstance(make_command(args), SERVICES[service][1])

    def test_every_field_of_every_command_has_an_option(self):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("1 1 0.5\n2 1 0.5\n")
            file.flush()
            for service, lines in COMPLETE.items():
                given = set().union(*(set_fields_of(command(line.replace("FILE", file.name))) for line in lines))
                missing = fields_of(SERVICES[service][1]) - given - {"header.seq", "header.stamp"}
                self.assertEqual(missing - WITHOUT_LANES, set(), service)

    def test_a_path_may_come_from_a_file(self):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("0 0 0.5  # start\n\n1.5, 2 0.5\n")
            file.flush()
            made = command("path-follow --file " + file.name)
            self.assertEqual(list(made.heading), [0.5, 0.5])
            self.assertEqual((made.way_point[1].x, made.way_point[1].y), (1.5, 2.0))
            file.write("2 2\n")
            file.flush()
            with self.assertRaisesRegex(ValueError, "2 of 3 lines have a heading"):
                command("path-follow --file " + file.name)
        with self.assertRaisesRegex(ValueError, "/no/such/file"):
            command("path-follow --file /no/such/file")

    def test_actions_speeds_and_signals_have_their_constants(self):
        self.assertEqual(command("action switch-to-manual").command, msg.ActionCommand.SWITCH_TO_MANUAL)
        self.assertEqual(command("speed --factor 0").kind, msg.SpeedCommand.TARGET_SPEED_FACTOR)
        self.assertEqual(command("speed --target 3").target_speed, 3.0)
        self.assertEqual(command("speed --restore").kind, msg.SpeedCommand.RESTORE_TARGET_SPEED)
        signal = command("chassis --turn-signal left --horn off").basic_signal
        self.assertEqual(signal, msg.VehicleSignal(turn_signal=msg.VehicleSignal.TURN_LEFT, horn=msg.VehicleSignal.OFF))

    def test_the_common_actions_are_words(self):
        constants = msg.ActionCommand
        for word, action in (("stop", constants.STOP), ("start", constants.START), ("clear", constants.CLEAR_PLANNING),
                             ("auto", constants.SWITCH_TO_AUTO), ("manual", constants.SWITCH_TO_MANUAL),
                             ("follow", constants.FOLLOW), ("pull-over", constants.PULL_OVER)):
            self.assertEqual(command(word).command, action)
            self.assertEqual(parse([word]).sends, "action")

    def test_every_action_is_known(self):
        numbers = {value for name, value in vars(msg.ActionCommand).items() if name.isupper() and isinstance(value, int)}
        self.assertEqual(set(commands.ACTIONS.values()), numbers)

    def test_a_custom_operation_is_a_message_of_any_type(self):
        for fields in ("data: wipe", "[wipe]"):
            made = make_command(parse(["chassis", "--custom", "std_msgs/String", fields]))
            self.assertEqual(unpack(made.custom_operation, String), String("wipe"))
        for words, told in ((["std_msgs/Strong", "a"], "no message type std_msgs/Strong"), (["String", "a"], "--custom"),
                            (["std_msgs/String", "dta: a"], "does not fill"), (["std_msgs/String", "{"], "does not fill")):
            with self.assertRaisesRegex(ValueError, told):
                make_command(parse(["chassis", "--custom"] + words))

    def test_polygons_are_pairs(self):
        made = command("free-space --to 1 2 3 --drivable 0 0 9 0 9 9 --obstacle 1 1 2 1 2 2 --obstacle 4 4 5 4 5 5")
        self.assertEqual([(p.x, p.y) for p in made.drivable_roi.points], [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0)])
        self.assertEqual(len(made.non_drivable_roi), 2)

    def test_wrong_values_are_named(self):
        for line, text in (("lane-follow --to 1", "not 1 values"),
                           ("lane-follow --to 1 2 --avoid-lane a 3", "--avoid-lane"),
                           ("lane-follow --to 1 2 --avoid-lane a b c", "b and c are no numbers"),
                           ("zone-cover --drivable 1 2 3", "--drivable takes pairs"),
                           ("path-follow --points 1 2 3", "--points takes pairs")):
            with self.assertRaisesRegex(ValueError, text):
                command(line)

    def test_what_is_missing_or_unknown_ends_with_code_2(self):
        for line in ("", "lane-follow", "action jump", "speed", "path-follow --points 1 2 --file -", "speed --factor x",
                     "lane-follow --to 1 2 high=3", "cancel", "watch x", "list towns", "list lanes --near 3", "map",
                     "why-not dance"):
            with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit) as caught:
                command(line)
            self.assertEqual(caught.exception.code, 2)

    def test_options_of_all_words_may_stand_on_either_side(self):
        for line in ("--ns car --json --timeout 2 current", "current --ns car --json --timeout 2",
                     "--ns car current --json --timeout 2"):
            args = parse(line.split())
            self.assertEqual((args.ns, args.json, args.timeout), ("car", True, 2.0))
        args = parse(["current"])
        self.assertEqual((args.ns, args.json, args.timeout), ("apollo", False, 5.0))

    def test_a_place_may_begin_with_a_minus(self):
        for words in (["--near", "-3,5"], ["--near=-3,5"]):
            self.assertEqual(parse(["list", "lanes"] + words).near, (-3.0, 5.0))

    def test_services_may_be_written_as_ros_does(self):
        self.assertEqual(parse(["why-not", "lane_follow"]).needed_by, "lane-follow")


class CompletionTest(unittest.TestCase):
    """As bash calls it."""

    def completed(self, line, script="external_command_client"):
        environment = dict(os.environ, _ARGCOMPLETE="1", _ARGCOMPLETE_IFS="\n", COMP_LINE=line, COMP_POINT=str(len(line)),
                           ROS_MASTER_URI="http://localhost:1")
        offered = subprocess.run(["bash", "-c", 'exec "$0" "$1" 8>&1 >/dev/null 2>&1 9>/dev/null', sys.executable,
                                  os.path.join(ROOT, "scripts", script)], env=environment, stdout=subprocess.PIPE,
                                 check=False).stdout.decode()
        return [word.strip() for word in offered.split("\n")]

    def setUp(self):
        try:
            import argcomplete  # noqa: F401
        except ImportError:
            self.skipTest("python3-argcomplete is not installed")

    def test_words_and_options_are_offered(self):
        self.assertIn("valet-parking", self.completed("external_command_client va"))
        self.assertIn("--avoid-lane", self.completed("external_command_client lane-follow --avoid"))
        self.assertEqual(set(self.completed("external_command_client list s")) - {""}, {"spaces"})
        self.assertIn("--fail-on", self.completed("check_map --fa", "check_map"))

    def test_without_a_master_no_ids_are_offered(self):
        self.assertEqual("".join(self.completed("external_command_client valet-parking n_o")), "")


class ParserTest(unittest.TestCase):
    def test_the_exit_codes_are_in_the_help(self):
        self.assertIn("exit code:", make_parser().format_help())


if __name__ == "__main__":
    unittest.main()
