# SPDX-License-Identifier: Apache-2.0
"""The words of `external_command_client` that send a command, and the message that each makes of its options."""

import argparse
import math

import genpy
import yaml

from external_command import commands
from external_command.completion import complete_by, ids_of

WORDS = {"stop": "stop", "start": "start", "clear": "clear-planning", "auto": "switch-to-auto",
         "manual": "switch-to-manual", "follow": "follow", "pull-over": "pull-over"}
_SWITCHES = ("high_beam", "low_beam", "horn", "emergency_light")


def add_commands(subparsers, parents):
    """A parser for each word; it sets `sends` (the service) and `make` (a function of the arguments)."""
    def add(word, service, make, text):
        parser = subparsers.add_parser(word, help=text, parents=parents)
        parser.set_defaults(verb="send", sends=service, make=make)
        parser.add_argument("--id", type=int, default=0, help="command id (default: a fresh one)")
        parser.add_argument("--frame", default="", help="frame of all positions (default: map)")
        parser.add_argument("--wait", type=float, nargs="?", const=math.inf, metavar="S",
                            help="until the command has ended, at most S seconds (default: without end)")
        return parser

    for word, name in WORDS.items():
        add(word, "action", lambda args, name=name: commands.action(name, **_common(args)), "the action " + name)
    _add_lane_follow(add)
    _add_valet_parking(add)
    _add_precise_parking(add)
    _add_free_space(add)
    _add_path_follow(add)
    _add_zone_cover(add)
    _add_action(add)
    _add_speed(add)
    _add_chassis(add)


def _add_lane_follow(add):
    def make(args):
        numbers, hints = _parts(args.to)
        return commands.lane_follow(*numbers, z=hints.get("z"), lane_id=hints.get("lane", ""), start=_start(args),
                                    via=_via(args), **_black_list(args), **_motion(args))
    parser = add("lane-follow", "lane_follow", make, "drive along the lanes")
    _add_to(parser, "where to")
    _add_way_points(parser)
    _add_black_list(parser)
    _add_motion(parser)


def _add_valet_parking(add):
    def make(args):
        return commands.valet_parking(args.space, start=_start(args), via=_via(args), **_black_list(args),
                                      **_motion(args))
    parser = add("valet-parking", "valet_parking", make, "drive to a parking space and park")
    complete_by(parser.add_argument("space", help="id of the parking space"), ids_of("spaces"))
    _add_way_points(parser)
    _add_black_list(parser)
    _add_motion(parser)


def _add_precise_parking(add):
    def make(args):
        return commands.precise_parking(*args.to, inwards=args.inwards, mission=args.mission, start=_start(args),
                                        via=_via(args), **_motion(args))
    parser = add("precise-parking", "precise_parking", make, "drive to an area and park at an exact pose")
    parser.add_argument("--to", required=True, nargs=3, type=float, metavar=("X", "Y", "HEADING"), help="where to park")
    parser.add_argument("--inwards", action="store_true", help="nose in (default: nose out, reversing in)")
    parser.add_argument("--mission", choices=sorted(commands.MISSIONS), default="charge")
    _add_way_points(parser)
    _add_motion(parser)


def _add_free_space(add):
    def make(args):
        return commands.free_space(*args.to, **_regions(args), **_motion(args))
    parser = add("free-space", "free_space", make, "drive to a pose without lanes")
    parser.add_argument("--to", required=True, nargs=3, type=float, metavar=("X", "Y", "HEADING"), help="where to")
    _add_regions(parser)
    _add_motion(parser)


def _add_path_follow(add):
    parser = add("path-follow", "path_follow", _path_follow, "follow a given path")
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--points", nargs="+", type=float, metavar="X Y", help="at least 2 points X Y X Y ...")
    source.add_argument("--file", help="a line 'X Y' or 'X Y HEADING' for each point; - is stdin")
    parser.add_argument("--end-heading", type=float, metavar="H", help="of the vehicle at the last point [rad]")
    parser.add_argument("--widths", nargs=2, type=float, default=[0.0, 0.0], metavar=("LEFT", "RIGHT"),
                        help="from the path to its borders [m]")
    for side in ("left", "right"):
        parser.add_argument("--%s-boundary" % side, nargs="+", type=float, default=[], metavar="X Y",
                            help="instead of --widths: as many points as the path has")
    _add_motion(parser)


