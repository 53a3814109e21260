# SPDX-License-Identifier: Apache-2.0
"""Processes of the demo and of benchmarks: ROS master and nodes by roslaunch, and what else is started."""
import os
import socket
import subprocess
import time

import owned_processes


class DemoError(Exception):
    """The text tells a person what went wrong, and where to look."""


class Stack:
    """Processes that end together. Their output goes to files in `log_dir`, by default in the build folder."""

    def __init__(self, build_dir, log_dir=None):
        self.mark = owned_processes.new_mark()
        self.log_dir = log_dir or os.path.join(build_dir, "demo_logs")
        self.master_uri = f"http://localhost:{free_port()}"
        self._processes = {}  # name -> Popen
        os.makedirs(self.log_dir, exist_ok=True)
        os.environ.update(ROS_MASTER_URI=self.master_uri, ROS_HOSTNAME="localhost",
                          ROS_LOG_DIR=os.path.join(self.log_dir, "ros"))

    def launch(self, launch_file, **arguments):
        """Starts a ROS master and what a launch file of this package names."""
        self.spawn("roslaunch", ["roslaunch", "--port", self.master_uri.rpartition(":")[2], "external_command",
                                 launch_file, *(f"{name}:={value}" for name, value in {"respawn": "false", **arguments}.items())])

    def spawn(self, name, command, pass_fds=(), **environment):
        """Starts a process that ends with the others; `environment`: additional variables."""
        with open(self.log_file(name), "wb") as log:
            self._processes[name] = subprocess.Popen(
                command, env=owned_processes.marked_environment(self.mark, **environment), stdin=subprocess.DEVNULL,
                stdout=log, stderr=subprocess.STDOUT, start_new_session=True, pass_fds=pass_fds)

    def log_file(self, name):
        return os.path.join(self.log_dir, name + ".log")

    def wait_for(self, condition, what, timeout, name="roslaunch"):
        """Waits until `condition()` is true, and returns what it returned.

        Raises DemoError where process `name` ends before, or after `timeout` [s]; `what` names what was waited for.
        """
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            result = condition()
            if result:
                return result
            self.check(name)
            time.sleep(0.1)
        raise DemoError(f"{what}: not there after {timeout:.0f} s\n{self._last_words(name)}")

    def check(self, name="roslaunch"):
        """Raises DemoError where process `name`, or a node of roslaunch, has ended."""
        code = self._processes[name].poll()
        if code is not None:
            raise DemoError(f"{name} has ended with exit code {code}\n{self._last_words(name)}")
        if name == "roslaunch" and "] process has died" in self._output(name):
            raise DemoError(f"a node has died\n{self._last_words(name)}")

    def end(self):
        owned_processes.end_all(self.mark)
        for process in self._processes.values():
            process.wait()

    def _output(self, name):
        with open(self.log_file(name), encoding="utf-8", errors="replace") as file:
            return file.read()

    def _last_words(self, name):
        lines = self._output(name).splitlines()[-15:]
        return "\n".join([*lines, f"(all of it: {self.log_file(name)})"])


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]
