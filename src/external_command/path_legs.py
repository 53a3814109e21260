# SPDX-License-Identifier: Apache-2.0
"""Checks a reference path and cuts it into legs between gear changes."""

import math

from external_command.plane import arc_lengths, direction, distance, wrap_angle

FORWARD = 1
REVERSE = -1

MAX_LENGTH = 1e5  # of a path [m]


class PathError(ValueError):
    """A path that cannot be followed; the text says why."""


class PathWithoutLength(PathError):
    """All of its points are the same."""


def split_legs(points):
    """[(points, gear)] of a path, cut at its gear changes; the cusp belongs to both sides.

    Points that repeat their predecessor are left out. Raises PathError, also where a speed limit of 0 orders a stop
    that is no end of a leg: the vehicle would wait there for ever.
    """
    if len(points) < 2:
        raise PathError("the path has %d points; at least 2 are needed" % len(points))
    for i, p in enumerate(points):
        if not all(map(math.isfinite, (p.x, p.y, p.heading, p.speed))):
            raise PathError("point %d of the path is not finite: (%s, %s), heading %s, speed %s" %
                            (i, p.x, p.y, p.heading, p.speed))
    gears = [_gear(i, p) for i, p in enumerate(points)]
    legs = []
    start = 0
    for i in range(2, len(points) + 1):
        if i == len(points) or gears[i] != gears[i - 1]:
            part = _without_repetitions(points[start:i])
            if len(part) > 1:
                legs.append((part, gears[i - 1]))
            start = i - 1
    length = sum(arc_lengths([(p.x, p.y) for p in part])[-1] for part, _ in legs)
    if length > MAX_LENGTH:
        raise PathError("the path is %g m long; the limit is %g m" % (length, MAX_LENGTH))
    if not legs:
        raise PathWithoutLength("the path has no length: all of its %d points are the same" % len(points))
    for part, gear in legs:
        _check_headings(part, gear)
        _check_speeds(part)
    return legs


def _gear(index, point):
    if point.direction not in (0, FORWARD, REVERSE):
        raise PathError("point %d of the path has direction %s; 1 (forward) or -1 (reverse) is needed" %
                        (index, point.direction))
    return point.direction or FORWARD


def _check_speeds(points):
    for p in points:
        if p.speed < 0.0:
            raise PathError("the path has a speed limit of %g m/s at (%.2f, %.2f); it must not be negative" %
                            (p.speed, p.x, p.y))
    for p in points[1:-1]:
        if p.speed == 0.0:
            raise PathError("the path has a speed limit of 0 at (%.2f, %.2f), inside a leg: the vehicle would wait "
                            "there for ever" % (p.x, p.y))


def _without_repetitions(points):
    kept = [points[0]]
    for p in points[1:]:
        if distance((p.x, p.y), (kept[-1].x, kept[-1].y)) > 1e-3:
            kept.append(p)
    return kept


def _check_headings(points, gear):
    """A vehicle does not move sideways: headings that were left out show up here."""
    for i, (a, b) in enumerate(zip(points, points[1:])):
        a_xy, b_xy = (a.x, a.y), (b.x, b.y)
        motion = direction(a_xy, b_xy) + (0.0 if gear == FORWARD else math.pi)
        error = abs(wrap_angle(motion - a.heading - 0.5 * wrap_angle(b.heading - a.heading)))
        if distance(a_xy, b_xy) > 0.05 and error > 1.0:
            raise PathError("the path goes from (%.2f, %.2f) to (%.2f, %.2f), %.2f rad off its heading %.2f rad; "
                            "the limit is 1 rad" % (a.x, a.y, b.x, b.y, error, a.heading))
