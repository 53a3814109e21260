# SPDX-License-Identifier: Apache-2.0
"""What the tests of the running system share: deadlines instead of sleeps."""
import contextlib
import threading
import time
import traceback
import unittest
import xmlrpc.client

import rosgraph
import rospy
from rosgraph_msgs.msg import Log

from external_command.client import STATUS_NAMES, NotReady, describe  # noqa: F401  (tests call support.describe)
from external_command.msg import CommandStatus
from external_command.srv import GetCommandStatus

DEADLINE = 30.0  # [s] of wall time; what is late by that much does not come


class TestCase(unittest.TestCase):
    """As unittest's, but a failed subTest fails its test in words: rosunit counts one, and shows its test as passed."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self._failed_parts = []

    @contextlib.contextmanager
    def subTest(self, msg=None, **params):
        try:
            yield
        except unittest.SkipTest:
            raise
        except Exception:
            if not self._failed_parts:
                self.addCleanup(self._tell_failed_parts)
            words = ([] if msg is None else [str(msg)]) + ["%s=%r" % item for item in params.items()]
            self._failed_parts.append("[%s]\n%s" % (", ".join(words), traceback.format_exc()))

    def _tell_failed_parts(self):
        parts, self._failed_parts = self._failed_parts, []
        self.fail("failed in %d subTests:\n%s" % (len(parts), "\n".join(parts)))


def service(name, service_type):
    """A proxy of a service that is there."""
    rospy.wait_for_service(name, timeout=DEADLINE)
    return rospy.ServiceProxy(name, service_type)


def wait_until_ready(client):
    """Waits until the gateway of a CommandClient in the demo town knows the vehicle's pose."""
    def is_ready():
        try:
            return client.lane_follow(x=300.0, y=195.0, dry_run=True)
        except NotReady:
            return False
    wait_until(is_ready, "the vehicle is known")


def pid_of(node):
    """Of a node that is up; None for one that is not."""
    try:
        uri = rosgraph.Master(rospy.get_name()).lookupNode(node)
        return xmlrpc.client.ServerProxy(uri).getPid(rospy.get_name())[2]
    except (OSError, rosgraph.MasterException):
        return None


def wait_until(condition, what, deadline=DEADLINE):
    """Waits for `condition()` to be true; an AssertionError that says `what` did not happen where it stays false.

    `what`: words, or a function that has them at the end.
    """
    end = time.monotonic() + deadline
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("not within %.0f s: %s" % (deadline, what() if callable(what) else what))
        time.sleep(0.01)


def command_status(command_id, name="external_command/command_status"):
    """What the status service says of a command."""
    return service(name, GetCommandStatus)(command_id=command_id).status


def wait_for_status(command_id, wanted, name="external_command/command_status", deadline=DEADLINE):
    """Waits until the command has the status `wanted`; returns it."""
    end = time.monotonic() + deadline
    while True:
        status = command_status(command_id, name)
        if status.status == wanted:
            return status
        if status.status in (CommandStatus.FINISHED, CommandStatus.ERROR) or time.monotonic() > end:
            raise AssertionError("wanted %s, got %s" % (STATUS_NAMES[wanted], describe(status)))
        time.sleep(0.05)


class Collector:
    """Every message of a topic since its making, the connection made before the constructor returns."""

    def __init__(self, topic, message_type, connected=True):
        self._lock = threading.Lock()
        self._messages = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._add)
        if connected:
            wait_until(lambda: self._subscriber.get_num_connections() > 0, "a publisher of " + topic)
            time.sleep(0.02)  # roscpp answers a new subscriber a moment before it sends it anything

    def _add(self, message):
        with self._lock:
            self._messages.append(message)

    @property
    def messages(self):
        with self._lock:
            return list(self._messages)

    def wait_for(self, matches, what):
        """The first message for which `matches(message)` is true."""
        wait_until(lambda: any(matches(message) for message in self.messages), what)
        return next(message for message in self.messages if matches(message))

    def hears(self, node):
        """Whether the connection to the publisher `node` is made."""
        heads = [getattr(link, "header", None) or {} for link in self._subscriber.impl.connections]
        return any(head.get("callerid") == node for head in heads)

    def close(self):
        self._subscriber.unregister()


def log_of(node):
    """A Collector of what the node, and everybody else, writes to the log from now on."""
    log = Collector("/rosout", Log, connected=False)
    wait_until(lambda: log.hears(node), "the log of " + node)
    time.sleep(0.02)  # as above
    return log
