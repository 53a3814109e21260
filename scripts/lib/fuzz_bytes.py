# SPDX-License-Identifier: Apache-2.0
"""Requests and messages as bytes: damaged, cut off, and with counts that lie; handshakes that are none; deep calls."""
import io
import random
import socket
import struct
import time
import xmlrpc.client

import genpy
import rosgraph
import rospy
import rosservice
from geometry_msgs.msg import Point

from answer_times import ANSWER_LIMIT, latest_answer
from external_command import msg
from external_command.client import SERVICES, polygon, pose

COUNTS = [0xffffffff, 0x80000000, 0x7fffffff, 0x20000001, 0x10000001, 100000000, 1000000, 65536, 255]


def example(service):
    """A sensible command with something in every list."""
    square = polygon([(80.0, 180.0), (120.0, 180.0), (120.0, 220.0), (80.0, 220.0)])
    hole = polygon([(100.0, 200.0), (103.0, 200.0), (103.0, 203.0), (100.0, 203.0)])
    make = {
        "lane_follow": lambda: msg.LaneFollowCommand(
            end_pose=pose(478.0, 338.25), way_point=[pose(100.0, 195.0)], blacklisted_road=["a", "b"],
            blacklisted_lane=[msg.LaneSegment("c", 0.0, 1.0)], dry_run=True),
        "valet_parking": lambda: msg.ValetParkingCommand(parking_spot_id="n_out_5", dry_run=True),
        "action": lambda: msg.ActionCommand(command=6),
        "free_space": lambda: msg.FreeSpaceCommand(
            parking_spot_pose=pose(110.0, 190.0, 0.0), drivable_roi=square, non_drivable_roi=[hole], dry_run=True),
        "path_follow": lambda: msg.PathFollowCommand(
            way_point=[Point(100.0 + 5.0 * i, 195.0, 0.0) for i in range(5)], dry_run=True),
        "speed": lambda: msg.SpeedCommand(kind=3),
        "chassis": lambda: msg.ChassisCommand(
            custom_operation=msg.Any(type="a/B", md5sum="0" * 32, data=b"some data")),
        "precise_parking": lambda: msg.PreciseParkingCommand(parking_spot_pose=pose(322.0, 110.0, 0.0), dry_run=True),
        "zone_cover": lambda: msg.ZoneCoverCommand(drivable_roi=square, non_drivable_roi=[hole], dry_run=True),
    }
    command = make[service]()
    command.header.frame_id = "map"
    return command


def example_goal(service):
    """The same as a goal of the action beside the service."""
    name = "".join(word.capitalize() for word in service.split("_"))
    goal = getattr(msg, name + "ActionGoal")()
    goal.goal_id.id = "a goal"
    goal.goal.command = example(service)
    return goal


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def damaged(data, chance):
    """`data` with a few changes."""
    data = bytearray(data)
    for _ in range(chance.choice([1, 1, 1, 2, 3, 8])):
        kind, at = chance.random(), chance.randrange(len(data) or 1)
        if kind < 0.4:
            data[at:at + 4] = struct.pack("<I", chance.choice(COUNTS))
        elif kind < 0.6:
            data[at:at + 1] = bytes([chance.getrandbits(8)])
        elif kind < 0.7:
            del data[at:]
        elif kind < 0.8:
            data[at:at] = chance.randbytes(chance.choice([1, 4, 100])) if hasattr(chance, "randbytes") else b"\0" * 4
        elif kind < 0.9:
            data[at:at + 8] = struct.pack("<d", chance.choice([float("nan"), float("inf"), 1e308, -1e308, 1e-300]))
        else:
            data[at:at] = data[:chance.randrange(200)]
    return bytes(data)


def frame(fields):
    """A header of TCPROS."""
    lines = b"".join(struct.pack("<I", len(field)) + field for field in fields)
    return struct.pack("<I", len(lines)) + lines


class RawCaller:
    """One connection to a service, or one for each call, for requests that are only bytes."""

    def __init__(self, name, service_class, persistent=True):
        self._persistent = persistent
        self._address = rosservice.get_service_uri(name)
        self._name = name
        self._class = service_class
        self._socket = None

    def _connect(self):
        host, port = self._address[len("rosrpc://"):].rsplit(":", 1)
        self._socket = socket.create_connection((host, int(port)), ANSWER_LIMIT)
        self._socket.settimeout(latest_answer("zone_cover"))
        self._socket.sendall(frame([b"service=" + self._name.encode(), b"md5sum=" + self._class._md5sum.encode(),
                                    b"callerid=/raw", b"persistent=%d" % self._persistent]))
        self._take(struct.unpack("<I", self._take(4))[0])

    def _take(self, size):
        data = b""
        while len(data) < size:
            part = self._socket.recv(size - len(data))
            if not part:
                raise ConnectionError("the connection was closed")
            data += part
        return data

    def close(self):
        if self._socket is not None:
            self._socket.close()
        self._socket = None

    def call(self, data):
        """The response. Raises OSError where none comes."""
        if self._socket is None:
            self._connect()
        self._socket.sendall(struct.pack("<I", len(data)) + data)
        is_ok = self._take(1) == b"\1"
        answer = self._take(struct.unpack("<I", self._take(4))[0])
        if not self._persistent:
            self.close()
        if not is_ok:
            raise OSError("the service failed: %r" % answer[:200])
        response = self._class._response_class()
        response.deserialize(answer)
        return response


