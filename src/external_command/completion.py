# SPDX-License-Identifier: Apache-2.0
"""Completion of command lines by the shell, where python3-argcomplete is installed; doc/command_line.md tells how."""


def complete(parser):
    """To be called with an argparse parser before it parses."""
    try:
        import argcomplete
    except ImportError:
        return
    argcomplete.autocomplete(parser)


def complete_by(action, completer):
    """Lets `completer(prefix, **kwargs)` offer the values of an option or argument."""
    action.completer = completer
    return action
