# SPDX-License-Identifier: Apache-2.0
"""What can go wrong with a command, as exceptions of CommandClient.

    ServiceUnavailable        no answer: nothing is known of the command
    CommandError              has .status (CommandStatus), .command_id, .code (CommandStatus.NO_ROUTE ...), .code_name
      RefusedCommand          answered with an error: nothing has changed; a class of its own for each code
        InvalidRequest, StaleRequest, DuplicateId, UnknownId, NotReady, OffMap, NoRoute, StartBlocked, GoalBlocked,
        NoPath, PlanningTimeout, Cancelled, Superseded, RefusedByVehicle, InternalError
      CommandFailed           was carried out, and ended as an error
        CommandCancelled      ... since somebody cancelled or cleared it, or stopped
        CommandSuperseded     ... since a newer motion command took its place
      LostCommand             the gateway does not know it (any more): was it started anew?
      StillRunning            a TimeoutError: it was not waited for any longer
"""

from external_command.msg import CommandStatus

STATUS_NAMES = {CommandStatus.RUNNING: "RUNNING", CommandStatus.FINISHED: "FINISHED",
                CommandStatus.ERROR: "ERROR", CommandStatus.UNKNOWN: "UNKNOWN"}
ERROR_NAMES = {getattr(CommandStatus, name): name for name in (
    "OK INVALID_REQUEST STALE_REQUEST DUPLICATE_ID UNKNOWN_ID NOT_READY OFF_MAP NO_ROUTE START_BLOCKED GOAL_BLOCKED "
    "NO_PATH PLANNING_TIMEOUT CANCELLED SUPERSEDED REFUSED_BY_VEHICLE INTERNAL_ERROR").split()}


class ServiceUnavailable(RuntimeError):
    """A service or topic is not there, or the call broke off; the text names it. Nothing is known of the command."""


class CommandError(Exception):
    """The text is one line for a person; `status` holds the same for a program."""

    def __init__(self, status):
        super().__init__(describe(status))
        self.status = status

    @property
    def command_id(self):
        return self.status.command_id

    @property
    def code(self):
        """A constant of CommandStatus."""
        return self.status.error_code

    @property
    def code_name(self):
        return ERROR_NAMES.get(self.code, str(self.code))


class RefusedCommand(CommandError):
    """The command was answered with an error, and has changed nothing."""


class InvalidRequest(RefusedCommand):
    """A value of the request is wrong; the text names the field, the value and what was expected."""


class StaleRequest(RefusedCommand):
    """The stamp of a speed or chassis command is too old."""


class DuplicateId(RefusedCommand):
    """Another command with this id runs."""


class UnknownId(RefusedCommand):
    """Something that the request names by its id does not exist."""


class NotReady(RefusedCommand):
    """Map, pose, chassis or planner are missing, or the gateway is busy; CommandClient.unmet() tells what is missing."""


class OffMap(RefusedCommand):
    """A pose lies too far from all lanes."""


class NoRoute(RefusedCommand):
    """No lanes lead there."""


class StartBlocked(RefusedCommand):
    """The vehicle stands in an obstacle, or outside of where it may drive."""


class GoalBlocked(RefusedCommand):
    """The vehicle would not fit where it is sent."""


class NoPath(RefusedCommand):
    """The vehicle cannot be driven there."""


class PlanningTimeout(RefusedCommand):
    """No path was found in the time for planning."""


class Cancelled(RefusedCommand):
    """Somebody stopped, cleared or cancelled it while it was planned."""


class Superseded(RefusedCommand):
    """A newer command came while it was planned."""


class RefusedByVehicle(RefusedCommand):
    """The planner or the chassis did not take it."""


class InternalError(RefusedCommand):
    """A fault of the gateway; its log tells more."""


class CommandFailed(CommandError):
    """The command was accepted, and ended as an error."""


class CommandCancelled(CommandFailed):
    """Somebody stopped, cleared or cancelled it."""


class CommandSuperseded(CommandFailed):
    """A newer motion command took its place."""


class LostCommand(CommandError):
    """The gateway does not know the command: it never did, or was started anew, or 1,000 others came since."""


class StillRunning(CommandError, TimeoutError):
    """The command runs, and was not waited for any longer."""


_REFUSALS = {CommandStatus.INVALID_REQUEST: InvalidRequest, CommandStatus.STALE_REQUEST: StaleRequest,
             CommandStatus.DUPLICATE_ID: DuplicateId, CommandStatus.UNKNOWN_ID: UnknownId,
             CommandStatus.NOT_READY: NotReady, CommandStatus.OFF_MAP: OffMap, CommandStatus.NO_ROUTE: NoRoute,
             CommandStatus.START_BLOCKED: StartBlocked, CommandStatus.GOAL_BLOCKED: GoalBlocked,
             CommandStatus.NO_PATH: NoPath, CommandStatus.PLANNING_TIMEOUT: PlanningTimeout,
             CommandStatus.CANCELLED: Cancelled, CommandStatus.SUPERSEDED: Superseded,
             CommandStatus.REFUSED_BY_VEHICLE: RefusedByVehicle, CommandStatus.INTERNAL_ERROR: InternalError}
_FAILURES = {CommandStatus.CANCELLED: CommandCancelled, CommandStatus.SUPERSEDED: CommandSuperseded}


def raise_refusal(status):
    """Raises the RefusedCommand for the answer to a request, where it is one."""
    if status.status == CommandStatus.UNKNOWN:
        raise LostCommand(status)
    if status.status == CommandStatus.ERROR:
        raise _REFUSALS.get(status.error_code, RefusedCommand)(status)


def raise_failure(status):
    """Raises the CommandError for the status of a command that was waited for, unless it is FINISHED."""
    if status.status == CommandStatus.RUNNING:
        raise StillRunning(status)
    if status.status == CommandStatus.UNKNOWN:
        raise LostCommand(status)
    if status.status == CommandStatus.ERROR:
        raise _FAILURES.get(status.error_code, CommandFailed)(status)


def accepted(status):
    """True for RUNNING and FINISHED."""
    return status.status in (CommandStatus.RUNNING, CommandStatus.FINISHED)


def describe(status):
    """One line for a person."""
    text = "command %d %s" % (status.command_id, STATUS_NAMES.get(status.status, status.status))
    if status.error_code:
        text += " (%s)" % ERROR_NAMES.get(status.error_code, status.error_code)
    text += ": " + status.message if status.message else ""
    is_driven = status.has_progress and status.status == CommandStatus.RUNNING
    return text + (" [%s]" % describe_progress(status) if is_driven else "")


def describe_progress(status):
    """"42 %, 120.0 m and 15 s left"; of a status that has progress."""
    return "%.0f %%, %.1f m and %.0f s left" % (100.0 * status.share_done, status.distance_left, status.time_left)
