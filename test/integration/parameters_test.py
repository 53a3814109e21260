#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""doc/parameters.md and the files in config/ name the parameters that a gateway asks for, neither more nor less."""
import os
import re
import sys
import unittest

import rospy
import rostest
import yaml

import support
from component import Component, configuration
from parameter_spy import ParameterSpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "support"))
import document_tables as document  # noqa: E402  (of this package's sources)

NAMESPACE = "/parameters_test"
ADAPTERS = ["external_command/OldRoutingAdapter", "external_command/MoveBaseAdapter"]
NOT_SET = object()
# What nodelet and the gateway read for themselves, and `~map_file`, by which a processor sees whether it is on its own.
OTHERS = re.compile(r"^\w+$|^external_command/(num_worker_threads|start_failures/.*)$|^(?!external_command/)\w+/map_file$")


def leaves(tree, prefix=""):
    found = {}
    for key, value in tree.items():
        found.update(leaves(value, prefix + key + "/") if isinstance(value, dict) else {prefix + key: value})
    return found


def documented():
    """{name: default} of doc/parameters.md."""
    found = {}
    text = document.page("parameters.md").split("\n## Others\n")[0]
    for part in re.split(r"^(?=Below )", text, flags=re.MULTILINE)[1:]:
        for nodelet in re.findall(r"`(\w+)`", part.split("\n\n")[0]):
            for key, default, _ in document.rows(part):
                name = "%s/%s" % (nodelet, document.code(key))
                assert name not in found, "doc/parameters.md has %s twice" % name
                value = document.code(default)
                own_name = nodelet.replace("_command_processor", "")
                found[name] = NOT_SET if value is None else yaml.safe_load(value.replace("NAME", own_name))
    return found


class ParametersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.configured = configuration(more_processors=ADAPTERS)
        with ParameterSpy() as spy:
            with Component(NAMESPACE, cls.configured, {"ROS_MASTER_URI": spy.uri}) as gateway:
                support.wait_until(lambda: "is ready" in gateway.output or not gateway.is_running, "it is ready")
                assert gateway.is_running, gateway.output
                asked = {name[len(NAMESPACE) + 1:] for name in spy.asked_below(NAMESPACE)}
        cls.asked = {name for name in asked if not OTHERS.match(name)}

    def test_the_page_names_what_the_gateway_asks_for(self):
        self.assertGreater(len(self.asked), 200)
        self.assertEqual(self.asked, set(documented()))

    def test_the_files_set_what_the_page_says_and_nothing_else(self):
        told = documented()
        configured = leaves(self.configured)
        self.assertEqual(set(configured) - set(told), set())
        self.assertEqual({name for name, value in told.items() if value is NOT_SET},
                         (set(told) - set(configured)) | {"external_command/processors"})
        for name, value in configured.items():
            if told[name] is not NOT_SET and not name.endswith("/more_processors"):
                self.assertEqual(told[name], value, name)


if __name__ == "__main__":
    rospy.init_node("parameters_test")
    rostest.rosrun("external_command", "parameters", ParametersTest)
