# SPDX-License-Identifier: Apache-2.0
"""Processes that carry a mark in their environment, and the end of them.

roslaunch and rostest put each node into a process group of its own, so that killing a group or a parent leaves nodes
behind. The environment is inherited whatever a process does with groups and sessions; a mark in it finds them all.
"""
import os
import signal
import time
import uuid

VARIABLE = "EC_OWNED_BY"


def new_mark():
    return f"{VARIABLE}={uuid.uuid4().hex}"


def marked_environment(mark, **more):
    """The present environment with the mark, and with `more` variables."""
    name, value = mark.split("=", 1)
    return {**os.environ, **more, name: value}


def pids(mark):
    """Process ids of all living processes that carry the mark, this process excepted."""
    wanted = mark.encode()
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit() and int(entry) != os.getpid() and _carries(entry, wanted):
            found.append(int(entry))
    return found


def end_all(mark, patience=10.0):
    """Ends all processes that carry the mark: SIGINT (what roslaunch and nodes expect), SIGTERM, then SIGKILL.

    `patience` [s] is how long to wait after each of the first two. Returns how many had to be killed.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        _send(number, pids(mark))
        deadline = time.monotonic() + patience
        while time.monotonic() < deadline:
            if not pids(mark):
                return 0
            time.sleep(0.05)
    stubborn = pids(mark)
    while pids(mark):
        _send(signal.SIGKILL, pids(mark))
        time.sleep(0.05)
    return len(stubborn)


def _carries(pid, wanted):
    try:
        with open(f"/proc/{pid}/environ", "rb") as environ, open(f"/proc/{pid}/stat", "rb") as stat:
            is_dead = stat.read().rpartition(b")")[2].split()[0] in (b"Z", b"X")
            return not is_dead and wanted in environ.read().split(b"\0")
    except OSError:  # ended meanwhile, or somebody else's
        return False


def _send(number, targets):
    for pid in targets:
        try:
            os.kill(pid, number)
        except ProcessLookupError:
            pass
