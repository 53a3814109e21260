# SPDX-License-Identifier: Apache-2.0
"""A client of the command services; doc/python_client.md has an example of everything.

    rospy.init_node("my_program")
    client = CommandClient("apollo")
    command = client.lane_follow(x=120.0, y=45.0)  # raises RefusedCommand
    command.wait(timeout=300.0)                    # raises CommandFailed
"""

import functools
import math
import time

import rospy
from geometry_msgs.msg import Point

import external_command.old_rospy  # noqa: F401
from external_command import commands, msg, srv
from external_command.commands import pose, polygon  # noqa: F401  (for who imports them from here)
from external_command.errors import (  # noqa: F401  (the exceptions are used from here)
    ERROR_NAMES, STATUS_NAMES, Cancelled, CommandCancelled, CommandError, CommandFailed, CommandSuperseded, DuplicateId,
    GoalBlocked, InternalError, InvalidRequest, LostCommand, NoPath, NoRoute, NotReady, OffMap, PlanningTimeout,
    RefusedByVehicle, RefusedCommand, ServiceUnavailable, StaleRequest, StartBlocked, StillRunning, Superseded,
    UnknownId, accepted, describe, describe_progress, raise_failure, raise_refusal)

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
_SERVICE_OF = {command_class: name for name, (_, command_class) in SERVICES.items()}


class Command:
    """A command that was accepted.

    `id`; `status`: the last CommandStatus heard; `report`: the PlanReport of a motion command, else None; `path`: the
    PlannedPath of a dry run, else empty or None.
    """

    def __init__(self, client, response):
        self._client = client
        self.status = response.status
        self.report = getattr(response, "report", None)
        self.path = getattr(response, "path", None)

    @property
    def id(self):
        return self.status.command_id

    def refresh(self):
        """Asks for the status and returns it. Raises ServiceUnavailable."""
        self.status = self._client.status(self.id)
        return self.status

    def wait(self, timeout=math.inf, progress=None, period=0.2):
        """Until it is FINISHED; returns that status. `progress`, where given, is called with each status that is asked.

        Raises CommandFailed where it ends otherwise, StillRunning after `timeout` [s], LostCommand, ServiceUnavailable.
        """
        if self.status.status == msg.CommandStatus.RUNNING:
            self.status = self._client.wait(self.id, timeout, progress, period)
        raise_failure(self.status)
        return self.status

    def cancel(self):
        """Ends this command and no other; True where it was running. Raises ServiceUnavailable."""
        answer = self._client.cancel(self.id)
        self.status = answer.status
        return answer.was_running


class MapObjects(list):
    """The MapObject messages that were asked for; `total_count` is of those that match, however few are listed."""

    def __init__(self, response):
        super().__init__(response.objects)
        self.total_count = response.total_count


def _sends(build):
    @functools.wraps(build)
    def method(self, *args, **kwargs):
        return self.send(build(*args, **kwargs))
    method.__doc__ = build.__doc__.rstrip() + "\n\n    Returns the Command. Raises RefusedCommand, ServiceUnavailable."
    return method


def _acts(name):
    def method(self, id=0):
        return self.action(name, id=id)
    method.__doc__ = "The action %s. Returns the Command. Raises RefusedCommand, ServiceUnavailable." % name
    return method


