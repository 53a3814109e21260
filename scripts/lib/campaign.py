# SPDX-License-Identifier: Apache-2.0
"""A gateway that a campaign (scripts/fuzz, soak, faults) is run against, and the figures that come out.

Every figure is one line, `name value unit (limit)`; one beyond its limit is a fault, and so is what fault() is told of.
"""
import os
import tempfile
import threading
import time

import yaml

from demo_stack import DemoError, Stack

NAMESPACE = "apollo"
MB = 1e6


class Figures:
    """Thread-safe."""

    def __init__(self):
        self._lock = threading.Lock()
        self.faults = 0

    def show(self, name, value, unit="", limit=None):
        """`limit`: the most that is no fault."""
        is_beyond = limit is not None and not value <= limit
        with self._lock:
            self.faults += is_beyond
            print("%-46s %12s %-5s%s%s" % (
                name, "%.3f" % value if isinstance(value, float) else value, unit,
                "" if limit is None else " (limit %g)" % limit, "  FAULT" if is_beyond else ""), flush=True)

    def fault(self, what):
        with self._lock:
            self.faults += 1
            print("FAULT: %s" % what, flush=True)

    def exit_code(self):
        print("%d faults" % self.faults)
        return int(self.faults > 0)


class Gateway:
    """The component, with a ROS master of its own. Its parameters are those of config/external_command.yaml, with
    `changes`: {nodelet: {key: value}}. `log_dir`: of ROS, and of what all processes print. `parameters`: {name: value}
    of the ROS master, set before the component starts.

        with Gateway(root, build_dir, {"zone_cover_command_processor": {"obstacle_grid_name": "grid"}}) as gateway:
            gateway.rss()
    """

    def __init__(self, root, build_dir, changes=None, respawn=False, log_dir=None, parameters=None):
        self._root = root
        self._changes = changes or {}
        self._respawn = respawn
        self._parameters = parameters or {}
        self._folder = tempfile.TemporaryDirectory()
        self.folder = self._folder.name
        self.stack = Stack(build_dir, log_dir)
        self.pid = None

    def __enter__(self):
        try:
            self.start_master("master")
            self._set_parameters()
            self.stack.launch("external_command_process.launch", ns=NAMESPACE, config=self._config(),
                              map=os.path.join(self._root, "maps", "demo_town", "base_map.bin"),
                              respawn=str(self._respawn).lower())
            import rospy  # reads ROS_MASTER_URI when it is first imported
            rospy.init_node("campaign", anonymous=True, disable_signals=True)
            self.pid = self.stack.wait_for(self.find_pid, "the gateway", 60.0)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self.stack.end()
        self._folder.cleanup()

    def _set_parameters(self):
        import rosgraph
        master = rosgraph.Master("/campaign")
        for name, value in self._parameters.items():
            master.setParam(name, value)

    def _config(self):
        with open(os.path.join(self._root, "config", "external_command.yaml"), encoding="utf-8") as file:
            parameters = yaml.safe_load(file)
        for nodelet, values in self._changes.items():
            parameters[nodelet].update({key: value.format(folder=self.folder) if isinstance(value, str) else value
                                        for key, value in values.items()})
        path = os.path.join(self.folder, "config.yaml")
        with open(path, "w", encoding="utf-8") as file:
            yaml.safe_dump(parameters, file)
        return path

    def start_master(self, name):
        """Apart from roslaunch, which ends all that it has started where its own master dies."""
        import rosgraph
        self.stack.spawn(name, ["roscore", "-p", self.stack.master_uri.rpartition(":")[2]])
        self.stack.wait_for(rosgraph.is_master_online, "the ROS master", 30.0, name)

    @staticmethod
    def find_pid():
        """Of the process that serves now; None where none does."""
        import rosgraph
        import xmlrpc.client
        master = rosgraph.Master("/campaign")
        try:
            master.lookupService("/%s/external_command/command_status" % NAMESPACE)
            node = master.lookupNode("/%s/external_command" % NAMESPACE)
            return xmlrpc.client.ServerProxy(node).getPid("/campaign")[2]
        except (OSError, rosgraph.MasterException):
            return None

    def is_alive(self):
        return self.pid is not None and self.find_pid() == self.pid

    def rss(self):
        """Resident memory [MB]; 0 where the process is gone."""
        return memory_of(self.pid, "VmRSS")

    def call(self, service, command):
        from external_command.client import CommandClient
        return CommandClient(NAMESPACE).call(service, command)


def memory_of(pid, key):
    """[MB]"""
    try:
        with open("/proc/%d/status" % pid, encoding="ascii") as file:
            return next(float(line.split()[1]) * 1024 / MB for line in file if line.startswith(key + ":"))
    except (OSError, StopIteration):
        return 0.0


class Periodic:
    """Calls `job` in a thread of its own, every `period` [s], while it is entered."""

    def __init__(self, period, job):
        self._period = period
        self._job = job
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._end.set()
        self._thread.join()

    def _run(self):
        while not self._end.wait(self._period):
            self._job()


class MemoryWatch(Periodic):
    """The most memory that the gateway took while this is entered, beyond what it took at the beginning."""

    def __init__(self, gateway):
        super().__init__(0.1, self._look)
        self._gateway = gateway
        self.begin = gateway.rss()
        self.most = 0.0

    def _look(self):
        self.most = max(self.most, self._gateway.rss() - self.begin)


__all__ = ["DemoError", "Figures", "Gateway", "MemoryWatch", "NAMESPACE", "Periodic", "memory_of"]
