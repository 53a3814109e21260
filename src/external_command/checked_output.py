# SPDX-License-Identifier: Apache-2.0
"""What a program says may have nobody to read it, or no disk to go to: that is no failure of what it did."""

import os
import sys


class NotWritten(Exception):
    """A part of the output is lost; its cause is the OSError."""


class _CheckedStream:
    """A stream whose errors cannot be taken for those of files and sockets."""

    def __init__(self, stream):
        self._stream = stream

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def write(self, text):
        return self._checked(self._stream.write, text)

    def flush(self):
        return self._checked(self._stream.flush)

    @staticmethod
    def _checked(call, *arguments):
        try:
            return call(*arguments)
        except OSError as error:
            raise NotWritten(str(error)) from error


def exit_code_of(main, lost):
    """Calls `main()` and returns its exit code; `lost` where its output could not be written, of which it tells, unless
    who read it has gone away (`... | head`)."""
    if sys.stdout is None:
        return main()
    whole = sys.stdout
    sys.stdout = _CheckedStream(whole)
    try:
        code = main()
        sys.stdout.flush()
        return code
    except NotWritten as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), whole.fileno())  # Python writes what is left of it at its end
        if not isinstance(error.__cause__, BrokenPipeError):
            print("the output could not be written: %s" % error, file=sys.stderr)
        return lost
    finally:
        sys.stdout = whole
