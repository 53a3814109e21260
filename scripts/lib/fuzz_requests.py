# SPDX-License-Identifier: Apache-2.0
"""Throws random and hostile requests at every command service of a running component, and tells what went wrong. A part
of scripts/fuzz, which starts that component.

Requests are sensible ones with fields changed to NaN, infinity, limits of their types, huge lists, strange strings and
ids used before; they come from several threads at once, from clients that are killed while they wait, and beside a
flood of topics and jumping, stale or missing transforms. A process of its own sends STOP all the while and measures.

What must hold, else the exit code is 1: the component's process lives; every call is answered, in time; the answer to
a wrong request names one of its fields; STOP is answered in time. Never run it against a component that drives
a vehicle.
"""
import argparse
import collections
import io
import math
import random
import statistics
import string
import subprocess
import sys
import threading
import time
import xmlrpc.client

import genpy
import rosgraph
import rospy
import rosservice
import tf2_ros
from geometry_msgs.msg import Point, TransformStamped

from answer_times import latest_answer
from external_command import msg
from external_command.client import SERVICES, CommandClient, ServiceUnavailable, pose, polygon
from external_command.srv import Action

NUMBERS = [0.0, -0.0, 1.0, -1.0, 1e-9, 1e-300, 1e6, -1e6, 1e12, 1e308, -1e308, math.nan, math.inf, -math.inf]
STRINGS = ["", " ", "map", "base_link", "no_such_frame", "a/b//c", "~x", "%s%n", "\0", "\n\r\t", "../../etc/passwd",
           "\u00fc\u4e2d\U0001f697\u202e", "x" * 100000]
LENGTHS = [0, 1, 2, 3, 10, 1000, 20000]
RARE_LENGTH = 1000000
MOST_BYTES = 30000000
SMALL = ("geometry_msgs/Point", "external_command/Pose", "float64", "uint32")
CENTRE = (100.0, 195.0)  # on a lane of the demo town


