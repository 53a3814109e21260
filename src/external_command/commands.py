# SPDX-License-Identifier: Apache-2.0
"""The messages of all commands, made of plain values.

Poses are (x, y) or (x, y, heading), or what pose() returns; points (x, y); polygons lists of points. Metres, radians,
metres per second. Every command takes `id` (0: a fresh one) and `frame` (of all positions; "": map), a motion command
`dry_run` too: it is planned and answered, but not sent. Raises ValueError with a text for the user.
"""

from geometry_msgs.msg import Point

from external_command import any_message, msg


def _names(message, words):
    return {word.lower().replace("_", "-"): getattr(message, word) for word in words.split()}


ACTIONS = _names(msg.ActionCommand, "FOLLOW CHANGE_LEFT CHANGE_RIGHT PULL_OVER STOP START CLEAR_PLANNING "
                                    "SWITCH_TO_MANUAL SWITCH_TO_AUTO VIN_REQ ENTER_MISSION EXIT_MISSION")
MISSIONS = _names(msg.PreciseParkingCommand, "CHARGE DUMP")
TURN_SIGNALS = {name: getattr(msg.VehicleSignal, "TURN_" + name.upper()) for name in ("none", "left", "right", "hazard")}
SWITCHES = {None: msg.VehicleSignal.KEEP, True: msg.VehicleSignal.ON, False: msg.VehicleSignal.OFF}
MAP_OBJECTS = {"lanes": msg.MapObject.LANE, "roads": msg.MapObject.ROAD, "spaces": msg.MapObject.PARKING_SPACE,
               "areas": msg.MapObject.AREA}


def pose(x, y, heading=None, z=None, lane_id=""):
    """An external_command/Pose; without a heading any will do. `z` and `lane_id` tell apart lanes that lie there."""
    return msg.Pose(x=x, y=y, heading=heading or 0.0, has_heading=heading is not None, z=z or 0.0,
                    has_z=z is not None, lane_id=lane_id)


def polygon(points):
    """An external_command/RoiPolygon of (x, y)."""
    return msg.RoiPolygon(points=_points(points))


def lane_follow(x, y, heading=None, *, z=None, lane_id="", start=None, via=(), avoid_lanes=(), avoid_roads=(), speed=0.0,
                **common):
    """Drives along the lanes to a pose, through those of `via`, from the vehicle or `start`.

    `avoid_lanes`: ids, or (id, start_s, end_s) for parts of lanes. `avoid_roads`: ids.
    """
    return _motion(msg.LaneFollowCommand(end_pose=pose(x, y, heading, z, lane_id), **_way_points(start, via),
                                         **_black_list(avoid_lanes, avoid_roads)), speed, **common)


def valet_parking(space, *, start=None, via=(), avoid_lanes=(), avoid_roads=(), speed=0.0, **common):
    """Drives along the lanes to a parking space of the map, and parks in it. The others are as in lane_follow()."""
    return _motion(msg.ValetParkingCommand(parking_spot_id=space, **_way_points(start, via),
                                           **_black_list(avoid_lanes, avoid_roads)), speed, **common)


def precise_parking(x, y, heading, *, inwards=False, mission="charge", start=None, via=(), speed=0.0, **common):
    """Drives along the lanes to an area of the map, and parks there at an exact pose, nose in or nose out.

    `mission`: "charge" or "dump".
    """
    return _motion(msg.PreciseParkingCommand(parking_spot_pose=pose(x, y, heading), parking_inwards=inwards,
                                             mission_type=_choice("mission", mission, MISSIONS),
                                             **_way_points(start, via)), speed, **common)


def free_space(x, y, heading, *, drivable=(), obstacles=(), speed=0.0, **common):
    """Drives to a pose without lanes, inside the polygon `drivable` where it is given, and outside of `obstacles`."""
    return _motion(msg.FreeSpaceCommand(parking_spot_pose=pose(x, y, heading), **_regions(drivable, obstacles)), speed,
                   **common)


