# SPDX-License-Identifier: Apache-2.0
"""Builds an HD map of streets, junctions, roundabouts, parking rows and areas, for traffic on the right.

A street is a centre line with lanes to either side, cut into sections; lanes count from the centre line outwards.
A junction connects the ends of streets by lanes without markings.
"""

import dataclasses
import math
from typing import Dict, List, Tuple

from external_command import map_curves as curves
from external_command.plane import direction, moved, wrap_angle

SOLID_LINE_LENGTH = 25.0  # before a junction, in which lanes may not be changed [m]
TURN_ANGLE = math.radians(40.0)  # a connection that turns more is a turn


@dataclasses.dataclass
class Lane:
    id: str
    center: list
    left: list
    right: list
    left_types: List[Tuple[float, str]]  # (s [m] from which on, LaneBoundaryType of the map format)
    right_types: List[Tuple[float, str]]
    width: float  # [m]
    speed_limit: float  # [m/s]
    turn: str = "NO_TURN"
    junction: str = ""
    predecessors: List[str] = dataclasses.field(default_factory=list)
    successors: List[str] = dataclasses.field(default_factory=list)
    left_forward: List[str] = dataclasses.field(default_factory=list)
    right_forward: List[str] = dataclasses.field(default_factory=list)
    left_reverse: List[str] = dataclasses.field(default_factory=list)

    @property
    def length(self):
        return curves.length(self.center)


@dataclasses.dataclass(frozen=True)
class StreetKind:
    lanes: int  # in each direction
    speed_limit: float  # [m/s]
    width: float = 3.5  # of a lane [m]


@dataclasses.dataclass
class Street:
    """`forward` and `backward`: for each section, in the direction driven, its lanes from the centre line outwards."""

    id: str
    center: list
    width: float  # of a lane [m]
    forward: List[List[Lane]]
    backward: List[List[Lane]]


@dataclasses.dataclass
class Road:
    id: str
    sections: List[List[str]]  # lane ids
    junction: str = ""


@dataclasses.dataclass
class Space:
    """A parking space or an area. `lanes`: (lane id, start s, end s) that overlap it."""

    id: str
    polygon: list
    lanes: List[Tuple[str, float, float]]
    heading: float = 0.0  # of a vehicle parked nose in [rad]
    name: str = ""


@dataclasses.dataclass(frozen=True)
class Arm:
    """A street as seen from a junction: where it ends or, with `at_start`, where it begins."""

    street: Street
    at_start: bool

    @property
    def incoming(self):
        return self.street.backward[-1] if self.at_start else self.street.forward[-1]

    @property
    def outgoing(self):
        return self.street.forward[0] if self.at_start else self.street.backward[0]

    @property
    def end(self):
        return self.street.center[0] if self.at_start else self.street.center[-1]

    @property
    def heading(self):
        """Towards the junction."""
        center = self.street.center
        return direction(center[1], center[0]) if self.at_start else direction(center[-2], center[-1])


