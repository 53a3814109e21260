# SPDX-License-Identifier: Apache-2.0
import contextlib
import io
import tempfile
import unittest

from external_command import msg
from external_command.client import SERVICES, accepted, describe, pose
from external_command.command_line import make_command, make_parser


def command(line):
    return make_command(make_parser().parse_args(line.split()))


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

    def test_every_service_has_its_command(self):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("0 0 0.5  # start\n\n1.5, 2 0.5\n")
            file.flush()
            for line in ("lane-follow --to 1 2", "valet-parking p1 --via 1 2", "action stop", "free-space --to 1 2 3",
                         "path-follow --file " + file.name, "speed --restore", "chassis --horn on",
                         "precise-parking --to 1 2 3 --inwards", "zone-cover --area yard"):
                made = command(line)
                service = line.split()[0].replace("-", "_")
                self.assertIsInstance(made, SERVICES[service][1])
                if service == "path_follow":
                    self.assertEqual(list(made.heading), [0.5, 0.5])

    def test_actions_speeds_and_signals_have_their_constants(self):
        self.assertEqual(command("action switch-to-manual").command, msg.ActionCommand.SWITCH_TO_MANUAL)
        self.assertEqual(command("speed --factor 0").kind, msg.SpeedCommand.TARGET_SPEED_FACTOR)
        self.assertEqual(command("speed --target 3").target_speed, 3.0)
        signal = command("chassis --turn-signal left --horn off").basic_signal
        self.assertEqual(signal, msg.VehicleSignal(turn_signal=msg.VehicleSignal.TURN_LEFT, horn=msg.VehicleSignal.OFF))

    def test_polygons_are_pairs(self):
        made = command("free-space --to 1 2 3 --drivable 0 0 9 0 9 9 --obstacle 1 1 2 1 2 2 --obstacle 4 4 5 4 5 5")
        self.assertEqual([(p.x, p.y) for p in made.drivable_roi.points], [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0)])
        self.assertEqual(len(made.non_drivable_roi), 2)

    def test_wrong_values_are_named(self):
        for line, text in (("lane-follow --to 1", "not 1 values"),
                           ("lane-follow --to 1 2 --avoid-lane a 3", "--avoid-lane"),
                           ("zone-cover --drivable 1 2 3", "--drivable takes pairs"),
                           ("path-follow --points 1 2 3", "--points takes pairs")):
            with self.assertRaisesRegex(ValueError, text):
                command(line)

    def test_what_is_missing_or_unknown_ends_with_code_2(self):
        for line in ("", "lane-follow", "action jump", "speed", "path-follow --points 1 2 --file -",
                     "speed --factor x"):
            with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit) as caught:
                command(line)
            self.assertEqual(caught.exception.code, 2)


class StatusTest(unittest.TestCase):
    def test_is_described_in_one_line(self):
        status = msg.CommandStatus(command_id=4, status=msg.CommandStatus.ERROR, error_code=msg.CommandStatus.NO_ROUTE,
                                   message="no way")
        self.assertEqual(describe(status), "command 4 ERROR (NO_ROUTE): no way")

    def test_running_and_finished_are_accepted(self):
        self.assertEqual([accepted(msg.CommandStatus(status=n)) for n in (1, 2, 3, 4)], [True, True, False, False])


if __name__ == "__main__":
    unittest.main()
