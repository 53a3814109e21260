# SPDX-License-Identifier: Apache-2.0
"""What `external_command_client` understands; doc/command_line.md has an example of everything."""

import argparse
import math

from external_command.client import SERVICES
from external_command.command_line_commands import add_commands
from external_command.commands import MAP_OBJECTS
from external_command.completion import complete_by, ids_of, running_ids

OK, FAILED, WRONG_LINE, NO_SERVICE, STILL_RUNNING, ENDED_BY_OTHERS, UNKNOWN_COMMAND, NOT_TOLD = range(8)
EXIT_CODES = """exit code:
  0  accepted; with --wait, and of watch: FINISHED; of status: RUNNING or FINISHED; of why-not: nothing is missing
  1  refused, or ended as an error; of why-not: something is missing
  2  the command line is wrong
  3  no ROS master, no such service, or it failed
  4  it still runs after the seconds it was to be waited for
  5  it was cancelled, cleared or stopped, or a newer command took its place
  6  there is no such command
  7  the output could not be written; what was asked for may have been done
"""


def _seconds(text):
    value = float(text)
    if not value > 0.0:
        raise argparse.ArgumentTypeError("it must be above 0")
    return value


def make_parser():
    everywhere = argparse.ArgumentParser(add_help=False, argument_default=argparse.SUPPRESS)
    everywhere.add_argument("--ns", help="namespace of the vehicle (default: apollo)")
    everywhere.add_argument("--timeout", type=_seconds, metavar="S", help="for a service to be there (default: 5)")
    everywhere.add_argument("--json", action="store_true", help="print JSON, an object on each line")
    parser = argparse.ArgumentParser(
        description="Sends a command to the external_command services and prints the answer.", epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter, parents=[everywhere])
    words = parser.add_subparsers(dest="word", metavar="COMMAND", required=True)
    add_commands(words, [everywhere])
    _add_following(words, [everywhere])
    _add_questions(words, [everywhere])
    return parser


def parse(words, parser=None):
    """The arguments, with what is needed of all."""
    args = (parser or make_parser()).parse_args(_with_near(words))
    defaults = {"ns": "apollo", "timeout": 5.0, "json": False}
    for name, value in defaults.items():
        setattr(args, name, getattr(args, name, value))
    return args


def make_command(args):
    """The command message for parsed arguments. Raises ValueError with a text for the user."""
    return args.make(args)


def _with_near(words):
    """`--near -3,5` as `--near=-3,5`: argparse takes the former for an option."""
    joined, rest = [], list(words)
    while rest:
        word = rest.pop(0)
        is_place = word == "--near" and rest and "," in rest[0]
        joined.append(word + "=" + rest.pop(0) if is_place else word)
    return joined


def _add_following(words, parents):
    status = words.add_parser("status", parents=parents, help="ask for the status of a command")
    status.set_defaults(verb="status")
    complete_by(status.add_argument("id", type=int), running_ids)
    status.add_argument("--wait", type=float, nargs="?", const=math.inf, metavar="S", help="until it has ended")
    watch = words.add_parser("watch", parents=parents, help="show how far a command has come, until it has ended")
    watch.set_defaults(verb="watch")
    complete_by(watch.add_argument("id", type=int, nargs="?", help="default: what is driven"), running_ids)
    watch.add_argument("--for", dest="wait", type=float, default=math.inf, metavar="S", help="at most S seconds")
    cancel = words.add_parser("cancel", parents=parents, help="end one command, and no other")
    cancel.set_defaults(verb="cancel")
    complete_by(cancel.add_argument("id", type=int), running_ids)
    words.add_parser("current", parents=parents, help="what is driven, and all that runs").set_defaults(verb="current")


def _add_questions(words, parents):
    why = words.add_parser("why-not", parents=parents, help="what the gateway lacks, for one service or any")
    why.set_defaults(verb="why_not")
    why.add_argument("needed_by", nargs="?", metavar="SERVICE", choices=_service_words(), type=lambda w: w.replace("_", "-"),
                     help=", ".join(_service_words()))
    listing = words.add_parser("list", parents=parents, help="what of the map a command can name")
    listing.set_defaults(verb="list_objects")
    listing.add_argument("kind", choices=sorted(MAP_OBJECTS))
    complete_by(listing.add_argument("--id", default="", help="the one with this id"), _ids_of_kind)
    listing.add_argument("--near", type=_place, metavar="X,Y", help="the nearest to this point first [m]")
    listing.add_argument("--radius", type=float, default=0.0, metavar="M", help="not further from there than this [m]")
    listing.add_argument("--max", type=int, default=0, metavar="N", help="(default: 100)")
    maps = words.add_parser("map", parents=parents, help="about the map as a whole")
    about = maps.add_subparsers(dest="about", metavar="info", required=True)
    about.add_parser("info", parents=parents, help="its file, origin, and what it holds").set_defaults(verb="map_info")


def _service_words():
    return sorted(name.replace("_", "-") for name in SERVICES)


def _ids_of_kind(prefix, parsed_args, **_):
    return ids_of(parsed_args.kind)(prefix, parsed_args)


def _place(text):
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError("%r is no point X,Y" % text) from None
    return x, y