def parse_arguments(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ns", default="apollo", help="namespace of the component (default: apollo)")
    parser.add_argument("--base-frame", default="base_link", help="its ~base_frame (default: base_link)")
    parser.add_argument("--seed", type=int, default=1, help="of all random choices (default: 1)")
    parser.add_argument("--duration", type=float, default=60.0, help="[s] (default: 60)")
    parser.add_argument("--threads", type=int, default=8, help="clients at once (default: 8)")
    parser.add_argument("--services", default=",".join(sorted(SERVICES)), help="which, by comma (default: all)")
    parser.add_argument("--sensible", action="store_true", help="sensible dry runs only: plans that no STOP ends")
    parser.add_argument("--no-flood", action="store_true", help="no flood of topics and transforms, no killed clients")
    parser.add_argument("--no-stop", action="store_true", help="send no STOP")
    parser.add_argument("--only-stop", action="store_true", help="send STOP only, and measure it")
    parser.add_argument("--limit", type=float, default=5.0, help="for an answer that waits for no other [s] (default: 5)")
    parser.add_argument("--stop-limit", type=float, default=0.1, help="for the answer to STOP [s] (default: 0.1)")
    return parser.parse_args(words)


class Requests:
    """Random commands, sensible or not."""

    def __init__(self, seed, only_sensible):
        self._random = random.Random(seed)
        self._only_sensible = only_sensible

    def make(self, service):
        command = self._sensible(service)
        if self._only_sensible:
            if hasattr(command, "dry_run"):
                command.dry_run = True  # no STOP ends its planning
            return command
        command.command_id = self._random.choice([0, 0, 0, -1, 1, 2, 3, 2 ** 63 - 1, -2 ** 63])
        for _ in range(self._random.choice([0, 1, 1, 1, 2, 5])):
            self.change(command)
        return command

    def change(self, message):
        """Changes one field somewhere in `message`."""
        fields = list(zip(message.__slots__, message._slot_types))
        if not fields:
            return
        name, field_type = self._random.choice(fields)
        value = getattr(message, name)
        base, bracket, _ = field_type.partition("[")
        if bracket:
            setattr(message, name, self._list(base, value))
        elif isinstance(value, genpy.Message):
            self.change(value)
        else:
            setattr(message, name, self._value(base))

    def _list(self, base, old):
        if base == "uint8":
            return bytes(self._random.getrandbits(8) for _ in range(self._random.choice([0, 1, 1000])))
        choice = self._random.random()
        if old and choice < 0.4:
            item = self._random.choice(old)
            if isinstance(item, genpy.Message):
                self.change(item)
                return old
        if old and choice < 0.6:
            return self._random.sample(old, len(old)) + [old[0]]
        length = RARE_LENGTH if self._random.random() < 0.02 else self._random.choice(LENGTHS)
        if base not in SMALL:
            length = min(length, 100)  # roscpp takes no message above 1 GB
        pool = [self._item(base) for _ in range(min(length, 50))]
        return [self._random.choice(pool) for _ in range(length)]

    def _item(self, base):
        if "/" not in base:
            return self._value(base)
        item = Point() if base == "geometry_msgs/Point" else getattr(msg, base.split("/")[1])()
        if isinstance(item, (Point, msg.Pose)) and self._random.random() < 0.8:
            item.x, item.y = self._near(), self._near()
            return item
        self.change(item)
        return item

    def _near(self):
        return self._random.uniform(50.0, 250.0)

    def _value(self, base):
        if base in ("float64", "float32"):
            return self._random.choice(NUMBERS + [self._random.uniform(-300.0, 300.0)])
        if base == "string":
            letters = "".join(self._random.choice(string.printable) for _ in range(20))
            return self._random.choice(STRINGS + [letters])
        if base == "bool":
            return self._random.random() < 0.5
        if base == "time":
            return self._random.choice([rospy.Time(), rospy.Time.now(), rospy.Time(1), rospy.Time(2 ** 32 - 1)])
        bits = int(base.lstrip("uint"))
        low, high = (0, 2 ** bits - 1) if base[0] == "u" else (-2 ** (bits - 1), 2 ** (bits - 1) - 1)
        return self._random.choice([low, high, 0, 1, self._random.randint(low, high)])

    def _square(self, x, y, size):
        return polygon([(x, y), (x + size, y), (x + size, y + size), (x, y + size)])

    def _sensible(self, service):
        x, y = CENTRE
        some = self._random
        goal = pose(x + some.uniform(5.0, 30.0), y + some.uniform(5.0, 30.0), some.uniform(-3.0, 3.0))
        field = self._square(x - 30.0, y - 30.0, some.uniform(70.0, 400.0))
        hole = self._square(x + some.uniform(10.0, 30.0), y + some.uniform(-20.0, 20.0), 3.0)
        make = {
            "lane_follow": lambda: msg.LaneFollowCommand(
                end_pose=pose(some.uniform(0.0, 500.0), some.uniform(0.0, 400.0))),
            "valet_parking": lambda: msg.ValetParkingCommand(parking_spot_id="spot_%d" % some.randint(0, 140)),
            "action": lambda: msg.ActionCommand(command=some.choice([1, 2, 3, 4, 6, 7, 50, 51, 52, 53, 54])),
            "free_space": lambda: msg.FreeSpaceCommand(
                parking_spot_pose=goal, drivable_roi=field, non_drivable_roi=[hole]),
            "path_follow": lambda: msg.PathFollowCommand(
                way_point=[Point(x + 5.0 * i, y + some.uniform(-0.2, 0.2), 0.0) for i in range(20)]),
            "speed": lambda: msg.SpeedCommand(kind=some.randint(1, 3), target_speed=3.0, target_speed_factor=0.5),
            "chassis": lambda: msg.ChassisCommand(basic_signal=msg.VehicleSignal(horn=some.randint(0, 2))),
            "precise_parking": lambda: msg.PreciseParkingCommand(
                parking_spot_pose=goal, parking_inwards=some.random() < 0.5),
            "zone_cover": lambda: msg.ZoneCoverCommand(drivable_roi=field, non_drivable_roi=[hole]),
        }
        return make[service]()


class Findings:
    """What went wrong, each kind counted, with its first example. Thread-safe."""

    def __init__(self):
        self._lock = threading.Lock()
        self._seen = {}
        self.calls = collections.Counter()
        self.slowest = collections.defaultdict(float)

    def add(self, kind, example):
        with self._lock:
            count, first = self._seen.get(kind, (0, example))
            self._seen[kind] = (count + 1, first)

    def note(self, service, code, duration):
        with self._lock:
            self.calls[service, code] += 1
            self.slowest[service] = max(self.slowest[service], duration)

    def show(self):
        print("requests sent %d, slowest answer %.3f s" % (sum(self.calls.values()), max(self.slowest.values(), default=0)))
        for service in sorted(self.slowest):
            codes = {code: n for (name, code), n in sorted(self.calls.items()) if name == service}
            print("%-16s slowest answer %.3f s; answers by error code: %s" % (service, self.slowest[service], codes))
        for kind, (count, example) in sorted(self._seen.items()):
            print("FOUND %d times: %s; first: %.500s" % (count, kind, example))
        return bool(self._seen)


def field_names(message):
    """Of a message and all messages in it."""
    names = set(message.__slots__)
    for name in message.__slots__:
        value = getattr(message, name)
        if isinstance(value, list) and value:
            value = value[0]
        if isinstance(value, genpy.Message):
            names |= field_names(value)
    return names


def is_too_large(command):
    """To be sent within the limit of an answer, by a client in Python."""
    buffer = io.BytesIO()
    try:
        command.serialize(buffer)
    except (genpy.SerializationError, UnicodeError):
        return True  # no such message can be sent
    return buffer.tell() > MOST_BYTES


def shoot(index, args, end, findings):
    """A client: one request after the other."""
    requests = Requests("%d.%d" % (args.seed, index), args.sensible)
    client = CommandClient(args.ns)
    choose = random.Random(args.seed * 1000 + index)
    while time.monotonic() < end and not rospy.is_shutdown():
        service = choose.choice(args.services.split(","))
        command = requests.make(service)
        if is_too_large(command):
            continue
        begin = time.monotonic()
        try:
            status = client.call(service, command).status
        except (genpy.SerializationError, UnicodeError):
            continue  # no such message can be sent
        except ServiceUnavailable as error:
            findings.add("%s gave no answer" % service, error)
            continue
        duration = time.monotonic() - begin
        findings.note(service, status.error_code, duration)
        if duration > latest_answer(service, getattr(command, "dry_run", False), args.limit):
            findings.add("%s answered late" % service, "after %.1f s: %s" % (duration, status.message))
        check_answer(service, command, status, findings)


def check_answer(service, command, status, findings):
    Status = msg.CommandStatus
    if status.status not in (Status.RUNNING, Status.FINISHED, Status.ERROR):
        findings.add("%s has a strange status" % service, status)
    if status.status != Status.ERROR:
        return
    if not status.message or not status.error_code:
        findings.add("%s does not say why" % service, status)
    if status.error_code == Status.INTERNAL_ERROR:
        findings.add("%s failed in itself" % service, status.message)
    names = list(field_names(command)) + ["~requests/", "grid"]
    if status.error_code == Status.INVALID_REQUEST and not any(name in status.message for name in names):
        findings.add("%s names no field" % service, status.message)


def again(args, *words):
    """This script once more, as a process of its own."""
    common = ["--ns", args.ns, "--limit", str(args.limit), "--stop-limit", str(args.stop_limit)]
    return subprocess.Popen([sys.executable, __file__, *common, *words])


def kill_clients(args, end):
    """Clients that do not live to see their answer."""
    chance = random.Random(args.seed)
    while time.monotonic() < end:
        victim = again(args, "--sensible", "--no-flood", "--no-stop", "--threads", "2",
                       "--services", "zone_cover,free_space", "--seed", str(chance.randint(0, 10 ** 9)))
        time.sleep(chance.uniform(0.5, 2.0))
        victim.kill()
        victim.wait()


def flood(args, end):
    """Random messages on the topics that the component listens to."""
    topics = {"routing_request": msg.RoutingRequest, "planning/command_status": msg.CommandStatus,
              "planning/state": msg.PlanningState, "canbus/chassis": msg.Chassis}
    publishers = {name: rospy.Publisher("/%s/%s" % (args.ns, name), kind, queue_size=10)
                  for name, kind in topics.items()}
    requests = Requests(args.seed, False)
    while time.monotonic() < end:
        for name, kind in topics.items():
            message = kind()
            for _ in range(3):
                requests.change(message)
            try:
                publishers[name].publish(message)
            except (genpy.SerializationError, rospy.ROSException, UnicodeError):
                pass
        time.sleep(0.002)


def move(args, end):
    """A vehicle that stands still most of the time, jumps, or is not heard of; some transforms are no numbers."""
    broadcaster, chance = tf2_ros.TransformBroadcaster(), random.Random(args.seed)
    while time.monotonic() < end:
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "map", args.base_frame
        transform.header.stamp = rospy.Time.now()
        transform.transform.rotation.w = 1.0
        place = transform.transform.translation
        place.x, place.y = CENTRE
        if not args.no_flood and chance.random() < 0.02:
            place.x, place.y = chance.choice(NUMBERS), chance.choice(NUMBERS)
            transform.header.stamp -= rospy.Duration(chance.choice([0, 2, 1000]))
        broadcaster.sendTransform(transform)
        time.sleep(1.5 if not args.no_flood and chance.random() < 0.005 else 0.02)


def only_stop(args, end):
    """Sends STOP 20 times a second, by one connection and by new ones in turn; 1 where an answer is late."""
    name = "/%s/external_command/action" % args.ns
    kept = rospy.ServiceProxy(name, Action, persistent=True)
    durations = []
    while time.monotonic() < end:
        call = kept if len(durations) % 2 else rospy.ServiceProxy(name, Action)
        begin = time.monotonic()
        status = call(msg.ActionCommand(command=msg.ActionCommand.STOP)).status
        durations.append(time.monotonic() - begin)
        if status.status == msg.CommandStatus.ERROR:
            print("STOP was refused: %s" % status.message)
            return 1
        time.sleep(0.05)
    for what, part in (("one connection", durations[1::2]), ("a new connection each", durations[0::2])):
        print("STOP, %s: %d calls, median %.1f ms, slowest %.1f ms" %
              (what, len(part), 1e3 * statistics.median(part), 1e3 * max(part)))
    return int(max(durations) > args.stop_limit)


def process_id(args):
    """Of the component; None where it does not answer."""
    node = rosservice.get_service_node("/%s/external_command/action" % args.ns)
    if node is None:
        return None
    try:
        return xmlrpc.client.ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode(node)).getPid(rospy.get_name())[2]
    except (OSError, rosgraph.MasterException):
        return None


def main():
    args = parse_arguments(rospy.myargv()[1:])
    rospy.init_node("fuzz_requests", anonymous=True, disable_signals=True)
    end = time.monotonic() + args.duration
    if args.only_stop:
        return only_stop(args, end)
    before = process_id(args)
    if before is None:
        print("no component in namespace %s; start one first, see --help" % args.ns, file=sys.stderr)
        return 2
    stop = None if args.no_stop else again(args, "--only-stop", "--duration", str(args.duration))
    findings = Findings()
    jobs = [(shoot, (i, args, end, findings)) for i in range(args.threads)] + [(move, (args, end))]
    if not args.no_flood:
        jobs += [(flood, (args, end)), (kill_clients, (args, end))]
    threads = [threading.Thread(target=job, args=arguments) for job, arguments in jobs]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if stop is not None and stop.wait() != 0:
        findings.add("STOP", "see above")
    if process_id(args) != before:
        findings.add("the component's process ended", "it had the process id %d" % before)
    return int(findings.show())


if __name__ == "__main__":
    sys.exit(main())
