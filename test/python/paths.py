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


# Reverse into a space at the right: forward past it in a bend, then back in a tighter one and straight in.
PARKING = [(8.0, 0.0), (5.0, 0.19), (-4.0, -0.19), (-6.0, 0.2), (-4.0, 0.0)]


def motion_command(points, command_id=7, target_speed=0.0):
    command = PlanningCommand(command_id=command_id, is_motion_command=True, target_speed=target_speed)
    command.header.frame_id = "map"
    command.path.points = points
    return command


def state_at(point):
    return bicycle.VehicleState(point.x, point.y, point.heading)