class CommandClient:
    """Calls the services of the gateway in `namespace`. Needs an initialized node. May be used by several threads.

    A call of a command returns as soon as it is accepted: a Command, which can be waited for and cancelled.
    """

    def __init__(self, namespace="apollo", timeout=5.0):
        """`timeout` [s]: how long a call waits for its service to be there."""
        self._namespace = namespace.rstrip("/")
        self._timeout = timeout

    lane_follow = _sends(commands.lane_follow)
    valet_parking = _sends(commands.valet_parking)
    precise_parking = _sends(commands.precise_parking)
    free_space = _sends(commands.free_space)
    path_follow = _sends(commands.path_follow)
    zone_cover = _sends(commands.zone_cover)
    speed = _sends(commands.speed)
    chassis = _sends(commands.chassis)
    action = _sends(commands.action)
    stop = _acts("stop")
    start = _acts("start")
    clear = _acts("clear-planning")
    follow = _acts("follow")
    pull_over = _acts("pull-over")
    change_left = _acts("change-left")
    change_right = _acts("change-right")
    switch_to_auto = _acts("switch-to-auto")
    switch_to_manual = _acts("switch-to-manual")

    def send(self, command):
        """Sends a command message of any of the SERVICES. Returns the Command.

        Raises RefusedCommand, by the error code one of its subclasses, where it is answered with an error, and
        ServiceUnavailable.
        """
        if type(command) not in _SERVICE_OF:
            raise TypeError("a %s is no command" % type(command).__name__)
        response = self.call(_SERVICE_OF[type(command)], command)
        raise_refusal(response.status)
        return Command(self, response)

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

    def cancel(self, command_id):
        """Ends one command and no other; the response: `was_running`, and its `status` now, UNKNOWN where there is none.

        Raises ServiceUnavailable.
        """
        return self._call("cancel_command", srv.CancelCommand, command_id)

    def current(self):
        """What runs: `motion`, the status of the motion command that is driven or was last, and `running`, of all
        commands that run, the newest last. Raises ServiceUnavailable."""
        return self._call("current_command", srv.GetCurrentCommand)

    def map_objects(self, kind=None, id="", near=None, radius=0.0, max_count=0):
        """What a command can name: MapObjects of a kind of commands.MAP_OBJECTS ("lanes", "roads", "spaces", "areas"),
        or of any; the one with this id; or the nearest to the point `near`, within `radius` [m] where that is not 0.

        At most `max_count`, 100 where that is 0. Raises NotReady without a map, UnknownId, InvalidRequest,
        ServiceUnavailable.
        """
        if kind is not None and kind not in commands.MAP_OBJECTS:
            raise ValueError("kind is %r; it must be one of %s" % (kind, ", ".join(sorted(commands.MAP_OBJECTS))))
        request = srv.FindMapObjectsRequest(kind=commands.MAP_OBJECTS.get(kind, 0), id=id, is_near=near is not None,
                                            radius=radius, max_count=max_count)
        if near is not None:
            request.point = Point(near[0], near[1], 0.0)
        response = self._call("map_objects", srv.FindMapObjects, request)
        if response.error_code:
            raise_refusal(msg.CommandStatus(status=msg.CommandStatus.ERROR, error_code=response.error_code,
                                            message=response.error_message))
        return MapObjects(response)

    def readiness(self):
        """The newest external_command/Readiness: what the gateway has, and what it lacks. Raises ServiceUnavailable."""
        name = self._resolved("readiness")
        try:
            return rospy.wait_for_message(name, msg.Readiness, self._timeout)
        except rospy.ROSException as error:
            raise ServiceUnavailable("nothing on topic %s within %.1f s: is the gateway running in namespace %s?" %
                                     (name, self._timeout, self._namespace or "/")) from error

    def unmet(self, service=None):
        """The ReadinessConditions that are not met: of a service, "lane_follow", or of any. Raises ServiceUnavailable."""
        return [condition for condition in self.readiness().conditions
                if not condition.is_met and (service is None or service in condition.needed_by)]

    def _resolved(self, name):
        return rospy.resolve_name("%s/external_command/%s" % (self._namespace, name))

    def _call(self, service, service_class, *request):
        name = self._resolved(service)
        try:
            rospy.wait_for_service(name, self._timeout)
            return rospy.ServiceProxy(name, service_class)(*request)
        except rospy.ROSException as error:
            raise ServiceUnavailable("no service %s within %.1f s: is the gateway running in namespace %s?" %
                                     (name, self._timeout, self._namespace or "/")) from error
        except (rospy.ServiceException, rospy.exceptions.TransportException) as error:
            raise ServiceUnavailable("the call of %s failed: %s" % (name, error)) from error
