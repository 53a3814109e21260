# SPDX-License-Identifier: Apache-2.0
"""What `external_command_client` understands, and the commands it makes of it."""

import argparse
import math

from geometry_msgs.msg import Point

from external_command import msg
from external_command.client import polygon, pose

EXIT_CODES = """exit code:
  0  the command was accepted, or with --wait it is FINISHED; status: the command is RUNNING or FINISHED
  1  refused, or ended as an error, or --wait took longer than its seconds
  2  the command line is wrong
  3  no ROS master, or no such service
"""
ACTIONS = {name.lower().replace("_", "-"): getattr(msg.ActionCommand, name) for name in (
    "FOLLOW CHANGE_LEFT CHANGE_RIGHT PULL_OVER STOP START CLEAR_PLANNING SWITCH_TO_MANUAL SWITCH_TO_AUTO VIN_REQ "
    "ENTER_MISSION EXIT_MISSION").split()}
TURN_SIGNALS = {"none": msg.VehicleSignal.TURN_NONE, "left": msg.VehicleSignal.TURN_LEFT,
                "right": msg.VehicleSignal.TURN_RIGHT, "hazard": msg.VehicleSignal.TURN_HAZARD}
MISSIONS = {"charge": msg.PreciseParkingCommand.CHARGE, "dump": msg.PreciseParkingCommand.DUMP}
_POSE = {"nargs": "+", "type": float, "metavar": ("X Y", "HEADING")}
_POLYGON = {"nargs": "+", "type": float, "metavar": "X Y"}


