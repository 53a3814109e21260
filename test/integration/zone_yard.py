# SPDX-License-Identifier: Apache-2.0
"""What the tests of zone cover share: yards, and a vehicle that sweeps them."""
import os
import re
import time

import rospy
from geometry_msgs.msg import Point

import support
from external_command.msg import ActionCommand, Chassis, CommandStatus, RoiPolygon, ZoneCoverCommand
from external_command.srv import Action, ZoneCover

STANDING = 10  # messages of a chassis at rest in a row after which the vehicle stands, half a second


def polygon(corners):
    return RoiPolygon(points=[Point(x=x, y=y) for x, y in corners])


def box(half_length, half_width):
    """The corners of a yard around the origin."""
    x, y = half_length, half_width
    return [(-x, -y), (x, -y), (x, y), (-x, y)]


def swath_of(message):
    """i of "swath i of n", 0 where there is none."""
    found = re.match(r"swath (\d+) of (\d+)", message)
    return int(found.group(1)) if found else 0


def percent_of(message):
    """n of "n % covered", -1 where there is none."""
    found = re.search(r"(\d+) % covered", message)
    return int(found.group(1)) if found else -1


def wait_until_kept(folder):
    """Until nothing is left to write: progress goes to its file within a second, or later where the disk is slow, which
    shows in how long a new file stands beside the one that it is to replace."""
    seen, since, slowest = None, time.monotonic(), 0.0

    def is_kept():
        nonlocal seen, since, slowest
        now = time.monotonic()
        files = {entry.name: entry.inode() for entry in os.scandir(folder)}
        if files != seen:
            seen, since = files, now
        is_being_written = any(name.endswith(".new") for name in files)
        if is_being_written:
            slowest = max(slowest, now - since)
        return files and not is_being_written and now - since > 1.5 + 2.0 * slowest
    support.wait_until(is_kept, "the progress is kept", 60.0)


class Sweeper:
    """One vehicle that sweeps zones, by its namespace."""

    def __init__(self, vehicle):
        self.ns = "/%s/external_command/" % vehicle
        self.status_service = self.ns + "command_status"
        self._chassis_topic = "/%s/canbus/chassis" % vehicle

    def cover(self, corners, **fields):
        command = ZoneCoverCommand(drivable_roi=polygon(corners), swath_width=2.5, **fields)
        return support.service(self.ns + "zone_cover", ZoneCover)(command)

    def wait_until_ready(self, corners):
        def is_ready():
            try:
                return self.cover(corners, dry_run=True).status.error_code != CommandStatus.NOT_READY
            except Exception:  # pylint: disable=broad-except  # a service that is about to come, or to go
                return False
        support.wait_until(is_ready, "a pose and a plan", 60.0)

    def act(self, action):
        answer = support.service(self.ns + "action", Action)(ActionCommand(command=action))
        support.wait_for_status(answer.status.command_id, CommandStatus.FINISHED, self.status_service)

    def stop(self):
        self.act(ActionCommand.STOP)

    def wait_until_standing(self):
        """A path that is planned while the vehicle moves begins, on a busy machine, too far behind it. One that has not
        set out yet stands too, but not for long."""
        chassis = support.Collector(self._chassis_topic, Chassis)

        def stands():
            newest = [m.speed_mps for m in chassis.messages[-STANDING:]]
            return len(newest) == STANDING and not any(newest)
        support.wait_until(stands, "the vehicle stands")
        chassis.close()

    def finish(self, command_id):
        support.wait_for_status(command_id, CommandStatus.FINISHED, self.status_service, 90.0)

    def collect(self):
        return support.Collector(self.ns + "status", CommandStatus)

    def sweep_until(self, corners, reached, action=ActionCommand.STOP, **fields):
        """Sweeps until a message of progress is `reached`, then ends it by `action`. Returns all of these messages."""
        statuses = self.collect()
        answer = self.cover(corners, **fields)
        assert answer.status.status == CommandStatus.RUNNING, support.describe(answer.status)
        command_id = answer.status.command_id
        statuses.wait_for(lambda m: m.command_id == command_id and reached(m.message), "progress")
        if action:
            self.act(action)
            self.wait_until_standing()
        messages = [m.message for m in statuses.messages if m.command_id == command_id and swath_of(m.message)]
        statuses.close()
        return messages
