# SPDX-License-Identifier: Apache-2.0
"""The component as a process of a test, with parameters of its own."""
import os

import rospkg
import rospy
import yaml

import support
from processes import Node

LANE_FOLLOW = "external_command/LaneFollowCommandProcessor"


def read(*path):
    """What a YAML file of the package holds."""
    with open(os.path.join(rospkg.RosPack().get_path("external_command"), *path), encoding="utf-8") as file:
        return yaml.safe_load(file)


def configuration(**changes):
    """The parameters of the files in config/, with `changes` of the component's own."""
    parameters = read("config", "external_command.yaml")
    own = dict(read("config", "processors.yaml"), vehicle=read("config", "vehicle.yaml"))
    parameters["external_command"].update(own, **changes)
    return parameters


def patient(processor, **others):
    """Parameters of a processor that plans on a slow or busy machine too, beside `others`."""
    return dict(read("test", "support", "patient.yaml")[processor], **others)


class Component(Node):
    """`external_command_process` in `namespace`; `parameters`: those of the namespace. A parameter of the vehicle that is
    None is not set.

        with Component("/nowhere", {"external_command": {"processors": []}}) as component:
            code = component.wait_for_end()
    """

    def __init__(self, namespace, parameters, environment=None, output=None):
        """`output`: what takes the output, instead of a file that is kept."""
        super().__init__("external_command_process", "__ns:=" + namespace, "__name:=external_command",
                         **(environment or {}))
        self.takes_output = output
        self.namespace = namespace
        self._parameters = parameters

    def __enter__(self):
        for key, value in self._complete(self._parameters).items():
            rospy.set_param(rospy.names.ns_join(self.namespace, key), value)
        return super().__enter__()

    def __exit__(self, *error):
        try:
            super().__exit__(*error)
        finally:
            if rospy.has_param(self.namespace):
                rospy.delete_param(self.namespace)

    @staticmethod
    def _complete(parameters):
        """The size of the vehicle added, where the parameters do not say it."""
        own = parameters.get("external_command", {})
        vehicle = own.get("vehicle", {})
        if not own or not isinstance(vehicle, dict):
            return parameters
        complete = dict(configuration()["external_command"]["vehicle"], **vehicle)
        size = {key: value for key, value in complete.items() if value is not None}
        return dict(parameters, external_command=dict(own, vehicle=size))

    def service(self, name, service_type):
        return support.service(rospy.names.ns_join(self.namespace, name), service_type)
