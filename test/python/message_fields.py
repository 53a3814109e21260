# SPDX-License-Identifier: Apache-2.0
"""The fields of messages, down to numbers and texts, by names such as `end_pose.heading` and `way_point.x`."""
import genpy
import roslib.message
from geometry_msgs.msg import Point


def fields_of(message_class):
    """Of every message that may be inside, lists with one. The z of points is ignored by all commands."""
    if message_class is Point:
        return {"x", "y"}
    names = set()
    for name, slot_type in zip(message_class.__slots__, message_class._slot_types):
        inner = roslib.message.get_message_class(slot_type.split("[")[0]) if "/" in slot_type else None
        names |= {"%s.%s" % (name, below) for below in fields_of(inner)} if inner else {name}
    return names


def set_fields_of(message):
    """Those that are not as in a message that is fresh."""
    names, fresh = set(), type(message)()
    for name in message.__slots__:
        value = getattr(message, name)
        if isinstance(value, genpy.Message):
            names |= {"%s.%s" % (name, below) for below in set_fields_of(value)}
        elif isinstance(value, (list, tuple)) and value and isinstance(value[0], genpy.Message):
            names |= {"%s.%s" % (name, below) for one in value for below in set_fields_of(one)}
        elif value != getattr(fresh, name):
            names.add(name)
    return names
