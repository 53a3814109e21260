# SPDX-License-Identifier: Apache-2.0
"""The planning and control part of the simulated vehicle: carries out motion commands, speed commands and pad actions.

No ROS communication in here: messages come in by method calls, statuses collect in `statuses`, time advances by `step`.
"""

import dataclasses
import math
import re

from external_command import bicycle
from external_command.any_message import WrongType, unpack
from external_command.msg import CommandStatus, PlanningCommand, PlanningPad, SpeedCommand
from external_command.path_check import faults, start_fault
from external_command.path_legs import FORWARD, PathError, PathWithoutLength
from external_command.path_tracker import PathTracker
from external_command.plane import distance, wrap_angle

# What a pad action shows as the planner's scenario. The first two last until RESUME_CRUISE or a new motion command, the
# others for PlannerSettings.acknowledge_time: the simulator knows no lanes to change to and no missions.
STOP_SCENARIO = "EMERGENCY_STOP"
PULL_OVER_SCENARIO = "EMERGENCY_PULL_OVER"
ACKNOWLEDGED = {
    PlanningPad.FOLLOW: "LANE_FOLLOW",
    PlanningPad.CHANGE_LEFT: "CHANGE_LEFT",
    PlanningPad.CHANGE_RIGHT: "CHANGE_RIGHT",
    PlanningPad.ENTER_MISSION: "ENTER_MISSION",
    PlanningPad.EXIT_MISSION: "EXIT_MISSION",
}


@dataclasses.dataclass(frozen=True)
class PlannerSettings:
    map_frame: str = "map"
    max_start_distance: float = 25.0  # from the vehicle to the path [m]
    end_tolerance: float = 0.3  # of the position in which the vehicle stops [m]
    end_heading_tolerance: float = 0.2  # [rad]
    gear_change_time: float = 0.5  # standing [s]
    pull_over_offset: float = 1.0  # to the right of the path [m]
    pull_over_deceleration: float = 1.0  # [m/s^2]
    refuse_bad_paths: bool = False  # what path_check finds wrong; false: it is only told, and driven if that can be
    allow_tight_bends: bool = False  # these are then not wrong: commands may ask for what is beyond the vehicle
    reaction_time: float = 1.0  # between the pose that a path was planned for and its arrival here, at most [s]
    acknowledge_time: float = 2.0  # for which a pad action without motion shows as scenario [s]


class Task:
    """A motion command that is being carried out."""

    def __init__(self, command, tracker):
        self.command_id = command.command_id
        self.tracker = tracker
        self.scenario = scenario_of(command)
        self._target_speed = command.target_speed  # [m/s]; 0: not given
        self.restore_speed()

    def restore_speed(self):
        self.target_speed = self._target_speed
        self.speed_factor = 1.0

    def speed(self, limit):
        """The path's `limit` [m/s] as lowered by the commands."""
        wanted = min(limit, self.target_speed) if self.target_speed > 0.0 else limit
        return wanted * self.speed_factor


