# SPDX-License-Identifier: Apache-2.0
"""Completion of command lines by the shell, where python3-argcomplete is installed; doc/command_line.md tells how."""

TIMEOUT = 1.0  # of an answer that is to be offered [s]
MOST = 1000  # ids to choose from


def complete(parser):
    """To be called with an argparse parser before it parses."""
    try:
        import argcomplete
    except ImportError:
        return
    argcomplete.autocomplete(parser)


def complete_by(action, completer):
    """Lets `completer(prefix, parsed_args, **_)` offer the values of an option or argument."""
    action.completer = completer
    return action


def ids_of(kind):
    """Offers the ids of the map's "spaces", "areas", "lanes" or "roads"; nothing where no gateway runs."""
    return lambda prefix, parsed_args, **_: _offered(
        parsed_args, lambda client: [found.id for found in client.map_objects(kind, max_count=MOST)], prefix)


def running_ids(prefix, parsed_args, **_):
    """Offers the ids of the commands that run."""
    return _offered(parsed_args, lambda client: [str(status.command_id) for status in client.current().running], prefix)


def _offered(parsed_args, ask, prefix):
    import rospy

    from external_command.client import CommandClient, CommandError, ServiceUnavailable
    from external_command.master import missing_master
    if missing_master():
        return []
    rospy.init_node("external_command_completion", anonymous=True, disable_signals=True, log_level=rospy.FATAL)
    try:
        answers = ask(CommandClient(getattr(parsed_args, "ns", "apollo"), TIMEOUT))
    except (CommandError, ServiceUnavailable, rospy.ROSException):
        return []
    return [answer for answer in answers if answer.startswith(prefix)]