def make_parser():
    parser = argparse.ArgumentParser(
        description="Sends a command to the external_command services and prints the answer.", epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ns", default="apollo", help="namespace of the vehicle (default: apollo)")
    parser.add_argument("--timeout", type=float, default=5.0, metavar="S",
                        help="for a service to be there (default: 5)")
    commands = parser.add_subparsers(dest="service", metavar="COMMAND", required=True)
    for add in (_add_lane_follow, _add_valet_parking, _add_action, _add_free_space, _add_path_follow, _add_speed,
                _add_chassis, _add_precise_parking, _add_zone_cover):
        _add_common(add(commands))
    status = commands.add_parser("status", help="ask for the status of a command")
    status.add_argument("id", type=int)
    status.add_argument("--wait", type=float, nargs="?", const=math.inf, metavar="S", help="until it has ended")
    return parser


def make_command(args):
    """The command message for parsed arguments. Raises ValueError with a text for the user."""
    command = args.make(args)
    command.command_id = args.id
    command.header.frame_id = args.frame
    return command


def _add_common(parser):
    parser.add_argument("--id", type=int, default=0, help="command id (default: a fresh one)")
    parser.add_argument("--frame", default="", help="frame of all positions (default: map)")
    parser.add_argument("--wait", type=float, nargs="?", const=math.inf, metavar="S",
                        help="until the command has ended, at most S seconds (default: without end)")


def _add_motion(parser):
    parser.add_argument("--dry-run", action="store_true", help="plan and answer, send nothing")
    parser.add_argument("--speed", type=float, default=0.0, metavar="V", help="target speed [m/s]")
    return parser


def _add_way_points(parser):
    parser.add_argument("--from", dest="start", **_POSE, help="start there (default: at the vehicle)")
    parser.add_argument("--via", action="append", default=[], **_POSE, help="way point; may be repeated")


def _add_black_list(parser):
    parser.add_argument("--avoid-lane", action="append", default=[], nargs="+", metavar=("ID", "S"),
                        help="a lane that may not be driven, or ID START_S END_S a part of it; may be repeated")
    parser.add_argument("--avoid-road", action="append", default=[], metavar="ID", help="may be repeated")


def _add_lane_follow(commands):
    parser = _add_motion(commands.add_parser("lane-follow", help="drive along the lanes"))
    parser.add_argument("--to", required=True, **_POSE, help="where to")
    _add_way_points(parser)
    _add_black_list(parser)
    parser.set_defaults(make=_lane_follow)
    return parser


def _lane_follow(args):
    return msg.LaneFollowCommand(end_pose=_pose(args.to), **_way_points(args), **_black_list(args), **_motion(args))


def _add_valet_parking(commands):
    parser = _add_motion(commands.add_parser("valet-parking", help="drive to a parking space and park"))
    parser.add_argument("space", help="id of the parking space")
    _add_way_points(parser)
    _add_black_list(parser)
    parser.set_defaults(make=_valet_parking)
    return parser


def _valet_parking(args):
    return msg.ValetParkingCommand(parking_spot_id=args.space, **_way_points(args), **_black_list(args),
                                   **_motion(args))


def _add_action(commands):
    parser = commands.add_parser("action", help="stop, start, pull over, switch the mode ...")
    parser.add_argument("action", choices=sorted(ACTIONS))
    parser.set_defaults(make=lambda args: msg.ActionCommand(command=ACTIONS[args.action]))
    return parser


def _add_free_space(commands):
    parser = _add_motion(commands.add_parser("free-space", help="drive to a pose without lanes"))
    parser.add_argument("--to", required=True, nargs=3, type=float, metavar=("X", "Y", "HEADING"), help="where to")
    _add_regions(parser)
    parser.set_defaults(make=_free_space)
    return parser


def _add_regions(parser):
    parser.add_argument("--drivable", **_POLYGON, help="polygon X Y X Y X Y ... in which to stay")
    parser.add_argument("--obstacle", action="append", default=[], **_POLYGON, help="polygon; may be repeated")


def _free_space(args):
    return msg.FreeSpaceCommand(parking_spot_pose=_pose(args.to), **_regions(args), **_motion(args))


def _add_path_follow(commands):
    parser = _add_motion(commands.add_parser("path-follow", help="follow a given path"))
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--points", nargs="+", type=float, metavar="X Y", help="at least 2 points X Y X Y ...")
    source.add_argument("--file", help="a line 'X Y' or 'X Y HEADING' for each point; - is stdin")
    parser.add_argument("--widths", nargs=2, type=float, default=[0.0, 0.0], metavar=("LEFT", "RIGHT"),
                        help="from the path to its borders [m]")
    parser.set_defaults(make=_path_follow)
    return parser


def _path_follow(args):
    rows = _pairs(args.points, "--points") if args.points else _rows(args.file)
    headings = [row[2] for row in rows if len(row) == 3]
    if headings and len(headings) != len(rows):
        raise ValueError("--file: %d of %d lines have a heading; either all or none may" % (len(headings), len(rows)))
    return msg.PathFollowCommand(way_point=[Point(row[0], row[1], 0.0) for row in rows], heading=headings,
                                 left_path_width=args.widths[0], right_path_width=args.widths[1], **_motion(args))


def _add_speed(commands):
    parser = commands.add_parser("speed", help="change the speed of the running motion command")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--target", type=float, metavar="V", help="[m/s]")
    kind.add_argument("--factor", type=float, metavar="F", help="of the planned speed, in [0, 1]")
    kind.add_argument("--restore", action="store_true", help="as the motion command said")
    parser.set_defaults(make=_speed)
    return parser


def _speed(args):
    if args.restore:
        return msg.SpeedCommand(kind=msg.SpeedCommand.RESTORE_TARGET_SPEED)
    if args.factor is not None:
        return msg.SpeedCommand(kind=msg.SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=args.factor)
    return msg.SpeedCommand(kind=msg.SpeedCommand.TARGET_SPEED, target_speed=args.target)


_SWITCHES = ("high_beam", "low_beam", "horn", "emergency_light")


def _add_chassis(commands):
    parser = commands.add_parser("chassis", help="lights and horn; what is not named stays as it is")
    parser.add_argument("--turn-signal", choices=sorted(TURN_SIGNALS))
    for name in _SWITCHES:
        parser.add_argument("--" + name.replace("_", "-"), choices=("on", "off"))
    parser.set_defaults(make=_chassis)
    return parser


def _chassis(args):
    signal = msg.VehicleSignal(turn_signal=TURN_SIGNALS.get(args.turn_signal, msg.VehicleSignal.TURN_KEEP))
    states = {None: msg.VehicleSignal.KEEP, "on": msg.VehicleSignal.ON, "off": msg.VehicleSignal.OFF}
    for name in _SWITCHES:
        setattr(signal, name, states[getattr(args, name)])
    return msg.ChassisCommand(basic_signal=signal)


def _add_precise_parking(commands):
    parser = _add_motion(commands.add_parser("precise-parking", help="drive to an area and park at an exact pose"))
    parser.add_argument("--to", required=True, nargs=3, type=float, metavar=("X", "Y", "HEADING"), help="where to park")
    parser.add_argument("--inwards", action="store_true", help="nose in (default: nose out, reversing in)")
    parser.add_argument("--mission", choices=sorted(MISSIONS), default="charge")
    _add_way_points(parser)
    parser.set_defaults(make=_precise_parking)
    return parser


def _precise_parking(args):
    return msg.PreciseParkingCommand(parking_spot_pose=_pose(args.to), parking_inwards=args.inwards,
                                     mission_type=MISSIONS[args.mission], **_way_points(args), **_motion(args))


def _add_zone_cover(commands):
    parser = _add_motion(commands.add_parser("zone-cover", help="sweep an area"))
    parser.add_argument("--area", default="", help="id of an area of the map; else --drivable")
    _add_regions(parser)
    parser.add_argument("--swath-width", type=float, default=0.0, metavar="W", help="[m]")
    parser.add_argument("--resume", action="store_true", help="go on where an earlier run of the area stopped")
    _add_way_points(parser)
    parser.set_defaults(make=_zone_cover)
    return parser


def _zone_cover(args):
    return msg.ZoneCoverCommand(zone_cover_area_id=args.area, swath_width=args.swath_width, resume=args.resume,
                                **_regions(args), **_way_points(args), **_motion(args))


def _motion(args):
    return {"dry_run": args.dry_run, "target_speed": args.speed}


def _way_points(args):
    start = [_pose(args.start)] if args.start else []
    return {"is_start_pose_set": bool(start), "way_point": start + [_pose(values) for values in args.via]}


def _black_list(args):
    return {"blacklisted_lane": [_lane_segment(values) for values in args.avoid_lane],
            "blacklisted_road": args.avoid_road}


def _regions(args):
    return {"drivable_roi": polygon(_pairs(args.drivable or [], "--drivable")),
            "non_drivable_roi": [polygon(_pairs(values, "--obstacle")) for values in args.obstacle]}


def _pose(values):
    if len(values) not in (2, 3):
        raise ValueError("a pose is X Y or X Y HEADING, not %d values" % len(values))
    return pose(*values)


def _lane_segment(values):
    if len(values) not in (1, 3):
        raise ValueError("--avoid-lane takes ID or ID START_S END_S, not %d values" % len(values))
    start_s, end_s = map(float, values[1:] or (0.0, 0.0))
    return msg.LaneSegment(id=values[0], start_s=start_s, end_s=end_s)


def _pairs(values, option):
    if len(values) % 2:
        raise ValueError("%s takes pairs X Y; %d values are given" % (option, len(values)))
    return list(zip(values[::2], values[1::2]))


def _rows(name):
    try:
        with open(0 if name == "-" else name, encoding="utf-8") as file:
            lines = file.read().splitlines()
    except OSError as error:
        raise ValueError("--file: %s" % error) from error
    rows = []
    for number, line in enumerate(lines, 1):
        try:
            row = [float(field) for field in line.replace(",", " ").split("#")[0].split()]
        except ValueError:
            row = [math.nan]
        if len(row) not in (0, 2, 3):
            raise ValueError("%s:%d: X Y or X Y HEADING is needed, not %r" % (name, number, line.strip()))
        if row:
            rows.append(row)
    return rows
