# SPDX-License-Identifier: Apache-2.0
"""ROS masters and launches that a test starts and ends itself, their output kept."""
import os
import re
import signal
import subprocess
import tempfile

import rosgraph
import roslib.packages

import support

SHADOWS = 4.0 if "TSAN_OPTIONS" in os.environ else 1.0  # sanitizers keep some of all memory that is touched
MOST_MEMORY = 100.0 * SHADOWS  # that hostile input may take beyond that at the beginning [MB]


def most_resident(pid):
    """Since the process began [MB]."""
    with open("/proc/%d/status" % pid, encoding="ascii") as file:
        return next(int(line.split()[1]) / 1000.0 for line in file if line.startswith("VmHWM:"))


class Process:
    """A program that ends with the `with` block, and all that it started, as far as it ends its children."""

    takes_output = None  # instead of the file that is kept

    def __init__(self, *command, **environment):
        self._command = command
        self._environment = dict(os.environ, **environment)
        self._log = tempfile.NamedTemporaryFile(prefix="process_", suffix=".log")
        self._process = None

    def __enter__(self):
        self.start()
        return self

    def start(self):
        """Once more after its end too."""
        self._process = subprocess.Popen(self._command, env=self._environment, stdin=subprocess.DEVNULL,
                                         stdout=self.takes_output or self._log, stderr=subprocess.STDOUT,
                                         start_new_session=True)

    def __exit__(self, *_):
        try:
            self.end()
        finally:
            self._log.close()

    def end(self):
        """SIGINT, as Ctrl-C does; SIGKILL where that does not help."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(support.DEADLINE)
        finally:
            self._process.kill()
            self._process.wait()

    def send_signal(self, number):
        self._process.send_signal(number)

    def wait_for_end(self):
        """The exit code."""
        return self._process.wait(support.DEADLINE)

    @property
    def pid(self):
        return self._process.pid

    @property
    def is_running(self):
        return self._process.poll() is None

    @property
    def output(self):
        """Without the colours of a terminal."""
        with open(self._log.name, encoding="utf-8", errors="replace") as log:
            return re.sub(r"\x1b\[[0-9;]*m", "", log.read())


class Node(Process):
    """An executable of this package; rosrun may find it in an install space too."""

    def __init__(self, executable, *arguments, **environment):
        super().__init__(roslib.packages.find_node("external_command", executable)[0], *arguments, **environment)


class Master(Process):
    """A ROS master of its own at `uri`, which becomes that of this process too."""

    def __init__(self, uri):
        os.environ["ROS_MASTER_URI"] = uri
        super().__init__("roscore", "-p", uri.rstrip("/").rpartition(":")[2])

    def __enter__(self):
        super().__enter__()
        support.wait_until(self._is_up, "the ROS master is up")
        return self

    @staticmethod
    def _is_up():
        """With the run's id, which roslaunch looks for."""
        try:
            return rosgraph.Master("/test").hasParam("/run_id")
        except OSError:
            return False


class Launch(Process):
    """roslaunch of a file of this package."""

    def __init__(self, file, **arguments):
        super().__init__("roslaunch", "external_command", file, *("%s:=%s" % item for item in arguments.items()))
