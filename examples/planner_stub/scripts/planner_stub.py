#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a planning module owes external_command: it drives what it is sent, reports, and stops. The way itself is only
counted, by Controller, whose place your own takes.
"""
import threading

import rospy
from external_command.msg import CommandStatus, PlanningCommand, PlanningPad, PlanningState, SpeedCommand

RATE = 10.0  # of reports, and of the controller [Hz]
CREEPING = 0.1  # [m/s]
MAX_AGE = 5.0  # a command that was sent longer before this node started is not driven any more [s]
HOLDS = {PlanningPad.STOP: "EMERGENCY_STOP", PlanningPad.PULL_OVER: "EMERGENCY_PULL_OVER"}


class Controller:
    """Your controller takes its place. This one moves nothing: it counts the metres along the path, at the path's speeds,
    and stands as soon as it is not called."""

    def __init__(self, path, target_speed):
        self.driven = 0.0  # [m]
        self._points = path.points
        self._next = 1  # the point that is driven to
        self._commanded_speed = target_speed  # [m/s]; 0: as the path says
        self.restore_speed()

    @property
    def length(self):
        return self._points[-1].s

    @property
    def has_arrived(self):
        return self._next == len(self._points)

    def restore_speed(self):
        self.target_speed = self._commanded_speed
        self.speed_factor = 1.0

    def drive(self, seconds):
        while seconds > 0.0 and not self.has_arrived and self.speed_factor > 0.0:
            point = self._points[self._next]
            step = min(seconds, (point.s - self.driven) / self._speed())
            self.driven += step * self._speed()
            seconds -= step
            if seconds > 0.0:
                self.driven = point.s
                self._next += 1

    def _speed(self):
        """The speeds of the path are limits; 0 is where it ends, or changes the gear and goes on."""
        limit = max(self._points[self._next - 1].speed, self._points[self._next].speed, CREEPING)
        return self.speed_factor * (min(limit, self.target_speed) if self.target_speed > 0.0 else limit)


def is_earlier(stamp, other):
    """No where one is missing, or is ahead of a clock that was set back: a stop then counts."""
    return rospy.Time() < stamp < other <= rospy.Time.now()


class PlannerStub:
    def __init__(self):
        self._lock = threading.Lock()
        self._started = rospy.Time.now()
        self._command_id = 0  # of the motion command that is driven
        self._sent = rospy.Time()  # its stamp
        self._controller = None  # while there is one
        self._hold = None  # STOP or PULL_OVER of PlanningPad
        self._last_stop = None  # the newest STOP or CLEAR_PLANNING that no START has lifted
        self._seen = None  # (id, stamp) of the last command
        self._reports = rospy.Publisher("planning/command_status", CommandStatus, queue_size=100)
        self._state = rospy.Publisher("planning/state", PlanningState, queue_size=10, latch=True)
        rospy.Subscriber("planning/command", PlanningCommand, self._on_command)
        rospy.Subscriber("planning/pad", PlanningPad, self._on_pad)
        rospy.Subscriber("planning/speed_command", SpeedCommand, self._on_speed)

    def run(self):
        rate = rospy.Rate(RATE)
        while not rospy.is_shutdown():
            with self._lock:
                self._tick()
            rate.sleep()

    def _on_command(self, command):
        with self._lock:
            identity = (command.command_id, command.header.stamp)
            if identity == self._seen:  # the topic is latched: a new connection brings the same message again
                return
            self._seen = identity
            if not command.is_motion_command:  # for who starts later; it stops nobody
                return
            self._started = min(self._started, rospy.Time.now())  # simulated time may have been set back
            if (self._started - command.header.stamp).to_sec() > MAX_AGE:
                self._report(command.command_id, CommandStatus.ERROR, "sent long before this planner started")
                return
            if len(command.path.points) < 2:
                self._report(command.command_id, CommandStatus.ERROR, "there is no path to drive")
                return
            self._command_id, self._sent = command.command_id, command.header.stamp
            self._controller, self._hold = Controller(command.path, command.target_speed), None
            if self._last_stop and is_earlier(self._sent, self._last_stop.header.stamp):
                self._obey(self._last_stop.action)  # it was sent after the command, and came first

    def _on_pad(self, pad):
        with self._lock:
            if pad.action in (PlanningPad.STOP, PlanningPad.CLEAR_PLANNING):
                if is_earlier(pad.header.stamp, self._sent):  # topics are not in step: it is about an earlier command
                    return
                self._last_stop = pad
            elif pad.action == PlanningPad.RESUME_CRUISE:
                self._last_stop = None
            self._obey(pad.action)

    def _obey(self, action):
        if action in HOLDS:
            self._hold = action
        elif action == PlanningPad.RESUME_CRUISE:
            self._hold = None
        elif action == PlanningPad.CLEAR_PLANNING:
            self._controller = None
        else:  # to follow, to change lanes, missions: what your planner can do
            self._report(0, CommandStatus.ERROR, "this planner does not know the action %d" % action)

    def _on_speed(self, command):
        with self._lock:
            if not self._controller:
                self._report(command.command_id, CommandStatus.ERROR, "nothing is driven whose speed could be changed")
            elif command.kind == SpeedCommand.TARGET_SPEED_FACTOR:
                self._controller.speed_factor = command.target_speed_factor
            elif command.kind == SpeedCommand.TARGET_SPEED:
                self._controller.target_speed = command.target_speed
            else:
                self._controller.restore_speed()

    def _tick(self):
        if self._controller and not self._hold:
            self._controller.drive(1.0 / RATE)
            self._report_way()
        elif self._controller:
            self._report(self._command_id, CommandStatus.RUNNING, "held at %.1f m" % self._controller.driven)
        if self._hold:  # once the vehicle stands; pads have no id
            self._report(0, CommandStatus.FINISHED, "standing")
        state = PlanningState(scenario=HOLDS.get(self._hold, "LANE_FOLLOW" if self._controller else "IDLE"))
        state.header.stamp = rospy.Time.now()
        self._state.publish(state)

    def _report_way(self):
        if self._controller.has_arrived:
            self._report(self._command_id, CommandStatus.FINISHED, "driven %.1f m" % self._controller.length)
            self._controller = None
        else:
            way = self._controller.driven, self._controller.length
            self._report(self._command_id, CommandStatus.RUNNING, "driven %.1f of %.1f m" % way)

    def _report(self, command_id, status, message):
        report = CommandStatus(command_id=command_id, status=status, message=message)
        if status == CommandStatus.ERROR:
            report.error_code = CommandStatus.REFUSED_BY_VEHICLE
        report.header.stamp = rospy.Time.now()  # one that is older than its command does not count
        self._reports.publish(report)


if __name__ == "__main__":
    rospy.init_node("planner_stub")
    PlannerStub().run()