def path_follow(points, *, headings=(), end_heading=None, left_boundary=(), right_boundary=(), left_width=0.0,
                right_width=0.0, speed=0.0, **common):
    """Follows the points. Boundaries have a point for each of them; or widths from the path to its borders are given.

    Where `headings` (one for each point) point against the motion, the vehicle reverses.
    """
    return _motion(msg.PathFollowCommand(way_point=_points(points), heading=list(headings),
                                         has_end_heading=end_heading is not None, end_heading=end_heading or 0.0,
                                         left_boundary=_points(left_boundary), right_boundary=_points(right_boundary),
                                         left_path_width=left_width, right_path_width=right_width), speed, **common)


def zone_cover(area="", *, drivable=(), obstacles=(), swath_width=0.0, resume=False, skip_swaths=(), start=None, via=(),
               speed=0.0, **common):
    """Sweeps an area of the map, or the polygon `drivable`; with `resume` what an earlier run has left.

    `skip_swaths`: left for the end, counted from 0 in the order of the plan.
    """
    return _motion(msg.ZoneCoverCommand(zone_cover_area_id=area, swath_width=swath_width, resume=resume,
                                        skip_swath=list(skip_swaths), **_regions(drivable, obstacles),
                                        **_way_points(start, via)), speed, **common)


def action(name, **common):
    """One of ACTIONS: "stop", "pull-over" ..."""
    return _addressed(msg.ActionCommand(command=_choice("action", name, ACTIONS)), **common)


def speed(target=None, *, factor=None, restore=False, **common):
    """Changes the speed of the running motion command: to `target`, to a `factor` in [0, 1] of what was planned, or
    back to what that command said."""
    if sum((target is not None, factor is not None, bool(restore))) != 1:
        raise ValueError("speed: exactly one of target, factor and restore is needed")
    if restore:
        return _addressed(msg.SpeedCommand(kind=msg.SpeedCommand.RESTORE_TARGET_SPEED), **common)
    if factor is not None:
        return _addressed(msg.SpeedCommand(kind=msg.SpeedCommand.TARGET_SPEED_FACTOR, target_speed_factor=factor),
                          **common)
    return _addressed(msg.SpeedCommand(kind=msg.SpeedCommand.TARGET_SPEED, target_speed=target), **common)


def chassis(*, turn_signal=None, high_beam=None, low_beam=None, horn=None, emergency_light=None, custom_operation=None,
            **common):
    """Lights and horn: True, False, or None for as they are. `turn_signal`: one of TURN_SIGNALS.

    `custom_operation`: a ROS message of any type, passed on to the chassis.
    """
    signal = msg.VehicleSignal(high_beam=SWITCHES[high_beam], low_beam=SWITCHES[low_beam], horn=SWITCHES[horn],
                               emergency_light=SWITCHES[emergency_light])
    if turn_signal is not None:
        signal.turn_signal = _choice("turn_signal", turn_signal, TURN_SIGNALS)
    command = msg.ChassisCommand(basic_signal=signal)
    if custom_operation is not None:
        command.custom_operation = any_message.pack(custom_operation)
    return _addressed(command, **common)


def _motion(command, target_speed, dry_run=False, **common):
    command.target_speed = target_speed
    command.dry_run = dry_run
    return _addressed(command, **common)


def _addressed(command, id=0, frame=""):
    command.command_id = id
    command.header.frame_id = frame
    return command


def _way_points(start, via):
    poses = ([start] if start is not None else []) + list(via)
    return {"is_start_pose_set": start is not None, "way_point": [as_pose(value) for value in poses]}


def as_pose(value):
    """The Pose of (x, y) or (x, y, heading); a Pose as it is."""
    if isinstance(value, msg.Pose):
        return value
    if len(value) not in (2, 3):
        raise ValueError("a pose is (x, y) or (x, y, heading), not %d values" % len(value))
    return pose(*value)


def _points(values):
    return [value if isinstance(value, Point) else Point(value[0], value[1], 0.0) for value in values]


def _regions(drivable, obstacles):
    return {"drivable_roi": polygon(drivable), "non_drivable_roi": [polygon(points) for points in obstacles]}


def _black_list(lanes, roads):
    parts = [(lane, 0.0, 0.0) if isinstance(lane, str) else lane for lane in lanes]
    return {"blacklisted_lane": [msg.LaneSegment(*part) for part in parts], "blacklisted_road": list(roads)}


def _choice(field, name, known):
    if name not in known:
        raise ValueError("%s is %r; it must be one of %s" % (field, name, ", ".join(sorted(known))))
    return known[name]
