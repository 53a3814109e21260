# SPDX-License-Identifier: Apache-2.0
"""The simulated vehicle as a ROS node. See `scripts/simulated_vehicle --help` for what it does."""

import dataclasses
import math
import threading
import time

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from tf2_msgs.msg import TFMessage

import external_command.old_rospy  # noqa: F401
from external_command import bicycle
from external_command.msg import (Chassis, ChassisCommand, CommandStatus, ControlPad, PlanningCommand, PlanningPad,
                                  PlanningState, SpeedCommand)
from external_command.path_legs import FORWARD
from external_command.simulated_chassis import ChassisSettings, SimulatedChassis
from external_command.simulated_planner import PlannerSettings, SimulatedPlanner

STEP = 0.02  # simulated [s]
KIND_NAMES = {float: "a finite number", int: "a whole number", str: "a text", bool: "true or false"}
LONGEST_BACKLOG = 0.5  # of real time that is made up for after the machine was busy [s]


class BadParameter(ValueError):
    """The text names the parameter, its value, and what was expected."""


@dataclasses.dataclass(frozen=True)
class NodeSettings:
    x: float = 0.0  # [m]
    y: float = 0.0  # [m]
    heading: float = 0.0  # [rad]
    real_time_factor: float = 1.0  # simulated seconds per second
    base_frame: str = "base_link"
    tf_rate: float = 50.0  # [Hz], as all rates of real time
    chassis_rate: float = 20.0  # [Hz]
    status_rate: float = 10.0  # of running commands, and of the planner's state [Hz]
    max_command_age: float = 5.0  # a planning command sent longer before the start of this node is refused [s]


