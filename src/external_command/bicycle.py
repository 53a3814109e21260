# SPDX-License-Identifier: Apache-2.0
"""Kinematic bicycle: a car-like vehicle without slip, with limits of speed, acceleration, steering angle and rate.

The reference point is the rear-axle centre. A steering angle d of the front wheels gives the curvature
tan(d) / wheelbase, positive to the left; the speed is negative in reverse.
"""

import dataclasses
import math

from external_command.plane import wrap_angle


@dataclasses.dataclass(frozen=True)
class VehicleLimits:
    """The keys are those of the component's `~vehicle` parameters, so that one file serves both."""

    wheelbase: float = 2.8  # [m]
    min_turning_radius: float = 5.0  # that a planner may ask for, of the rear-axle centre [m]
    max_speed: float = 15.0  # forward [m/s]
    max_reverse_speed: float = 2.0  # [m/s], positive
    max_acceleration: float = 1.5  # [m/s^2]
    max_deceleration: float = 2.5  # [m/s^2], positive
    max_lateral_acceleration: float = 1.5  # [m/s^2]
    max_steering_rate: float = 0.5  # of the front wheels [rad/s]

    def __post_init__(self):
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError("vehicle/%s is %s; it must be finite and above 0" % (field.name, value))

    def steering_for(self, kappa):
        """The steering angle for a curvature, cut to what the wheels reach.

        They reach a tenth beyond `min_turning_radius`: else an error in a bend at full lock could not be corrected.
        """
        limit = 1.1 / self.min_turning_radius
        return math.atan(self.wheelbase * min(max(kappa, -limit), limit))


@dataclasses.dataclass(frozen=True)
class VehicleState:
    x: float = 0.0  # [m]
    y: float = 0.0  # [m]
    heading: float = 0.0  # [rad]
    speed: float = 0.0  # [m/s], negative in reverse
    steering: float = 0.0  # [rad], positive to the left


def step(state, limits, target_speed, target_steering, deceleration, dt):
    """The state `dt` [s] later. Speed and steering go towards their targets as fast as the limits allow.

    `deceleration` [m/s^2] bounds the braking, the vehicle's `max_acceleration` the speeding up.
    """
    steering = _approach(state.steering, target_steering, limits.max_steering_rate * dt)
    speeds_up = abs(target_speed) > abs(state.speed) and target_speed * state.speed >= 0.0
    change = limits.max_acceleration if speeds_up else deceleration
    speed = _approach(state.speed, target_speed, change * dt)

    driven = 0.5 * (state.speed + speed) * dt
    turned = driven * math.tan(0.5 * (state.steering + steering)) / limits.wheelbase
    chord = driven * _sinc(0.5 * turned)
    middle = state.heading + 0.5 * turned
    return VehicleState(x=state.x + chord * math.cos(middle), y=state.y + chord * math.sin(middle),
                        heading=wrap_angle(state.heading + turned), speed=speed, steering=steering)


def _approach(value, target, change):
    return min(max(target, value - change), value + change)


def _sinc(angle):
    """sin(angle) / angle: chord over arc of a circle."""
    return math.sin(angle) / angle if abs(angle) > 1e-9 else 1.0
