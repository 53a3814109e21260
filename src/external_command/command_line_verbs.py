# SPDX-License-Identifier: Apache-2.0
"""What the words of `external_command_client` do. Each function returns the exit code."""

import math
import time

import rospy

from external_command.client import accepted
from external_command.command_line import (ENDED_BY_OTHERS, FAILED, OK, STILL_RUNNING, UNKNOWN_COMMAND, make_command)
from external_command.commands import MAP_OBJECTS
from external_command.msg import CommandStatus

PERIOD = 0.2  # of asking for a status that is waited for [s]


def outcome(status):
    """The exit code for a command that has this status."""
    if status.status == CommandStatus.UNKNOWN:
        return UNKNOWN_COMMAND
    if status.status == CommandStatus.ERROR:
        by_others = status.error_code in (CommandStatus.CANCELLED, CommandStatus.SUPERSEDED)
        return ENDED_BY_OTHERS if by_others else FAILED
    return OK


def send(client, args, output):
    response = client.call(args.sends, make_command(args))
    output.response(response)
    is_over = args.wait is None or not accepted(response.status) or getattr(args, "dry_run", False)
    return outcome(response.status) if is_over else _wait(client, response.status.command_id, args.wait, output)


def status(client, args, output):
    if args.wait is not None:
        return _wait(client, args.id, args.wait, output)
    found = client.status(args.id)
    output.status(found)
    return outcome(found)


def watch(client, args, output):
    command_id = args.id if args.id is not None else _driven(client, output)
    return UNKNOWN_COMMAND if command_id is None else _wait(client, command_id, args.wait, output)


def _driven(client, output):
    """What is driven, else the newest that runs, else what was driven last."""
    current = client.current()
    if current.motion.status != CommandStatus.RUNNING and current.running:
        return current.running[-1].command_id
    if current.motion.status == CommandStatus.UNKNOWN:
        output.error("no command runs, and no motion command ever has")
        return None
    return current.motion.command_id


def _wait(client, command_id, seconds, output):
    """Shows the status while it runs, at most once a second unless its words change, and the last one."""
    shown = [None, -math.inf]  # what was said of it, and when

    def show(found):
        if found.status != CommandStatus.RUNNING:
            return
        now = time.monotonic()
        said = (found.message, round(found.share_done, 3), found.has_progress)
        if said == shown[0] or now < shown[1] + 1.0:
            return
        output.progress(found)
        shown[:] = said, now

    try:
        last = client.wait(command_id, seconds, show, PERIOD)
    except KeyboardInterrupt:
        output.error("command %d still runs; to end it: external_command_client cancel %d" % (command_id, command_id))
        return STILL_RUNNING
    output.status(last)
    if last.status == CommandStatus.RUNNING:
        output.error("command %d is still running after %g s" % (command_id, seconds))
        return STILL_RUNNING
    return outcome(last)


def cancel(client, args, output):
    response = client.cancel(args.id)
    output.cancelled(response)
    return UNKNOWN_COMMAND if response.status.status == CommandStatus.UNKNOWN else OK


def current(client, args, output):
    output.current(client.current())
    return OK


def why_not(client, args, output):
    service = args.needed_by.replace("-", "_") if args.needed_by else None
    readiness = client.readiness()
    conditions = [condition for condition in readiness.conditions
                  if not condition.is_met and (service is None or service in condition.needed_by)]
    output.unmet(readiness, conditions)
    return FAILED if conditions else OK


def list_objects(client, args, output):
    output.objects(client.map_objects(args.kind, args.id, args.near, args.radius, args.max))
    return OK


def map_info(client, args, output):
    base = "/%s/external_command/" % args.ns.strip("/")
    info = {"file": rospy.get_param(base + "map_file", ""),
            "origin": rospy.get_param(base + "map_origin_resolved", [0.0, 0.0])}
    for kind in sorted(MAP_OBJECTS):
        info[kind] = client.map_objects(kind, max_count=1).total_count
    output.map_info(info)
    return OK


def is_refused(error):
    """The exit code and words for a CommandError that a question was answered with."""
    return outcome(error.status), "%s: %s" % (error.code_name, error.status.message)
