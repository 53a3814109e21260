# SPDX-License-Identifier: Apache-2.0
"""Packs a ROS message of any type into external_command/Any, and unpacks it again.

    command.custom_command = pack(my_message)
    my_message = unpack(command.custom_command, MyMessage)
"""

import io

import genpy

from external_command.msg import Any


class WrongType(ValueError):
    """The Any holds another type than asked for, another version of it, or broken data; the text says which."""


def pack(message):
    """The Any that carries `message`. Raises WrongType where it is no message or its fields have the wrong types."""
    if not isinstance(message, genpy.Message):
        raise WrongType("a %s cannot be packed; a ROS message is needed" % type(message).__name__)
    try:
        data = _serialized(message)
    except genpy.SerializationError as error:
        raise WrongType("a %s cannot be packed: %s" % (message._type, error)) from error
    return Any(type=message._type, md5sum=message._md5sum, data=data)


def holds(any_message, message_class):
    """True where `any_message` holds a `message_class`, of this very definition."""
    return any_message.type == message_class._type and any_message.md5sum == message_class._md5sum


def unpack(any_message, message_class):
    """The message in `any_message`. Raises WrongType where that is not a `message_class`."""
    if any_message.type != message_class._type:
        raise WrongType("the Any holds %s, not %s" %
                        ("a " + any_message.type if any_message.type else "nothing", message_class._type))
    if any_message.md5sum != message_class._md5sum:
        raise WrongType("the Any holds a %s with md5 %s, here it has md5 %s: build both from the same definition" %
                        (any_message.type, any_message.md5sum or "(none)", message_class._md5sum))
    message = message_class()
    try:
        message.deserialize(bytes(any_message.data))
    except (genpy.DeserializationError, UnicodeDecodeError) as error:
        raise WrongType("the %s in the Any is broken: %s" % (any_message.type, error)) from error
    used = len(_serialized(message))
    if used != len(any_message.data):
        raise WrongType("the %s in the Any is broken: %d bytes, of which %d belong to it" %
                        (any_message.type, len(any_message.data), used))
    return message


def _serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
