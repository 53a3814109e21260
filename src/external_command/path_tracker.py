# SPDX-License-Identifier: Apache-2.0
"""Follows a reference path with a kinematic bicycle, forward and in reverse, and stops at its cusps and end.

The path is cut into legs between gear changes. Steering is the curvature of the path plus a feedback of the lateral
and the heading error that makes both decay critically damped in the distance driven; speed obeys the path's limits,
what the bends and the steering rate allow, and what can be braked for. A limit of 0 ends a leg and means nothing else: a
path with one elsewhere is refused.
"""

import collections
import math

from external_command.path_legs import FORWARD, split_legs
from external_command.plane import arc_lengths, distance, wrap_angle

SPACING = 0.2  # of the samples of a leg [m]
SEARCH_AHEAD = 1.0  # the foot point moves ahead in one step by no more than this [m]
STOPPED_WITHIN = 0.002  # of the end of a leg [m]
MAX_APPROACH_ANGLE = 0.9  # of a vehicle beside the path towards it [rad]
MAX_DISPLACEMENT = 0.01  # of the path where a jump of its curvature is smoothed [m]
CRAWL_SPEED = 0.2  # no bend is taken slower than this [m/s]
MIN_SPEED = 0.05  # nothing makes the vehicle slower than this before the end of a leg [m/s]

# speed [m/s], never negative; steering [rad]
Control = collections.namedtuple("Control", "speed steering")


class PathTracker:
    """Where a vehicle is on a path, and how it goes on."""

    def __init__(self, points, limits):
        """`points`: external_command/PathPoint or alike. Raises PathError."""
        self._limits = limits
        self._legs = [Leg(part, gear, limits) for part, gear in split_legs(points)]
        self._index = 0
        self._s = 0.0  # of the foot point on the present leg [m]

    @property
    def gear(self):
        """FORWARD or REVERSE, of the present leg."""
        return self._leg.gear

    @property
    def length(self):
        return sum(leg.length for leg in self._legs)

    @property
    def driven(self):
        """Along the path up to the foot point [m]."""
        return sum(leg.length for leg in self._legs[:self._index]) + self._s

    def start_distance(self, state):
        """From the vehicle to the first point [m]."""
        return distance((state.x, state.y), self._legs[0].points[0])

    def offset(self, state):
        """From the vehicle to the foot point [m]."""
        return distance((state.x, state.y), self._leg.at(self._s)[:2])

    def end_error(self, state):
        """(position [m], heading [rad]) error of the vehicle against the end of the path, both positive."""
        end = self._legs[-1].at(self._legs[-1].length)
        return distance((state.x, state.y), end[:2]), abs(wrap_angle(state.heading - end[2]))

    def leg_done(self, state):
        return state.speed == 0.0 and self._remaining(state) <= STOPPED_WITHIN

    def next_leg(self):
        """Goes on with the next leg; False where there is none."""
        if self._index + 1 == len(self._legs):
            return False
        self._index += 1
        self._s = 0.0
        return True

    def control(self, state, dt, lateral_offset=0.0):
        """Moves the foot point to the vehicle and says how to drive in the next `dt` [s].

        `lateral_offset` [m] beside the path is aimed at, positive to the vehicle's left.
        """
        self._s = self._leg.foot_point(state, self._s)
        steering = self._steering(state, lateral_offset)
        remaining = self._remaining(state)
        if remaining <= STOPPED_WITHIN:
            return Control(0.0, steering)
        at_start = state.speed == 0.0 and self._s < SPACING
        if at_start and abs(steering - state.steering) > 0.02:
            return Control(0.0, steering)  # turns the wheels first, standing
        speed = max(self._leg.speed_limit(self._s), MIN_SPEED)
        turning_time = abs(steering - state.steering) / self._limits.max_steering_rate
        if turning_time > 0.3:  # the wheels lag behind: without slowing down the feedback would swing
            speed = min(speed, max(CRAWL_SPEED, 0.4 / turning_time))
        # The second term ends the braking without overshoot, whatever the step.
        return Control(min(speed, remaining / (4.0 * dt)), steering)

    @property
    def _leg(self):
        return self._legs[self._index]

    def _remaining(self, state):
        """To the end of the leg, negative beyond it [m]."""
        leg = self._leg
        if self._s < leg.length:
            return leg.length - self._s
        x, y, heading = leg.at(leg.length)
        return leg.gear * ((x - state.x) * math.cos(heading) + (y - state.y) * math.sin(heading))

    def _steering(self, state, lateral_offset):
        """With e the lateral error, t the heading error and g the gear, the kinematics in the distance driven are
        e' = g sin t and t' = g (kappa - kappa_path), so kappa = kappa_path - k^2 e - 2 k g t is critically damped."""
        x, y, heading = self._leg.at(self._s)
        lateral = (state.y - y) * math.cos(heading) - (state.x - x) * math.sin(heading) - lateral_offset
        k = 1.0 / max(1.0, 0.8 * abs(state.speed))
        wanted = -self.gear * min(max(0.5 * k * lateral, -MAX_APPROACH_ANGLE), MAX_APPROACH_ANGLE)
        heading_error = wrap_angle(state.heading - heading - wanted)
        kappa = self._leg.curvature(self._s) - 2.0 * k * self.gear * heading_error
        return self._limits.steering_for(kappa)


