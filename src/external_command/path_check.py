# SPDX-License-Identifier: Apache-2.0
"""Whether a path can be driven as it is sent: what a controller may rely on, checked point by point."""

import math

from external_command.path_legs import FORWARD
from external_command.plane import direction, distance, wrap_angle

MAX_GAP = 2.0  # between neighbouring points [m]
CURVATURE_SLACK = 1.02  # of the sampled curvature
SPEED_SLACK = 1.02
TURN_SLACK = 0.03  # of the heading from one point to the next [rad]
SAME_PLACE = 1e-3  # [m]


def faults(points, limits, check_curvature=True):
    """What is wrong with a path of external_command/PathPoint or alike: a text per kind of fault, with its first place.

    Asked for are two points at least, all finite; positions, headings and s that go on without a jump, in the gear
    stated; curvature (with `check_curvature`), speed and changes of speed within `limits` (bicycle.VehicleLimits); a
    limit of 0 at the end and where the gear changes, and nowhere else.
    """
    if len(points) < 2:
        return ["the path has %d points" % len(points)]
    for i, p in enumerate(points):
        if not all(map(math.isfinite, (p.x, p.y, p.heading, p.kappa, p.s, p.speed))):
            return ["point %d is not finite" % i]
    if all(distance((p.x, p.y), (points[0].x, points[0].y)) < SAME_PLACE for p in points):
        return []  # the vehicle is there already
    checks = [_step_fault, _stop_fault, _speed_fault, _change_fault] + ([_curvature_fault] if check_curvature else [])
    found = []
    for check in checks:
        for i in range(len(points)):
            fault = check(points, i, limits)
            if fault:
                found.append("point %d of %d, (%.2f, %.2f), %s" % (i, len(points), points[i].x, points[i].y, fault))
                break
    return found


def start_fault(points, state, allowed):
    """What is wrong with the beginning of a path for a vehicle at `state`, no more than `allowed` [m] away; or None."""
    away = distance((points[0].x, points[0].y), (state.x, state.y))
    turn = abs(wrap_angle(points[0].heading - state.heading))
    if away > allowed:
        return "it begins %.2f m from the vehicle; the limit is %.2f m" % (away, allowed)
    if turn > 0.1 + 0.1 * allowed:
        return "it begins with a heading %.2f rad off the vehicle's" % turn
    return None


def _is_stop(points, i):
    return i + 1 == len(points) or (i > 0 and points[i + 1].direction != points[i].direction)


def _step_fault(points, i, _limits):
    if i == 0:
        return "has s %.3f; it must be 0" % points[0].s if abs(points[0].s) > SAME_PLACE else None
    a, b = points[i - 1], points[i]
    length, rise = distance((a.x, a.y), (b.x, b.y)), b.s - a.s
    if length > MAX_GAP:
        return "is %.2f m from the one before" % length
    if not 0.97 * length - SAME_PLACE <= rise <= 1.2 * length + SAME_PLACE:
        return "has an s %.3f m above that of the one before, which is %.3f m away" % (rise, length)
    turn = wrap_angle(b.heading - a.heading)
    told = 0.5 * (a.kappa + b.kappa) * (1 if b.direction == FORWARD else -1) * rise
    if abs(turn - told) > TURN_SLACK + 0.5 * abs(b.kappa - a.kappa) * rise:
        return "turns by %.3f rad from the one before; the curvature says %.3f" % (turn, told)
    motion = direction((a.x, a.y), (b.x, b.y)) + (0.0 if b.direction == FORWARD else math.pi)
    sideways = length * math.sin(wrap_angle(motion - a.heading - 0.5 * turn))
    if abs(sideways) > 0.005 + 0.02 * length or (length > SAME_PLACE and math.cos(motion - a.heading) < 0.0):
        return "is reached sideways, or against the gear: %.3f rad off its heading" % wrap_angle(motion - a.heading)
    return None


def _stop_fault(points, i, _limits):
    stands = any(_is_stop(points, j) and abs(points[j].s - points[i].s) < SAME_PLACE
                 for j in range(max(0, i - 2), min(len(points), i + 3)))
    if _is_stop(points, i) and points[i].speed != 0.0:
        return "has the limit %.2f m/s where the vehicle must stop" % points[i].speed
    if points[i].speed <= 0.0 and not stands:
        return "has the limit %.2f m/s inside a leg" % points[i].speed
    return None


def _speed_fault(points, i, limits):
    p = points[i]
    top = limits.max_speed if p.direction == FORWARD else limits.max_reverse_speed
    if p.speed > SPEED_SLACK * top:
        return "has the limit %.2f m/s; the vehicle's is %.2f" % (p.speed, top)
    sideways = p.speed ** 2 * abs(p.kappa)
    if sideways > SPEED_SLACK * limits.max_lateral_acceleration:
        return "asks for %.2f m/s^2 to the side; the limit is %.2f" % (sideways, limits.max_lateral_acceleration)
    return None


def _change_fault(points, i, limits):
    if i == 0:
        return None
    a, b = points[i - 1], points[i]
    change = b.speed ** 2 - a.speed ** 2
    limit = limits.max_acceleration if change > 0.0 else limits.max_deceleration
    if abs(change) > 2.0 * SPEED_SLACK * limit * (b.s - a.s) + 1e-3:
        return "asks for %.2f m/s^2 from %.2f to %.2f m/s; the limit is %.2f" % (
            abs(change) / (2.0 * max(b.s - a.s, 1e-9)), a.speed, b.speed, limit)
    return None


def _curvature_fault(points, i, limits):
    radius = 1.0 / max(abs(points[i].kappa), 1e-9)
    if radius * CURVATURE_SLACK < limits.min_turning_radius:
        return "bends with a radius of %.2f m; the vehicle's is %.2f m" % (radius, limits.min_turning_radius)
    return None
