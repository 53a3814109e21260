# SPDX-License-Identifier: Apache-2.0
"""Curves a street map is drawn with; all are polylines of (x, y) [m]."""

import bisect
import math

from external_command.plane import arc_lengths, direction, distance, moved, wrap_angle

STRAIGHT_SPACING = 10.0  # of points kept where a curve is straight [m]


def blend(start, start_heading, end, end_heading, spacing=0.75):
    """A smooth curve between two poses, with no curvature at its ends, so that it continues straights and other blends.

    A quintic Hermite curve. Its end speeds are 1.05 times the distance between the ends, which makes the tightest
    radius of a right-angled corner 0.84 times its tangent length, near the best there is.
    """
    pull = 1.05 * distance(start, end)
    a = (pull * math.cos(start_heading), pull * math.sin(start_heading))
    b = (pull * math.cos(end_heading), pull * math.sin(end_heading))
    count = max(2, int(math.ceil(10.0 * pull)))
    points = []
    for i in range(count + 1):
        t = i / count
        to_end = t ** 3 * (10.0 - 15.0 * t + 6.0 * t * t)
        by_start = t - 6.0 * t ** 3 + 8.0 * t ** 4 - 3.0 * t ** 5
        by_end = -4.0 * t ** 3 + 7.0 * t ** 4 - 3.0 * t ** 5
        points.append(tuple((1.0 - to_end) * start[k] + to_end * end[k] + by_start * a[k] + by_end * b[k]
                            for k in (0, 1)))
    return resampled(points, spacing)


def rounded(corners, spacing=1.0):
    """A polyline through `corners`, (x, y, tangent length), each of which but the ends is rounded off by a blend."""
    points = [corners[0][:2]]
    for before, corner, after in zip(corners, corners[1:], corners[2:]):
        first, last = direction(before, corner), direction(corner, after)
        tangent = corner[2]
        points += blend(moved(corner, first, -tangent), first, moved(corner, last, tangent), last, spacing)
    points.append(corners[-1][:2])
    return resampled(points, spacing)


def arc(center, radius, start_angle, end_angle, spacing=0.75):
    """Counter-clockwise; `end_angle` is the larger one."""
    count = max(2, int(math.ceil(radius * (end_angle - start_angle) / spacing)))
    return [moved(center, start_angle + (end_angle - start_angle) * i / count, radius) for i in range(count + 1)]


def offset(points, left):
    """The parallel curve at distance `left`."""
    shifted = []
    for i, point in enumerate(points):
        heading = direction(points[max(0, i - 1)], points[min(len(points) - 1, i + 1)])
        # The chord at an end lags behind the tangent by half of what the curve turns from there to the next chord.
        if i == 0 and len(points) > 2:
            heading -= 0.5 * wrap_angle(direction(points[1], points[2]) - heading)
        elif i == len(points) - 1 and len(points) > 2:
            heading += 0.5 * wrap_angle(heading - direction(points[-3], points[-2]))
        shifted.append(moved(point, heading, 0.0, left))
    return shifted


def at(points, s):
    """(point, heading) at arc length `s` of a polyline."""
    lengths = arc_lengths(points)
    i = min(max(bisect.bisect_right(lengths, s) - 1, 0), len(points) - 2)
    heading = direction(points[i], points[i + 1])
    return moved(points[i], heading, s - lengths[i]), heading


def cut(points, start_s, end_s):
    """The part of a polyline between two arc lengths."""
    inner = [p for p, s in zip(points, arc_lengths(points)) if start_s + 1e-3 < s < end_s - 1e-3]
    return [at(points, start_s)[0]] + inner + [at(points, end_s)[0]]


def resampled(points, spacing):
    """Points on the polyline, evenly spaced by `spacing` or a little less."""
    lengths = arc_lengths(points)
    count = max(2, int(math.ceil(lengths[-1] / spacing - 1e-9)))
    even = [points[0]]
    i = 0
    for n in range(1, count):
        s = lengths[-1] * n / count
        while lengths[i + 1] < s:
            i += 1
        t = (s - lengths[i]) / (lengths[i + 1] - lengths[i])
        (ax, ay), (bx, by) = points[i], points[i + 1]
        even.append((ax + t * (bx - ax), ay + t * (by - ay)))
    return even + [points[-1]]


def length(points):
    return arc_lengths(points)[-1]


def project(points, point):
    """Arc length of the nearest point of a polyline."""
    best, best_distance = 0.0, math.inf
    for a, b, s in zip(points, points[1:], arc_lengths(points)):
        size = distance(a, b)
        along = (point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])
        t = min(max(along / (size * size), 0.0), 1.0)
        foot = (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
        if distance(foot, point) < best_distance:
            best, best_distance = s + t * size, distance(foot, point)
    return best


def thinned(points):
    """Without the points that a straight does not need."""
    kept = [points[0]]
    for before, point, after in zip(points, points[1:], points[2:]):
        is_straight = abs(wrap_angle(direction(point, after) - direction(before, point))) < 1e-4
        if not is_straight or distance(kept[-1], after) > STRAIGHT_SPACING:
            kept.append(point)
    return kept + [points[-1]]


def contains(polygon, point):
    inside = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if (a[1] > point[1]) != (b[1] > point[1]):
            if point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]):
                inside = not inside
    return inside


def convex_hull(points):
    """Counter-clockwise (Andrew's monotone chain)."""
    points = sorted(set(points))
    halves = []
    for ordered in (points, points[::-1]):
        half = []
        for p in ordered:
            while len(half) > 1 and _turn(half[-2], half[-1], p) <= 0.0:
                half.pop()
            half.append(p)
        halves += half[:-1]
    return halves


def _turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