def _path_follow(args):
    rows = _pairs(args.points, "--points") if args.points else _rows(args.file)
    headings = [row[2] for row in rows if len(row) == 3]
    if headings and len(headings) != len(rows):
        raise ValueError("--file: %d of %d lines have a heading; either all or none may" % (len(headings), len(rows)))
    return commands.path_follow(rows, headings=headings, end_heading=args.end_heading,
                                left_boundary=_pairs(args.left_boundary, "--left-boundary"),
                                right_boundary=_pairs(args.right_boundary, "--right-boundary"),
                                left_width=args.widths[0], right_width=args.widths[1], **_motion(args))


def _add_zone_cover(add):
    def make(args):
        return commands.zone_cover(args.area, swath_width=args.swath_width, resume=args.resume,
                                   skip_swaths=args.skip_swath, start=_start(args), via=_via(args), **_regions(args),
                                   **_motion(args))
    parser = add("zone-cover", "zone_cover", make, "sweep an area")
    complete_by(parser.add_argument("--area", default="", help="id of an area of the map; else --drivable"),
                ids_of("areas"))
    _add_regions(parser)
    parser.add_argument("--swath-width", type=float, default=0.0, metavar="W", help="[m]")
    parser.add_argument("--resume", action="store_true", help="go on where an earlier run of the area stopped")
    parser.add_argument("--skip-swath", type=int, action="append", default=[], metavar="N",
                        help="with --resume: leave it for the end; from 0, swath 7 of 30 is 6; may be repeated")
    _add_way_points(parser)
    _add_motion(parser)


def _add_action(add):
    parser = add("action", "action", lambda args: commands.action(args.action, **_common(args)),
                 "stop, start, change the lane, switch the mode ...")
    parser.add_argument("action", choices=sorted(commands.ACTIONS))


def _add_speed(add):
    def make(args):
        return commands.speed(args.target, factor=args.factor, restore=args.restore, **_common(args))
    parser = add("speed", "speed", make, "change the speed of the running motion command")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--target", type=float, metavar="V", help="[m/s]")
    kind.add_argument("--factor", type=float, metavar="F", help="of the planned speed, in [0, 1]")
    kind.add_argument("--restore", action="store_true", help="as the motion command said")


def _add_chassis(add):
    def make(args):
        switches = {name: {None: None, "on": True, "off": False}[getattr(args, name)] for name in _SWITCHES}
        custom = _message(*args.custom) if args.custom else None
        return commands.chassis(turn_signal=args.turn_signal, custom_operation=custom, **switches, **_common(args))
    parser = add("chassis", "chassis", make, "lights and horn; what is not named stays as it is")
    parser.add_argument("--turn-signal", choices=sorted(commands.TURN_SIGNALS))
    for name in _SWITCHES:
        parser.add_argument("--" + name.replace("_", "-"), choices=("on", "off"))
    parser.add_argument("--custom", nargs=2, metavar=("TYPE", "YAML"),
                        help="an operation of another package: a message as rostopic pub takes it, e.g. "
                             "std_msgs/String 'data: wipe'")


def _message(name, fields):
    """A ROS message of any type."""
    import roslib.message
    try:
        message_class = roslib.message.get_message_class(name)
    except ValueError as error:
        raise ValueError("--custom: %s" % error) from error
    if message_class is None:
        raise ValueError("--custom: there is no message type %s" % name)
    message = message_class()
    try:
        values = yaml.safe_load(fields)
        genpy.message.fill_message_args(message, values if isinstance(values, list) else [values] if values else [])
    except (yaml.YAMLError, genpy.MessageException, ValueError) as error:
        raise ValueError("--custom: %r does not fill a %s: %s" % (fields, name, error)) from error
    return message