class SimulatedVehicleNode:
    """Connects the simulated planner and chassis to topics and tf, and lets time pass.

    Callbacks come in threads of rospy, time passes in the thread of `run`; one lock guards both parts.
    """

    def __init__(self):
        settings = read_parameters(NodeSettings)
        for name in ("real_time_factor", "tf_rate", "chassis_rate", "status_rate"):
            if getattr(settings, name) <= 0.0:
                raise BadParameter("~%s is %s; it must be above 0" % (name, getattr(settings, name)))
        limits = read_parameters(bicycle.VehicleLimits, "vehicle/")
        planner_settings = read_parameters(PlannerSettings)
        planner_settings = dataclasses.replace(
            planner_settings, reaction_time=planner_settings.reaction_time * max(1.0, settings.real_time_factor))
        self._settings = settings
        self._map_frame = planner_settings.map_frame
        self._started = rospy.Time.now()
        self._lock = threading.Lock()
        self._planner = SimulatedPlanner(limits, planner_settings,
                                         bicycle.VehicleState(settings.x, settings.y, settings.heading))
        self._chassis = SimulatedChassis(read_parameters(ChassisSettings))
        self._seen = None  # (id, stamp) of the last planning command
        self._motion_stamp = rospy.Time()  # of the last motion command
        self._last_stop = None  # the last pad that stopped, None once a START let the vehicle go on
        self._shown_scenario = None
        self._shown_mode = None
        self._due = {}  # name of something periodic -> when it is due next
        self._advertise()
        self._subscribe()

    def run(self):
        """Simulates until the node is shut down."""
        rate = self._settings.tf_rate
        last = time.monotonic()
        backlog = 0.0
        while not rospy.is_shutdown():
            now = time.monotonic()
            backlog += min(now - last, LONGEST_BACKLOG) * self._settings.real_time_factor
            last = now
            with self._lock:
                backlog = self._simulate(backlog)
                self._publish(now)
            time.sleep(max(0.0, now + 1.0 / rate - time.monotonic()))

    def _simulate(self, backlog):
        """Steps through `backlog` simulated seconds; the rest that is no whole step."""
        if self._planner.is_idle and not self._chassis.is_switching:
            return 0.0
        while backlog >= STEP:
            self._chassis.step(STEP)
            self._planner.step(STEP, self._chassis.obstacle)
            backlog -= STEP
        return backlog

    def _advertise(self):
        self._tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self._chassis_pub = rospy.Publisher("canbus/chassis", Chassis, queue_size=10)
        self._status_pub = rospy.Publisher("planning/command_status", CommandStatus, queue_size=100)
        self._state_pub = rospy.Publisher("planning/state", PlanningState, queue_size=10, latch=True)

    def _subscribe(self):
        chassis, planner = self._chassis, self._planner
        for topic, message_class, callback in (
                ("planning/command", PlanningCommand, self._on_planning_command),
                ("planning/speed_command", SpeedCommand, planner.accept_speed),
                ("planning/pad", PlanningPad, self._on_planning_pad),
                ("control/pad", ControlPad, lambda pad: chassis.accept_pad(pad.action)),
                ("canbus/chassis_control", ChassisCommand, chassis.accept_command),
                ("initialpose", PoseWithCovarianceStamped, self._on_initial_pose)):
            rospy.Subscriber(topic, message_class, self._locked(callback))

    def _locked(self, callback):
        def call(message):
            with self._lock:
                callback(message)
        return call

    def _on_planning_command(self, command):
        """The topic is latched: a reconnection brings the same command again, a start of this node an old one."""
        identity = (command.command_id, command.header.stamp)
        if identity == self._seen and not command.header.stamp.is_zero():
            return
        self._seen = identity
        if command.is_motion_command:
            self._motion_stamp = command.header.stamp
        self._started = min(self._started, rospy.Time.now())  # simulated time may have been set back
        age = (self._started - command.header.stamp).to_sec()
        if not command.header.stamp.is_zero() and age > self._settings.max_command_age:
            text = ("the command was sent %.1f s before this vehicle started; the limit is %.1f s (~max_command_age): "
                    "send it again" % (age, self._settings.max_command_age))
            self._planner.refuse(command.command_id, text)
        else:
            self._planner.accept(command)
            if command.is_motion_command and self._was_overtaken(command):
                self._planner.accept_pad(self._last_stop.action)

    def _on_planning_pad(self, pad):
        if pad.action in (PlanningPad.STOP, PlanningPad.CLEAR_PLANNING):
            if not pad.header.stamp.is_zero() and pad.header.stamp < self._motion_stamp <= rospy.Time.now():
                return  # it is about an earlier motion; topics are not in step
            self._last_stop = pad
        elif pad.action == PlanningPad.RESUME_CRUISE:
            self._last_stop = None
        self._planner.accept_pad(pad.action)

    def _was_overtaken(self, command):
        """By a stop that was sent later: topics are not in step. A stop from ahead of now is from before simulated time
        was set back."""
        return (self._last_stop is not None
                and command.header.stamp < self._last_stop.header.stamp <= rospy.Time.now())

    def _on_initial_pose(self, message):
        frame = message.header.frame_id.lstrip("/")
        pose = message.pose.pose
        x, y, q = pose.position.x, pose.position.y, pose.orientation
        heading = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        if frame not in ("", self._map_frame):
            rospy.logwarn("initialpose is in frame %s; only %s is understood: ignored", frame, self._map_frame)
        elif not all(map(math.isfinite, (x, y, heading))):
            rospy.logwarn("initialpose (%s, %s), heading %s is not finite: ignored", x, y, heading)
        else:
            self._planner.place(bicycle.VehicleState(x, y, heading))

    def _publish(self, now):
        stamp = rospy.Time.now()
        self._publish_tf(stamp)
        if self._is_due("chassis", now, self._settings.chassis_rate) or self._chassis.mode != self._shown_mode:
            self._publish_chassis(stamp)
        scenario = self._planner.scenario
        if self._is_due("state", now, self._settings.status_rate) or scenario != self._shown_scenario:
            self._shown_scenario = scenario
            message = PlanningState(scenario=scenario)
            message.header.stamp = stamp
            self._state_pub.publish(message)
        if self._is_due("status", now, self._settings.status_rate):
            self._planner.report_progress(self._chassis.obstacle)
            self._planner.report_hold()
        for status in self._planner.statuses:
            status.header.stamp = stamp
            self._status_pub.publish(status)
            if status.status != CommandStatus.RUNNING and status.command_id > 0:
                rospy.loginfo("command %d: %s", status.command_id, status.message)
        del self._planner.statuses[:]
        for fault in self._planner.faults:
            rospy.logwarn("%s", fault)
        del self._planner.faults[:]

    def _is_due(self, name, now, rate):
        if now < self._due.get(name, 0.0):
            return False
        self._due[name] = now + 1.0 / rate
        return True

    def _publish_tf(self, stamp):
        state = self._planner.state
        transform = TransformStamped(child_frame_id=self._settings.base_frame)
        transform.header.stamp = stamp
        transform.header.frame_id = self._map_frame
        transform.transform.translation.x = state.x
        transform.transform.translation.y = state.y
        transform.transform.rotation.z = math.sin(0.5 * state.heading)
        transform.transform.rotation.w = math.cos(0.5 * state.heading)
        self._tf.publish(TFMessage(transforms=[transform]))

    def _publish_chassis(self, stamp):
        self._shown_mode = self._chassis.mode
        message = Chassis(driving_mode=self._chassis.mode, speed_mps=self._planner.state.speed,
                          signal=self._chassis.signal, vin=self._chassis.vin)
        message.header.stamp = stamp
        if self._planner.has_task or self._planner.state.speed != 0.0:
            message.gear = Chassis.DRIVE if self._planner.gear == FORWARD else Chassis.REVERSE
        else:
            message.gear = Chassis.PARKING
        self._chassis_pub.publish(message)


def read_parameters(settings_class, prefix=""):
    """An instance of a dataclass, its fields from the private parameters `prefix`<field>, where these are set.

    Raises BadParameter for a value of the wrong type or out of range.
    """
    values = {}
    for field in dataclasses.fields(settings_class):
        name = "~" + prefix + field.name
        value = rospy.get_param(name, field.default)
        if field.type is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if type(value) is not field.type or (field.type is float and not math.isfinite(value)):
            raise BadParameter("%s is %r; %s is needed" % (name, value, KIND_NAMES[field.type]))
        values[field.name] = value
    try:
        return settings_class(**values)
    except ValueError as error:
        raise BadParameter("~" + str(error)) from error
