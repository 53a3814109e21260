# SPDX-License-Identifier: Apache-2.0
"""A client of the command services.

    rospy.init_node("my_program")
    client = CommandClient("apollo")
    response = client.call("lane_follow", LaneFollowCommand(end_pose=pose(120.0, 45.0)))
    if accepted(response.status):
        status = client.wait(response.status.command_id, timeout=300.0)
"""

import math
import time

import rospy
from geometry_msgs.msg import Point

from external_command import msg, srv

# name: (service type, command type)
SERVICES = {
    "lane_follow": (srv.LaneFollow, msg.LaneFollowCommand),
    "valet_parking": (srv.ValetParking, msg.ValetParkingCommand),
    "action": (srv.Action, msg.ActionCommand),
    "free_space": (srv.FreeSpace, msg.FreeSpaceCommand),
    "path_follow": (srv.PathFollow, msg.PathFollowCommand),
    "speed": (srv.Speed, msg.SpeedCommand),
    "chassis": (srv.ChassisControl, msg.ChassisCommand),
    "precise_parking": (srv.PreciseParking, msg.PreciseParkingCommand),
    "zone_cover": (srv.ZoneCover, msg.ZoneCoverCommand),
}
STATUS_SERVICE = "command_status"

STATUS_NAMES = {msg.CommandStatus.RUNNING: "RUNNING", msg.CommandStatus.FINISHED: "FINISHED",
                msg.CommandStatus.ERROR: "ERROR", msg.CommandStatus.UNKNOWN: "UNKNOWN"}
ERROR_NAMES = {getattr(msg.CommandStatus, name): name for name in (
    "OK INVALID_REQUEST STALE_REQUEST DUPLICATE_ID UNKNOWN_ID NOT_READY OFF_MAP NO_ROUTE START_BLOCKED GOAL_BLOCKED "
    "NO_PATH PLANNING_TIMEOUT CANCELLED SUPERSEDED REFUSED_BY_VEHICLE INTERNAL_ERROR").split()}


class ServiceUnavailable(RuntimeError):
    """A service is not there or the call broke off; the text names it. Nothing is known of the command then."""


class CommandClient:
    """Calls the services of the gateway in `namespace`. Needs an initialized node."""

    def __init__(self, namespace="apollo", timeout=5.0):
        """`timeout` [s]: how long a call waits for its service to be there."""
        self._namespace = namespace.rstrip("/")
        self._timeout = timeout

    def call(self, service, command):
        """Sends `command`, whose stamp is filled where it is 0, to a service of SERVICES; the service's response.

        A refused command is no exception: `response.status` tells. Raises ServiceUnavailable.
        """
        service_class, command_class = SERVICES[service]
        if not isinstance(command, command_class):
            raise TypeError("the service %s takes a %s, not a %s" %
                            (service, command_class.__name__, type(command).__name__))
        if command.header.stamp.is_zero():
            command.header.stamp = rospy.Time.now()
        return self._call(service, service_class, command)

    def status(self, command_id):
        """The CommandStatus of a command. Raises ServiceUnavailable."""
        return self._call(STATUS_SERVICE, srv.GetCommandStatus, command_id).status

    def wait(self, command_id, timeout=math.inf, progress=None, period=0.2):
        """Asks for the status every `period` [s] until it is no longer RUNNING or `timeout` [s] has passed.

        Returns the last one. `progress`, where given, is called with each. Raises ServiceUnavailable.
        """
        end = time.monotonic() + timeout
        while True:
            status = self.status(command_id)
            if progress:
                progress(status)
            if status.status != msg.CommandStatus.RUNNING or time.monotonic() >= end or rospy.is_shutdown():
                return status
            time.sleep(period)

    def _call(self, service, service_class, request):
        name = rospy.resolve_name("%s/external_command/%s" % (self._namespace, service))
        try:
            rospy.wait_for_service(name, self._timeout)
            return rospy.ServiceProxy(name, service_class)(request)
        except rospy.ROSException as error:
            raise ServiceUnavailable("no service %s within %.1f s: is the gateway running in namespace %s?" %
                                     (name, self._timeout, self._namespace)) from error
        except (rospy.ServiceException, rospy.exceptions.TransportException) as error:
            raise ServiceUnavailable("the call of %s failed: %s" % (name, error)) from error


def accepted(status):
    """True for RUNNING and FINISHED."""
    return status.status in (msg.CommandStatus.RUNNING, msg.CommandStatus.FINISHED)


def pose(x, y, heading=None):
    """An external_command/Pose; without a heading any will do."""
    return msg.Pose(x=x, y=y, heading=heading or 0.0, has_heading=heading is not None)


def polygon(points):
    """An external_command/RoiPolygon of (x, y)."""
    return msg.RoiPolygon(points=[Point(x, y, 0.0) for x, y in points])


def describe(status):
    """One line for a person."""
    text = "command %d %s" % (status.command_id, STATUS_NAMES.get(status.status, status.status))
    if status.error_code:
        text += " (%s)" % ERROR_NAMES.get(status.error_code, status.error_code)
    return text + (": " + status.message if status.message else "")