class SimulatedPlanner:
    def __init__(self, limits, settings, state):
        self.state = state
        self.gear = FORWARD
        self.statuses = []  # CommandStatus, header not filled; the owner publishes and clears them
        self.faults = []  # texts on paths that are driven although they should not be; the owner tells and clears them
        self._limits = limits
        self._settings = settings
        self._task = None
        self._hold = None  # STOP_SCENARIO, PULL_OVER_SCENARIO, or None
        self._hold_reported = True
        self._acknowledged = None  # (scenario, seconds left)
        self._shifting = 0.0  # seconds left of a gear change

    @property
    def has_task(self):
        return self._task is not None

    @property
    def is_idle(self):
        """Nothing moves, and nothing will without a new command."""
        return not self._task and not self._acknowledged and self._hold_reported and self.state.speed == 0.0

    @property
    def scenario(self):
        if self._hold:
            return self._hold
        if self._acknowledged:
            return self._acknowledged[0]
        return self._task.scenario if self._task else "IDLE"

    def accept(self, command):
        """A PlanningCommand. A motion command replaces the running one; a refused one does not."""
        if not command.is_motion_command:
            self._accept_custom(command)
            return
        try:
            task = Task(command, self._tracker_for(command))
        except PathWithoutLength as error:
            if not self._stands_at(command.path.points[-1]):
                self._report(command.command_id, CommandStatus.ERROR, str(error), CommandStatus.INVALID_REQUEST)
                return
            task = None
        except PathError as error:
            self._report(command.command_id, CommandStatus.ERROR, str(error), CommandStatus.INVALID_REQUEST)
            return
        self._task = task
        self._hold = None
        self._hold_reported = True
        if task is None:
            self._report(command.command_id, CommandStatus.FINISHED, "is there already")
        self.report_progress("")

    def refuse(self, command_id, reason):
        self._report(command_id, CommandStatus.ERROR, reason, CommandStatus.REFUSED_BY_VEHICLE)

    def accept_speed(self, command):
        """A SpeedCommand; it holds for the running motion command."""
        error = self._change_speed(command)
        if error:
            self.refuse(command.command_id, error)
        else:
            self._report(command.command_id, CommandStatus.FINISHED, "speed changed")

    def accept_pad(self, action):
        """An action of PlanningPad. Pads carry no command id: FINISHED is reported with id 0."""
        if action == PlanningPad.STOP:
            self._begin_hold(STOP_SCENARIO)
        elif action == PlanningPad.PULL_OVER:
            self._begin_hold(PULL_OVER_SCENARIO)
        elif action == PlanningPad.RESUME_CRUISE:
            self._hold = None
            self._hold_reported = True
        elif action == PlanningPad.CLEAR_PLANNING:
            self._task = None
        elif action in ACKNOWLEDGED:
            self._acknowledged = (ACKNOWLEDGED[action], self._settings.acknowledge_time)
            self._report(0, CommandStatus.FINISHED, "%s acknowledged" % ACKNOWLEDGED[action])

    def place(self, state):
        """Puts the vehicle somewhere else, standing. What it was driving ends as an error."""
        self.state = state
        self._fail("the vehicle was put somewhere else while it was driving", CommandStatus.CANCELLED)

    def step(self, dt, obstacle):
        """Drives for `dt` [s]. `obstacle`: why the chassis does not drive by itself; empty: it does."""
        speed, steering, deceleration = self._wanted_motion(dt, obstacle)
        self.state = bicycle.step(self.state, self._limits, speed, steering, deceleration, dt)
        if self._task and not obstacle and not self._hold:
            self._check_task()
        if self._hold and not self._hold_reported and self.state.speed == 0.0:
            self._hold_reported = True
            self.report_hold()
        if self._acknowledged:
            scenario, left = self._acknowledged
            self._acknowledged = (scenario, left - dt) if left > dt else None

    def report_progress(self, obstacle):
        """Reports RUNNING for the motion command, and what it waits for."""
        if not self._task:
            return
        tracker = self._task.tracker
        speed = round(self.state.speed, 1) + 0.0  # standing is not "-0.0 m/s"
        message = "driven %.1f of %.1f m, at %.1f m/s" % (tracker.driven, tracker.length, speed)
        if obstacle:
            message = "waiting: %s; %s" % (obstacle, message)
        elif self._hold:
            message = "held by %s, send START to go on; %s" % (self._hold, message)
        self._report(self._task.command_id, CommandStatus.RUNNING, message)

    def report_hold(self):
        """Reports FINISHED for STOP or PULL_OVER as long as the vehicle stands in it."""
        if self._hold and self._hold_reported:
            self._report(0, CommandStatus.FINISHED, "standing, %s" % self._hold)

    def _tracker_for(self, command):
        frame = (command.path.header.frame_id or command.header.frame_id).lstrip("/")
        if frame not in ("", self._settings.map_frame):
            raise PathError("the path is in frame %s; this vehicle drives in %s" % (frame, self._settings.map_frame))
        if not (math.isfinite(command.target_speed) and command.target_speed >= 0.0):
            raise PathError("target_speed is %s; it must be finite and not negative" % command.target_speed)
        tracker = PathTracker(command.path.points, self._limits)
        self._check_path(command)
        away = tracker.start_distance(self.state)
        if away > self._settings.max_start_distance:
            raise PathError("the path begins %.1f m from the vehicle; the limit is %.1f m (~max_start_distance)" %
                            (away, self._settings.max_start_distance))
        return tracker

    def _check_path(self, command):
        points = command.path.points
        found = faults(points, self._limits, not self._settings.allow_tight_bends)
        allowed = 0.3 + self._settings.reaction_time * abs(self.state.speed)
        found += filter(None, [start_fault(points, self.state, allowed)])
        if found and self._settings.refuse_bad_paths:
            raise PathError("the path cannot be driven as it is: " + "; ".join(found))
        self.faults += ["the path of command %d: %s" % (command.command_id, fault) for fault in found]

    def _stands_at(self, point):
        return (self.state.speed == 0.0 and
                distance((self.state.x, self.state.y), (point.x, point.y)) <= self._settings.end_tolerance and
                abs(wrap_angle(self.state.heading - point.heading)) <= self._settings.end_heading_tolerance)

    def _accept_custom(self, command):
        try:
            self.accept_speed(unpack(command.custom_command, SpeedCommand))
        except WrongType:
            pass  # a plug-in's own message: nothing a kinematic vehicle could do with it

    def _change_speed(self, command):
        """An error text, or None."""
        if not self._task:
            return "no motion command is running whose speed could be changed"
        if command.kind == SpeedCommand.TARGET_SPEED:
            if not (math.isfinite(command.target_speed) and command.target_speed > 0.0):
                return "target_speed is %s; it must be finite and above 0" % command.target_speed
            self._task.target_speed = command.target_speed
        elif command.kind == SpeedCommand.TARGET_SPEED_FACTOR:
            if not 0.0 <= command.target_speed_factor <= 1.0:
                return "target_speed_factor is %s; it must be in [0, 1]" % command.target_speed_factor
            self._task.speed_factor = command.target_speed_factor
        elif command.kind == SpeedCommand.RESTORE_TARGET_SPEED:
            self._task.restore_speed()
        else:
            return "kind is %d; 1, 2 or 3 is needed" % command.kind
        return None

    def _begin_hold(self, scenario):
        self._hold = scenario
        self._hold_reported = False

    def _wanted_motion(self, dt, obstacle):
        """(target speed, target steering, deceleration)"""
        braking = self._limits.max_deceleration
        if not self._task:
            return 0.0, self.state.steering, braking
        tracker = self._task.tracker
        pulls_over = self._hold == PULL_OVER_SCENARIO
        offset = -self._settings.pull_over_offset if pulls_over else 0.0
        control = tracker.control(self.state, dt, offset)
        if obstacle or self._hold == STOP_SCENARIO:
            return 0.0, control.steering, braking
        if pulls_over:
            return 0.0, control.steering, self._settings.pull_over_deceleration
        if not self._in_gear(tracker.gear, dt):
            return 0.0, control.steering, braking
        return tracker.gear * self._task.speed(control.speed), control.steering, braking

    def _in_gear(self, gear, dt):
        """Stops for a gear change, takes its time for it, and then is True."""
        if gear != self.gear and self.state.speed == 0.0:
            self.gear = gear
            self._shifting = self._settings.gear_change_time
        self._shifting = max(0.0, self._shifting - dt)
        return gear == self.gear and self._shifting == 0.0

    def _check_task(self):
        tracker = self._task.tracker
        if tracker.leg_done(self.state):
            if not tracker.next_leg():
                self._end_task()
        elif tracker.offset(self.state) > 1.2 * self._settings.max_start_distance:
            self._fail("the vehicle is %.1f m from its path" % tracker.offset(self.state), CommandStatus.INTERNAL_ERROR)

    def _end_task(self):
        position, heading = self._task.tracker.end_error(self.state)
        text = "%.3f m and %.2f deg from the end of the path" % (position, math.degrees(heading))
        if position > self._settings.end_tolerance or heading > self._settings.end_heading_tolerance:
            self._fail("stopped " + text, CommandStatus.INTERNAL_ERROR)
            return
        self._report(self._task.command_id, CommandStatus.FINISHED, "arrived, " + text)
        self._task = None

    def _fail(self, message, error_code):
        if self._task:
            self._report(self._task.command_id, CommandStatus.ERROR, message, error_code)
        self._task = None

    def _report(self, command_id, status, message, error_code=CommandStatus.OK):
        self.statuses.append(CommandStatus(command_id=command_id, status=status, message=message,
                                           error_code=error_code))


def scenario_of(command):
    """The planner's scenario for a PlanningCommand: VALET_PARKING, LANE_FOLLOW, or by the type of its custom command,
    so that external_command/ZoneCoverCommand gives ZONE_COVER."""
    if command.command_type == PlanningCommand.PARKING:
        return "VALET_PARKING"
    name = command.custom_command.type.split("/")[-1]
    if not name:
        return "LANE_FOLLOW"
    name = name[:-len("Command")] if name.endswith("Command") else name
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).upper()
