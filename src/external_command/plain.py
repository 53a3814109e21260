# SPDX-License-Identifier: Apache-2.0
"""ROS messages as dictionaries, lists, numbers and texts, for JSON."""

import math

import genpy

from external_command.errors import ERROR_NAMES, STATUS_NAMES
from external_command.msg import CommandStatus, MapObject

KIND_NAMES = {MapObject.LANE: "lane", MapObject.ROAD: "road", MapObject.PARKING_SPACE: "space", MapObject.AREA: "area"}


def plain(value):
    """Times are seconds; numbers that are not finite are None, since JSON has no others. A status has the names of its
    numbers beside them, and so has an object of the map."""
    if isinstance(value, genpy.Message):
        fields = {name: plain(getattr(value, name)) for name in value.__slots__}
        if isinstance(value, CommandStatus):
            fields["status_name"] = STATUS_NAMES.get(value.status, str(value.status))
            fields["error_name"] = ERROR_NAMES.get(value.error_code, str(value.error_code))
        if isinstance(value, MapObject):
            fields["kind_name"] = KIND_NAMES.get(value.kind, str(value.kind))
        return fields
    if isinstance(value, genpy.TVal):
        return value.to_sec()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, (list, tuple, bytes)):
        return [plain(one) for one in value]
    return value
