# SPDX-License-Identifier: Apache-2.0
"""Writes a map that was built by MapBuilder in Apollo's format, binary and text."""

import importlib.util
import os
import subprocess
import tempfile

from google.protobuf import text_format

PROTO_FILE = "external_command/proto/base_map.proto"


def write_map(builder, proto_folder, folder, version, projection):
    """Writes `folder`/base_map.txt and base_map.bin; the same map gives the same bytes.

    `proto_folder` holds PROTO_FILE; protoc must be installed.
    """
    message = to_message(builder, load_format(proto_folder), version, projection)
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "base_map.txt"), "w", encoding="utf-8") as file:
        file.write(text_format.MessageToString(message))
    with open(os.path.join(folder, "base_map.bin"), "wb") as file:
        file.write(message.SerializeToString(deterministic=True))


class MapWriter:
    """Writes a map part by part into one binary file: messages whose bytes follow each other are merged when read."""

    def __init__(self, file, proto_folder, version, projection):
        self._file = file
        self._pb2 = load_format(proto_folder)
        self._file.write(_header(self._pb2, version, projection).SerializeToString(deterministic=True))

    def write(self, builder):
        """Appends the objects of `builder`."""
        message = self._pb2.Map()
        _fill_map(message, builder, self._pb2)
        self._file.write(message.SerializeToString(deterministic=True))


def load_format(proto_folder):
    """The Python module of the map format, made by protoc."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["protoc", "--proto_path=" + proto_folder, "--python_out=" + folder, PROTO_FILE], check=True)
        path = os.path.join(folder, PROTO_FILE.replace(".proto", "_pb2.py"))
        spec = importlib.util.spec_from_file_location("base_map_pb2", path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module


def to_message(builder, pb2, version, projection):
    message = _header(pb2, version, projection)
    _fill_map(message, builder, pb2)
    return message


def _header(pb2, version, projection):
    message = pb2.Map()
    message.header.version = version.encode()
    message.header.projection.proj = projection.encode()
    return message


def _fill_map(message, builder, pb2):
    for lane in builder.lanes.values():
        _fill_lane(message.lane.add(), lane, pb2)
    for road in builder.roads:
        _fill_road(message.road.add(), road)
    for junction_id, polygon in builder.junctions.items():
        junction = message.junction.add()
        junction.id.id = junction_id.encode()
        _fill_points(junction.polygon, polygon)
    lanes = {lane.id.id.decode(): lane for lane in message.lane}
    for space in builder.parking_spaces:
        target = message.parking_space.add(heading=round(space.heading, 6))
        _fill_space(target, space, message, lanes)
    for space in builder.areas:
        target = message.ad_area.add(name=space.name.encode())
        _fill_space(target, space, message, lanes)


def _fill_lane(target, lane, pb2):
    target.id.id = lane.id.encode()
    _fill_points(target.central_curve.segment.add().line_segment, lane.center)
    for boundary, points, types in ((target.left_boundary, lane.left, lane.left_types),
                                    (target.right_boundary, lane.right, lane.right_types)):
        _fill_points(boundary.curve.segment.add().line_segment, points)
        boundary.virtual = not types
        for s, name in types:
            boundary.boundary_type.add(s=round(s, 3), types=[pb2.LaneBoundaryType.Type.Value(name)])
    target.length = round(lane.length, 3)
    target.speed_limit = lane.speed_limit
    target.type = pb2.Lane.CITY_DRIVING
    target.turn = pb2.Lane.LaneTurn.Value(lane.turn)
    target.direction = pb2.Lane.FORWARD
    for field, ids in (("predecessor_id", lane.predecessors), ("successor_id", lane.successors),
                       ("left_neighbor_forward_lane_id", lane.left_forward),
                       ("right_neighbor_forward_lane_id", lane.right_forward),
                       ("left_neighbor_reverse_lane_id", lane.left_reverse)):
        for lane_id in ids:
            getattr(target, field).add(id=lane_id.encode())
    if lane.junction:
        target.junction_id.id = lane.junction.encode()
    for samples in (target.left_sample, target.right_sample):
        for s in (0.0, target.length):
            samples.add(s=s, width=0.5 * lane.width)


def _fill_road(target, road):
    target.id.id = road.id.encode()
    for index, lane_ids in enumerate(road.sections):
        section = target.section.add()
        section.id.id = str(index).encode()
        for lane_id in lane_ids:
            section.lane_id.add(id=lane_id.encode())
    if road.junction:
        target.junction_id.id = road.junction.encode()


def _fill_space(target, space, message, lanes):
    """A parking space or area, and an overlap for each of its lanes."""
    target.id.id = space.id.encode()
    _fill_points(target.polygon, space.polygon)
    for lane_id, start_s, end_s in space.lanes:
        overlap = message.overlap.add()
        overlap.id.id = ("%s_%s" % (space.id, lane_id)).encode()
        lane_part = overlap.object.add()
        lane_part.id.id = lane_id.encode()
        lane_part.lane_overlap_info.start_s = round(start_s, 3)
        lane_part.lane_overlap_info.end_s = round(end_s, 3)
        overlap.object.add().id.id = space.id.encode()
        target.overlap_id.add(id=overlap.id.id)
        lanes[lane_id].overlap_id.add(id=overlap.id.id)


def _fill_points(target, points):
    for x, y in points:
        target.point.add(x=round(x, 3) + 0.0, y=round(y, 3) + 0.0)  # + 0.0 turns -0.0 into 0.0