class MapBuilder:
    """Collects the objects of a map; ids must be unique (ValueError)."""

    def __init__(self):
        self.lanes: Dict[str, Lane] = {}
        self.roads: List[Road] = []
        self.junctions: Dict[str, list] = {}  # id -> polygon
        self.parking_spaces: List[Space] = []
        self.areas: List[Space] = []

    def add_street(self, id, center, kind, sections=1):
        """Lanes to both sides of `center`, cut evenly into `sections`. `center` has evenly spaced points."""
        last = len(center) - 1
        cuts = [round(n * last / sections) for n in range(sections + 1)]
        numbers = list(range(sections))
        forward = self._add_direction(["%s_%d_f" % (id, n) for n in numbers], center, cuts, kind)
        backward = self._add_direction(["%s_%d_b" % (id, n) for n in numbers[::-1]], center[::-1],
                                       [last - c for c in reversed(cuts)], kind)
        lanes_by_number = list(zip(forward, reversed(backward)))
        for ahead, back in lanes_by_number:
            ahead[0].left_reverse.append(back[0].id)
            back[0].left_reverse.append(ahead[0].id)
        self.roads.append(Road(id, [[lane.id for lane in ahead + back] for ahead, back in lanes_by_number]))
        return Street(id, center, kind.width, forward, backward)

    def add_junction(self, id, arms):
        """Lanes from each arm to every other: right turns from the outer lane, left turns from the inner one."""
        self._add_junction_polygon(id, arms)
        for start in arms:
            for end in arms:
                if start.street is not end.street:
                    self._connect_arms(id, start, end)

    def add_roundabout(self, id, center, radius, arms, speed_limit):
        """A ring of one lane, driven counter-clockwise, with an exit before and an entry after each arm."""
        self._add_junction_polygon(id, arms)
        half_gap = math.radians(25.0)  # on the ring, between the arm and its exit or entry
        arms = sorted(arms, key=lambda arm: direction(center, arm.end) % (2.0 * math.pi))
        angles = [direction(center, arm.end) % (2.0 * math.pi) for arm in arms]
        angles.append(angles[0] + 2.0 * math.pi)
        ring = []  # before each arm, then from its exit to its entry
        for i, (angle, following) in enumerate(zip(angles, angles[1:])):
            for name, a, b in (("arm", angle - half_gap, angle + half_gap),
                               ("arc", angle + half_gap, following - half_gap)):
                ring.append(self._add_connection("%s_%s_%d" % (id, name, i), curves.arc(center, radius, a, b), id,
                                                 arms[0].street.width, speed_limit))
        for a, b in zip(ring, ring[1:] + ring[:1]):
            _connect(a, b)
        for i, arm in enumerate(arms):
            at_arm = ring[2 * i]
            self._connect_lanes("%s_entry_%d" % (id, i), id, arm.incoming[0], ring[2 * i + 1], speed_limit)
            self._connect_lanes("%s_exit_%d" % (id, i), id, ring[2 * i - 1], arm.outgoing[0], speed_limit)
            self.roads.append(Road("%s_road_%d" % (id, i), [[at_arm.id, ring[2 * i + 1].id, "%s_entry_%d" % (id, i),
                                                            "%s_exit_%d" % (id, i)]], id))

    def add_parking_row(self, id, street, side, near, count, is_parallel, size):
        """`count` spaces along a straight part of `street`, at its "left" or "right" border, in the direction of travel
        there, from the point nearest to `near` on. `size`: (along the street, across it) [m]."""
        outward = street.forward if side == "right" else street.backward
        center = street.center if side == "right" else street.center[::-1]
        border = len(outward[0]) * street.width
        start = curves.project(center, near)
        for i in range(count):
            (a, heading), (b, _) = (curves.at(center, start + (i + n) * size[0]) for n in (0, 1))
            polygon = [moved(a, heading, 0.0, -border), moved(a, heading, 0.0, -border - size[1]),
                       moved(b, heading, 0.0, -border - size[1]), moved(b, heading, 0.0, -border)]
            beside = [section[-1] for section in outward]
            if not is_parallel:
                beside += [section[-1] for section in (street.backward if side == "right" else street.forward)]
            lanes = [_overlap(lane, polygon[0], polygon[3]) for lane in beside]
            self.parking_spaces.append(Space("%s_%d" % (id, i), polygon, [o for o in lanes if o[2] - o[1] > 0.5],
                                             wrap_angle(heading if is_parallel else heading - math.pi / 2.0)))

    def add_area(self, id, name, polygon):
        """With an overlap for every lane that runs through."""
        overlaps = []
        for lane in self.lanes.values():
            # Rounded, since in the last bit of a point exactly on a border Python's versions differ.
            points = [[round(c, 6) for c in curves.at(lane.center, 0.1 * i)[0]] for i in range(int(10.0 * lane.length) + 1)]
            inside = [0.1 * i for i, point in enumerate(points) if curves.contains(polygon, point)]
            if inside:
                overlaps.append((lane.id, inside[0], inside[-1]))
        self.areas.append(Space(id, polygon, overlaps, name=name))

    def take_out(self, is_wanted):
        """Moves the roads of whose id `is_wanted` is true, with their lanes and the parking spaces beside these, and all
        junctions, into a builder of their own, and returns that."""
        taken = MapBuilder()
        taken.roads = [road for road in self.roads if is_wanted(road.id)]
        self.roads = [road for road in self.roads if not is_wanted(road.id)]
        taken.lanes = {lane_id: self.lanes.pop(lane_id)
                       for road in taken.roads for section in road.sections for lane_id in section}
        taken.parking_spaces = [space for space in self.parking_spaces if space.lanes[0][0] in taken.lanes]
        self.parking_spaces = [space for space in self.parking_spaces if space.lanes[0][0] in self.lanes]
        taken.junctions, self.junctions = self.junctions, {}
        return taken

    def _add_direction(self, prefixes, center, cuts, kind):
        """For each section its lanes to the right of `center`, in its direction, from there outwards."""
        lines = [curves.offset(center, -0.5 * kind.width * n) for n in range(2 * kind.lanes + 1)]
        sections = []
        for prefix, first, last in zip(prefixes, cuts, cuts[1:]):
            parts = [curves.thinned(line[first:last + 1]) for line in lines]
            sections.append(self._add_section(prefix, parts, kind, prefix == prefixes[-1]))
        for before, after in zip(sections, sections[1:]):
            for a, b in zip(before, after):
                _connect(a, b)
        return sections

    def _add_section(self, prefix, lines, kind, is_last):
        """`lines`: a border, then the middle and the outer border of each lane."""
        lanes = []
        for i in range(kind.lanes):
            left, middle, right = lines[2 * i:2 * i + 3]
            border = [(0.0, "DOTTED_WHITE")]
            if is_last:
                solid = min(SOLID_LINE_LENGTH, 0.3 * curves.length(middle))
                border.append((curves.length(middle) - solid, "SOLID_WHITE"))
            street_middle = [(0.0, "DOUBLE_YELLOW" if kind.lanes > 1 else "DOTTED_YELLOW")]
            lane = Lane("%s%d" % (prefix, i), middle, left, right, street_middle if i == 0 else border,
                        [(0.0, "CURB")] if i == kind.lanes - 1 else border, kind.width, kind.speed_limit)
            if lanes:
                lane.left_forward.append(lanes[-1].id)
                lanes[-1].right_forward.append(lane.id)
            lanes.append(self._add_lane(lane))
        return lanes

    def _connect_arms(self, id, start, end):
        angle = wrap_angle(end.heading + math.pi - start.heading)
        if angle > TURN_ANGLE:
            pairs = [(start.incoming[0], end.outgoing[0])]
        elif angle < -TURN_ANGLE:
            pairs = [(start.incoming[-1], end.outgoing[-1])]
        else:
            pairs = list(zip(start.incoming, end.outgoing))
        lanes = []
        for i, (a, b) in enumerate(pairs):
            speed = min(a.speed_limit, b.speed_limit, math.inf if abs(angle) <= TURN_ANGLE else 6.0)
            lane_id = "%s_%s_%s_%d" % (id, start.street.id, end.street.id, i)
            lanes.append(self._connect_lanes(lane_id, id, a, b, speed).id)
        self.roads.append(Road("%s_%s_%s" % (id, start.street.id, end.street.id), [lanes], id))

    def _connect_lanes(self, lane_id, junction, start, end, speed_limit):
        center = curves.blend(start.center[-1], direction(*start.center[-2:]),
                              end.center[0], direction(*end.center[:2]))
        lane = self._add_connection(lane_id, center, junction, start.width, speed_limit)
        _connect(start, lane)
        _connect(lane, end)
        return lane

    def _add_connection(self, lane_id, center, junction, width, speed_limit):
        angle = wrap_angle(direction(*center[-2:]) - direction(*center[:2]))
        turn = "LEFT_TURN" if angle > TURN_ANGLE else "RIGHT_TURN" if angle < -TURN_ANGLE else "NO_TURN"
        left, right = (curves.thinned(curves.resampled(curves.offset(center, side * width), 1.5))
                       for side in (0.5, -0.5))
        return self._add_lane(Lane(lane_id, curves.thinned(center), left, right, [], [], width, speed_limit, turn,
                                   junction))

    def _add_junction_polygon(self, id, arms):
        edges = []
        for arm in arms:
            half_width = len(arm.incoming) * arm.street.width
            edges += [moved(arm.end, arm.heading, 0.0, side * half_width) for side in (-1.0, 1.0)]
        if id in self.junctions:
            raise ValueError("there are two junctions %s" % id)
        self.junctions[id] = curves.convex_hull(edges)

    def _add_lane(self, lane):
        if lane.id in self.lanes:
            raise ValueError("there are two lanes %s" % lane.id)
        self.lanes[lane.id] = lane
        return lane


def _connect(before, after):
    before.successors.append(after.id)
    after.predecessors.append(before.id)


def _overlap(lane, a, b):
    """(lane id, start s, end s) of the part of `lane` abreast of two points."""
    start_s, end_s = sorted((curves.project(lane.center, a), curves.project(lane.center, b)))
    return lane.id, start_s, end_s
