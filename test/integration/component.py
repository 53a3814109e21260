# SPDX-License-Identifier: Apache-2.0
"""The component as a process of a test: with parameters of its own, its output kept."""
import os
import signal
import subprocess
import tempfile

import roslib.packages
import rospkg
import rospy
import yaml

import support

LANE_FOLLOW = "external_command/LaneFollowCommandProcessor"


class Component:
    """`external_command_process` in `namespace`; `parameters`: those of the namespace. A parameter of the vehicle that is
    None is not set.

        with Component("/nowhere", {"external_command": {"processors": []}}) as component:
            code = component.wait_for_end()
    """

    def __init__(self, namespace, parameters, environment=None, output=None):
        """`output`: what takes the output, instead of a file that is kept."""
        self._output = output
        self.namespace = namespace
        self._parameters = parameters
        self._environment = dict(os.environ, **(environment or {}))
        self._log = tempfile.NamedTemporaryFile(prefix="component_", suffix=".log")
        self._process = None

    def __enter__(self):
        for key, value in self._complete(self._parameters).items():
            rospy.set_param(rospy.names.ns_join(self.namespace, key), value)
        self.start()
        return self

    def start(self):
        """Once more after its end too; with the parameters that are there."""
        executable = roslib.packages.find_node("external_command", "external_command_process")[0]
        self._process = subprocess.Popen(
            [executable, "__ns:=" + self.namespace, "__name:=external_command"], env=self._environment,
            stdin=subprocess.DEVNULL, stdout=self._output or self._log, stderr=subprocess.STDOUT)

    @staticmethod
    def _complete(parameters):
        """The size of the vehicle added, where the parameters do not say it."""
        own = parameters.get("external_command", {})
        vehicle = own.get("vehicle", {})
        if not own or not isinstance(vehicle, dict):
            return parameters
        config = os.path.join(rospkg.RosPack().get_path("external_command"), "config", "vehicle.yaml")
        with open(config, encoding="utf-8") as file:
            complete = dict(yaml.safe_load(file), **vehicle)
        size = {key: value for key, value in complete.items() if value is not None}
        return dict(parameters, external_command=dict(own, vehicle=size))

    def __exit__(self, *_):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(support.DEADLINE)
        finally:
            self._process.kill()
            self._log.close()
            if rospy.has_param(self.namespace):
                rospy.delete_param(self.namespace)

    @property
    def pid(self):
        return self._process.pid

    @property
    def is_running(self):
        return self._process.poll() is None

    @property
    def output(self):
        with open(self._log.name, encoding="utf-8", errors="replace") as log:
            return log.read()

    def send_signal(self, number):
        self._process.send_signal(number)

    def wait_for_end(self):
        """The exit code."""
        return self._process.wait(support.DEADLINE)

    def service(self, name, service_type):
        return support.service(rospy.names.ns_join(self.namespace, name), service_type)