class Leg:
    """A part of a path driven in one gear, sampled evenly."""

    def __init__(self, points, gear, limits):
        self.gear = gear
        xy = [(p.x, p.y) for p in points]
        lengths = arc_lengths(xy)
        self.length = lengths[-1]
        count = max(2, int(math.ceil(self.length / SPACING)))
        self._spacing = self.length / count
        self._sample(points, xy, lengths, count)
        self._limit_speeds(points, lengths, limits)

    def at(self, s):
        """(x, y, heading) at `s`; the heading is not wrapped."""
        i, t = self._locate(s)
        a, b = self.points[i], self.points[i + 1]
        heading = self._headings[i] + t * (self._headings[i + 1] - self._headings[i])
        return a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), heading

    def curvature(self, s):
        return self._between(self._kappas, s)

    def speed_limit(self, s):
        return math.sqrt(self._between(self._squared_speeds, s))

    def foot_point(self, state, s):
        """The nearest point at or a little after `s`."""
        first = min(int(s / self._spacing), len(self.points) - 2)
        last = min(first + int(SEARCH_AHEAD / self._spacing) + 2, len(self.points) - 1)
        best, best_distance = s, math.inf
        for i in range(first, last):
            a, b = self.points[i], self.points[i + 1]
            dx, dy = b[0] - a[0], b[1] - a[1]
            t = ((state.x - a[0]) * dx + (state.y - a[1]) * dy) / (dx * dx + dy * dy)
            t = min(max(t, 0.0), 1.0)
            to_vehicle = math.hypot(a[0] + t * dx - state.x, a[1] + t * dy - state.y)
            if to_vehicle < best_distance:
                best, best_distance = (i + t) * self._spacing, to_vehicle
        return min(max(s, best), self.length)

    def _locate(self, s):
        i = min(int(s / self._spacing), len(self.points) - 2)
        return i, s / self._spacing - i

    def _between(self, values, s):
        i, t = self._locate(s)
        return values[i] + t * (values[i + 1] - values[i])

    def _sample(self, points, xy, lengths, count):
        self.points, self._headings = [], []
        i = 0
        heading = points[0].heading
        for n in range(count + 1):
            s = min(n * self._spacing, self.length)
            while i + 2 < len(xy) and lengths[i + 1] < s:
                heading += wrap_angle(points[i + 1].heading - points[i].heading)
                i += 1
            t = (s - lengths[i]) / (lengths[i + 1] - lengths[i])
            a, b = xy[i], xy[i + 1]
            self.points.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
            self._headings.append(heading + t * wrap_angle(points[i + 1].heading - points[i].heading))

    def _limit_speeds(self, points, lengths, limits):
        """Curvatures, and squared speed limits: these are linear in s under even braking.

        The curvature is a mean over a stretch that grows with the speed. Where the path's own jumps (from a straight to
        an arc) the wheels then turn evenly around the jump, which keeps the vehicle within centimetres of the path.
        """
        caps = self._given_speeds(points, lengths, limits)
        kappas = self._mean_curvatures([0.5] * len(caps))
        slow = [min(cap, math.sqrt(limits.max_lateral_acceleration / max(abs(kappa), 1e-6)))
                for cap, kappa in zip(caps, kappas)]
        slow = [math.sqrt(v) for v in self._braked(slow, limits)]
        self._kappas = self._mean_curvatures(self._half_widths(kappas, slow))
        steering = [limits.steering_for(kappa) for kappa in self._kappas]
        for i, cap in enumerate(slow):
            turned = max(abs(steering[j] - steering[j - 1]) for j in (max(i, 1), min(i + 1, len(steering) - 1)))
            slow[i] = min(cap, max(CRAWL_SPEED, 0.8 * limits.max_steering_rate * self._spacing / max(turned, 1e-6)))
        self._squared_speeds = self._braked(slow, limits)

    def _given_speeds(self, points, lengths, limits):
        """The limits of the path for each sample, evenly braked from one to the next."""
        top = limits.max_speed if self.gear == FORWARD else limits.max_reverse_speed
        squares = [min(p.speed, top) ** 2 for p in points]
        squares[0] = squares[0] or squares[1] or top ** 2  # the stop at a cusp belongs to the leg that arrives there
        speeds, i = [], 0
        for n in range(len(self.points)):
            s = min(n * self._spacing, self.length)
            while i + 2 < len(points) and lengths[i + 1] < s:
                i += 1
            t = (s - lengths[i]) / (lengths[i + 1] - lengths[i])
            speeds.append(math.sqrt(max(0.0, squares[i] + t * (squares[i + 1] - squares[i]))))
        return speeds

    def _mean_curvatures(self, half_widths):
        """Of the vehicle's turn, from the headings, over `half_widths` [m] to either side, less near the ends."""
        last = len(self.points) - 1
        kappas = []
        for i, half_width in enumerate(half_widths):
            reach = min(max(1, int(half_width / self._spacing)), i, last - i)
            a, b = (i - reach, i + reach) if reach > 0 else (min(i, last - 1), max(i, 1))
            kappas.append(self.gear * (self._headings[b] - self._headings[a]) / ((b - a) * self._spacing))
        return kappas

    def _half_widths(self, kappas, speeds):
        """Of the mean curvature [m]. A jump dk spread over a width w displaces the path by dk w^2 / 24."""
        reach = int(1.0 / self._spacing) + 1
        half_widths = []
        for i, speed in enumerate(speeds):
            near = kappas[max(0, i - reach):i + reach + 1]
            jump = max(max(near) - min(near), 1e-6)
            half_widths.append(min(max(0.35 * speed, 0.5), 3.0, 0.5 * math.sqrt(24.0 * MAX_DISPLACEMENT / jump)))
        return half_widths

    def _braked(self, speeds, limits):
        """The squares of `speeds`, lowered to what a stop at the end and every slower point ahead ask for."""
        braking = 2.0 * 0.7 * limits.max_deceleration * self._spacing
        squares = [v * v for v in speeds]
        squares[-1] = 0.0
        for i in reversed(range(len(squares) - 1)):
            squares[i] = min(squares[i], squares[i + 1] + braking)
        return squares