def shoot_bytes(seed, end, findings, services=tuple(sorted(SERVICES))):
    """Damaged requests until `end`; findings: as that of fuzz_requests."""
    chance = random.Random(seed)
    callers, examples = {}, {}
    for service in services:
        callers[service] = RawCaller("/apollo/external_command/" + service, SERVICES[service][0])
        examples[service] = serialized(SERVICES[service][0]._request_class(example(service)))
    while time.monotonic() < end:
        service = chance.choice(services)
        data = damaged(examples[service], chance)
        begin = time.monotonic()
        try:
            status = callers[service].call(data).status
        except (OSError, genpy.DeserializationError, UnicodeDecodeError) as error:
            findings.add("%s gave no answer to bytes" % service, "%s to %s" % (error, data.hex()))
            callers[service].close()
            time.sleep(0.05)
            continue
        duration = time.monotonic() - begin
        findings.note("bytes to " + service, status.error_code, duration)
        if duration > latest_answer(service):
            findings.add("%s answered bytes late" % service, "after %.1f s: %s; to %s" % (duration, status.message,
                                                                                         data.hex()))
        if status.error_code == msg.CommandStatus.INTERNAL_ERROR:
            findings.add("%s failed in itself" % service, "%s; to %s" % (status.message, data.hex()))
    for caller in callers.values():
        caller.close()


def shake_hands_badly(seed, end, findings):
    """Connections whose first bytes are no header, or a damaged one, until `end`."""
    chance = random.Random(seed)
    name = "/apollo/external_command/speed"
    host, port = rosservice.get_service_uri(name)[len("rosrpc://"):].rsplit(":", 1)
    good = frame([b"service=" + name.encode(), b"md5sum=*", b"callerid=/bad"])
    while time.monotonic() < end:
        begin = time.monotonic()
        try:
            with socket.create_connection((host, int(port)), ANSWER_LIMIT) as connection:
                connection.sendall(damaged(good, chance))
        except OSError as error:
            findings.add("no connection was taken", error)
        findings.note("handshake", 0, time.monotonic() - begin)
        time.sleep(0.005)


def nested_call(depth):
    """The body of an XML-RPC call whose argument nests so many values."""
    return xmlrpc.client.dumps(("VALUES",), "getPid").replace(
        "<value><string>VALUES</string></value>",
        "<value><array><data>" * depth + "</data></array></value>" * depth).encode()


def call_damaged(seed, end, findings):
    """XML-RPC calls of the node that nest deep, which are answered, or are damaged, until `end`."""
    chance = random.Random(seed)
    host, port = rosgraph.Master(rospy.get_name()).lookupNode(
        "/apollo/external_command")[len("http://"):].rstrip("/").rsplit(":", 1)
    while time.monotonic() < end:
        body = nested_call(chance.choice([1, 50, 200, 10000, 200000]))
        is_damaged = chance.random() < 0.5
        if is_damaged:
            body = damaged(body[:2000], chance)
        begin = time.monotonic()
        try:
            with socket.create_connection((host, int(port)), ANSWER_LIMIT) as connection:
                connection.sendall(b"POST / HTTP/1.1\r\nContent-Length: %d\r\n\r\n" % len(body) + body)
                if not is_damaged:
                    connection.recv(100)
        except OSError as error:
            findings.add("XML-RPC gave no answer", error)
        findings.note("XML-RPC call", 0, time.monotonic() - begin)
        time.sleep(0.1)


class RawMessage(genpy.Message):
    """Bytes that are published as a message of some type."""
    __slots__ = ["data"]
    _slot_types = ["uint8[]"]
    _has_header = False

    def serialize(self, buff):
        buff.write(self.data)


def raw_class(message_class):
    """A class of RawMessages that says to be `message_class`."""
    return type("Raw" + message_class.__name__, (RawMessage,), {
        "__slots__": ["data"], "_type": message_class._type, "_md5sum": message_class._md5sum,
        "_full_text": message_class._full_text})


def publish_bytes(seed, end, topics, findings, is_left_alone=lambda name: False):
    """Damaged messages until `end`. `topics`: {name: example message}; `is_left_alone(name)`: not now."""
    chance = random.Random(seed)
    publishers, classes, examples = {}, {}, {}
    for name, message in topics.items():
        classes[name] = raw_class(type(message))
        publishers[name] = rospy.Publisher(name, classes[name], queue_size=10)
        examples[name] = serialized(message)
    while time.monotonic() < end:
        for name, publisher in publishers.items():
            if is_left_alone(name):
                continue
            message = classes[name](data=damaged(examples[name], chance))
            publisher.publish(message)
            findings.note("bytes on " + name, 0, 0.0)
        time.sleep(0.005)
