# SPDX-License-Identifier: Apache-2.0
"""Builds reference paths of straights and arcs for tests, and drives them."""

import math

from external_command import bicycle
from external_command.msg import PathPoint, PlanningCommand
from external_command.plane import wrap_angle

LIMITS = bicycle.VehicleLimits()
DT = 0.02


def make_path(pieces, start=(0.0, 0.0, 0.0), speed=5.0, spacing=0.1):
    """`pieces`: (length [m], curvature of the vehicle's turn [1/m]); a negative length is driven in reverse."""
    x, y, heading = start
    points = []
    s = 0.0
    for length, kappa in pieces:
        gear = 1 if length > 0.0 else -1
        if not points:
            points.append(PathPoint(x=x, y=y, heading=heading, kappa=kappa, speed=speed, direction=gear))
        count = max(1, int(round(abs(length) / spacing)))
        for _ in range(count):
            driven = length / count
            turned = driven * kappa
            chord = driven * (math.sin(turned / 2) / (turned / 2) if turned else 1.0)
            x += chord * math.cos(heading + turned / 2)
            y += chord * math.sin(heading + turned / 2)
            heading = wrap_angle(heading + turned)
            s += abs(driven)
            points.append(PathPoint(x=x, y=y, heading=heading, kappa=kappa, s=s, speed=speed, direction=gear))
    return points


def limited(points, limits=LIMITS):
    """The same points, their speeds as the limits of a path have to be: stops at its cusps and end, changes that the
    vehicle can follow."""
    for i, p in enumerate(points):
        top = limits.max_speed if p.direction == 1 else limits.max_reverse_speed
        p.speed = min(p.speed, top, math.sqrt(limits.max_lateral_acceleration / max(abs(p.kappa), 1e-6)))
        if i + 1 == len(points) or (i > 0 and points[i + 1].direction != p.direction):
            p.speed = 0.0
    for a, b in reversed(list(zip(points, points[1:]))):
        a.speed = min(a.speed, math.sqrt(b.speed ** 2 + 2.0 * limits.max_deceleration * (b.s - a.s)))
    for a, b in zip(points, points[1:]):
        b.speed = min(b.speed, math.sqrt(a.speed ** 2 + 2.0 * limits.max_acceleration * (b.s - a.s)))
    return points


# Reverse into a space at the right: forward past it in a bend, then back in a tighter one and straight in.
PARKING = [(8.0, 0.0), (5.0, 0.19), (-4.0, -0.19), (-6.0, 0.2), (-4.0, 0.0)]


def motion_command(points, command_id=7, target_speed=0.0):
    command = PlanningCommand(command_id=command_id, is_motion_command=True, target_speed=target_speed)
    command.header.frame_id = "map"
    command.path.points = points
    return command


def state_at(point):
    return bicycle.VehicleState(point.x, point.y, point.heading)
