# SPDX-License-Identifier: Apache-2.0
"""What scripts/soak runs: run_soak.py ROOT BUILD_DIR [--commands N] [--minutes N].

Sensible commands of every kind, with a vehicle whose pose is known and a planner that reports, in turns of which each
is the same as the one before: what the gateway keeps after the first of them it has to give back after the others.
"""
import argparse
import os
import statistics
import sys
import time

from campaign import DemoError, Figures, Gateway, Periodic, memory_of

WARM_UP = 10000  # commands
MOST_GROWTH = 1.048576  # after the warm-up [MB]
LATEST_ANSWER = 5.0  # [s]
QUIET = 8.0  # after which the gateway has given back what it needs no more [s]
LIGHT_TURNS = 100  # of the commands that plan nothing, in each turn
COMMAND_STATUS = "/apollo/external_command/command_status"


class Vehicle(Periodic):
    """Tells where it is, on a lane of the demo town."""

    def __init__(self):
        import tf2_ros
        super().__init__(0.05, self._tell)
        self._broadcaster = tf2_ros.TransformBroadcaster()

    def _tell(self):
        import rospy
        from geometry_msgs.msg import TransformStamped
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "map", "base_link"
        transform.header.stamp = rospy.Time.now()
        transform.transform.translation.x, transform.transform.translation.y = 90.0, 194.75
        transform.transform.rotation.w = 1.0
        self._broadcaster.sendTransform(transform)


class Clients:
    """A kept connection to each service."""

    def __init__(self):
        import rospy
        from external_command.client import SERVICES
        from external_command.srv import GetCommandStatus
        self._proxies = {name: rospy.ServiceProxy("/apollo/external_command/" + name, types[0], persistent=True)
                         for name, types in SERVICES.items()}
        self._status = rospy.ServiceProxy(COMMAND_STATUS, GetCommandStatus, persistent=True)
        self.durations = []

    def call(self, name, command):
        begin = time.monotonic()
        status = self._proxies[name](command=command).status
        self.durations.append(time.monotonic() - begin)
        return status

    def status(self, command_id):
        begin = time.monotonic()
        status = self._status(command_id=command_id).status
        self.durations.append(time.monotonic() - begin)
        return status


def commands():
    """(service, command) of a turn: planned ones once, the others many times."""
    from external_command import msg
    from external_command.client import polygon, pose
    from geometry_msgs.msg import Point
    square = polygon([(80.0, 180.0), (120.0, 180.0), (120.0, 210.0), (80.0, 210.0)])
    planned = [
        ("free_space", msg.FreeSpaceCommand(parking_spot_pose=pose(110.0, 195.0, 0.0), drivable_roi=square)),
        ("valet_parking", msg.ValetParkingCommand(parking_spot_id="n_out_5", dry_run=True)),
        ("zone_cover", msg.ZoneCoverCommand(drivable_roi=square, swath_width=2.5, dry_run=True)),
    ]
    light = [
        ("lane_follow", msg.LaneFollowCommand(end_pose=pose(478.0, 338.25))),
        ("path_follow", msg.PathFollowCommand(way_point=[Point(90.0 + 5.0 * i, 194.75, 0.0) for i in range(20)])),
        ("speed", msg.SpeedCommand(kind=msg.SpeedCommand.TARGET_SPEED, target_speed=3.0)),
        ("chassis", msg.ChassisCommand(basic_signal=msg.VehicleSignal(turn_signal=2))),
        ("lane_follow", msg.LaneFollowCommand(end_pose=pose(1e6, 0.0))),
        ("action", msg.ActionCommand(command=msg.ActionCommand.STOP)),
        ("action", msg.ActionCommand(command=msg.ActionCommand.CLEAR_PLANNING)),
    ]
    return planned + LIGHT_TURNS * light


class Memory:
    """Of the gateway, in a quiet moment."""

    def __init__(self, gateway):
        time.sleep(QUIET)
        self.resident = gateway.rss()
        self.heap = memory_of(gateway.pid, "RssAnon")
        self.threads = len(os.listdir("/proc/%d/task" % gateway.pid))


def soak(gateway, most, minutes, figures):
    clients, turn = Clients(), commands()
    end = time.monotonic() + 60.0 * minutes
    warm, sent_warm = None, 0
    sent = ids_without_end = 0
    while sent < most and time.monotonic() < end:
        for service, command in turn:
            status = clients.call(service, command)
            if clients.status(status.command_id).status == 4:
                ids_without_end += 1
        sent += len(turn)
        if warm is None and sent >= WARM_UP:
            warm, sent_warm = Memory(gateway), sent
    if warm is None or sent < 2 * WARM_UP:
        raise DemoError("%d commands are too few: the first %d are the warm-up; give more, or more time" %
                        (sent, WARM_UP))
    last = Memory(gateway)
    figures.show("commands", sent)
    figures.show("of them after the warm-up", sent - sent_warm)
    figures.show("answer, median", 1e3 * statistics.median(clients.durations), "ms")
    figures.show("answer, slowest", max(clients.durations), "s", LATEST_ANSWER)
    figures.show("commands whose status was not known", ids_without_end, "", 0)
    figures.show("threads", last.threads)
    figures.show("memory after the warm-up", warm.resident, "MB")
    figures.show("growth since then", last.resident - warm.resident, "MB", MOST_GROWTH)
    figures.show("of it, of the heap", last.heap - warm.heap, "MB", MOST_GROWTH)
    if not gateway.is_alive():
        figures.fault("another gateway answers than at the beginning, or none")


def main(words):
    parser = argparse.ArgumentParser(prog="scripts/soak")
    parser.add_argument("root")
    parser.add_argument("build_dir")
    parser.add_argument("--commands", type=int, default=110000)
    parser.add_argument("--minutes", type=float, default=1e6)
    args = parser.parse_args(words)
    figures = Figures()
    try:
        with Gateway(args.root, args.build_dir) as gateway, Vehicle():
            time.sleep(1.0)
            soak(gateway, args.commands, args.minutes, figures)
    except DemoError as error:
        figures.fault(error)
    return figures.exit_code()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
