# SPDX-License-Identifier: Apache-2.0
"""Angles and polylines in the plane; points are (x, y) tuples [m], angles are [rad] counter-clockwise from +x."""

import math


def wrap_angle(angle):
    """The same angle in (-pi, pi]."""
    wrapped = math.fmod(angle, 2.0 * math.pi)
    if wrapped > math.pi:
        return wrapped - 2.0 * math.pi
    return wrapped + 2.0 * math.pi if wrapped <= -math.pi else wrapped


def distance(a, b):
    return math.hypot(b[0] - a[0], b[1] - a[1])


def direction(a, b):
    """Heading of the way from `a` to `b`."""
    return math.atan2(b[1] - a[1], b[0] - a[0])


def moved(point, heading, forward, left=0.0):
    """`point` moved `forward` along `heading` and `left` across it."""
    cos, sin = math.cos(heading), math.sin(heading)
    return point[0] + forward * cos - left * sin, point[1] + forward * sin + left * cos


def arc_lengths(points):
    """For each point its distance along the polyline from the first."""
    lengths = [0.0]
    for a, b in zip(points, points[1:]):
        lengths.append(lengths[-1] + distance(a, b))
    return lengths