def _add_to(parser, text):
    parser.add_argument("--to", required=True, nargs="+", type=_pose_word, metavar=("X Y", "HEADING"),
                        help=text + "; z=Z and lane=ID may follow, where lanes lie one above the other")


def _add_way_points(parser):
    pose = {"nargs": "+", "type": _pose_word, "metavar": ("X Y", "HEADING")}
    parser.add_argument("--from", dest="start", **pose, help="start there (default: at the vehicle)")
    parser.add_argument("--via", action="append", default=[], **pose, help="way point; may be repeated")


def _add_black_list(parser):
    complete_by(parser.add_argument("--avoid-lane", action="append", default=[], nargs="+", metavar=("ID", "S"),
                                    help="a lane that may not be driven, or ID START_S END_S a part of it; may be "
                                         "repeated"), ids_of("lanes"))
    complete_by(parser.add_argument("--avoid-road", action="append", default=[], metavar="ID",
                                    help="may be repeated"), ids_of("roads"))


def _add_regions(parser):
    polygon = {"nargs": "+", "type": float, "metavar": "X Y"}
    parser.add_argument("--drivable", default=[], **polygon, help="polygon X Y X Y X Y ... in which to stay")
    parser.add_argument("--obstacle", action="append", default=[], **polygon, help="polygon; may be repeated")


def _add_motion(parser):
    parser.add_argument("--dry-run", action="store_true", help="plan and answer, send nothing")
    parser.add_argument("--speed", type=float, default=0.0, metavar="V", help="target speed [m/s]")


def _common(args):
    return {"id": args.id, "frame": args.frame}


def _motion(args):
    return {"dry_run": args.dry_run, "speed": args.speed, **_common(args)}


def _regions(args):
    return {"drivable": _pairs(args.drivable, "--drivable"),
            "obstacles": [_pairs(values, "--obstacle") for values in args.obstacle]}


def _black_list(args):
    return {"avoid_lanes": [_lane_part(values) for values in args.avoid_lane], "avoid_roads": args.avoid_road}


def _lane_part(values):
    if len(values) not in (1, 3):
        raise ValueError("--avoid-lane takes ID or ID START_S END_S, not %d values" % len(values))
    try:
        return (values[0],) + tuple(map(float, values[1:] or (0.0, 0.0)))
    except ValueError:
        raise ValueError("--avoid-lane: %s are no numbers of metres" % " and ".join(values[1:])) from None


def _pose_word(word):
    """A number, or ("z", number), or ("lane", id)."""
    name, separator, value = word.partition("=")
    if separator and name == "lane":
        return name, value
    try:
        return (name, float(value)) if separator and name == "z" else float(word)
    except ValueError:
        raise argparse.ArgumentTypeError("%r is no number, z=Z or lane=ID" % word) from None


def _parts(words):
    """The numbers of a pose, and its hints by their names."""
    numbers = [word for word in words if isinstance(word, float)]
    hints = dict(word for word in words if not isinstance(word, float))
    if len(numbers) not in (2, 3):
        raise ValueError("a pose is X Y or X Y HEADING, not %d values" % len(numbers))
    return numbers, hints


def _pose(words):
    numbers, hints = _parts(words)
    return commands.pose(*numbers, z=hints.get("z"), lane_id=hints.get("lane", ""))


def _start(args):
    return _pose(args.start) if args.start else None


def _via(args):
    return [_pose(words) for words in args.via]


def _pairs(values, option):
    if len(values) % 2:
        raise ValueError("%s takes pairs X Y; %d values are given" % (option, len(values)))
    return list(zip(values[::2], values[1::2]))


def _rows(name):
    try:
        with open(0 if name == "-" else name, encoding="utf-8") as file:
            lines = file.read().splitlines()
    except (OSError, UnicodeDecodeError) as error:
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
