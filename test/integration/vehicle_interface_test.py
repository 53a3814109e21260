#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""doc/vehicle_interface.md names the topics and services that a gateway has, with their types, neither more nor less."""
import os
import sys
import unittest

import rosgraph
import rospy
import rosservice
import rostest

import support

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "support"))
import document_tables as document  # noqa: E402  (of this package's sources)

GATEWAY = "/apollo/external_command"
OF_EVERY_NODE = ("/rosout", "/get_loggers", "/set_logger_level", "/load_nodelet", "/unload_nodelet", "/list")


def told(title, first="|"):
    """{full name: other cells} of the tables of a section that begin with `first`."""
    text = document.section(document.page("vehicle_interface.md"), title)
    text = "\n\n".join(part for part in text.split("\n\n") if part.startswith(first))
    return {rosgraph.names.ns_join("/apollo", document.code(name)): cells for name, *cells in document.rows(text)}


def heads_of(subscriber):
    """What the publishers say of themselves, once they have."""
    return [link.header for link in subscriber.impl.connections if getattr(link, "header", None)]


def action_topics(parts):
    """{full name: type} of the topics of each action; `parts` are those of actionlib."""
    types = {"goal": "%sActionGoal", "cancel": "actionlib_msgs/GoalID", "status": "actionlib_msgs/GoalStatusArray",
             "feedback": "%sActionFeedback", "result": "%sActionResult"}
    return {name + "/" + part: types[part].replace("%s", document.code(action_type))
            for name, (action_type,) in told("What the gateway answers", "| action |").items() for part in parts}


class VehicleInterfaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        master = rosgraph.Master(rospy.get_name())
        support.wait_until(lambda: GATEWAY + "/command_status" in rosservice.get_service_list(), "it is ready")
        cls.types = dict(master.getTopicTypes())
        cls.published, cls.subscribed, cls.served = ({
            name for name, nodes in names if GATEWAY in nodes and not name.endswith(OF_EVERY_NODE)
        } for names in master.getSystemState())

    def test_topics_that_the_gateway_publishes(self):
        topics = {name: document.code(cells[0]) for name, cells in told("What the gateway tells").items()}
        topics.update(action_topics(("status", "feedback", "result")))
        self.assertEqual(self.published, set(topics))
        for name, message_type in topics.items():
            self.assertEqual(message_type, self.types[name], name)

    def test_topics_that_it_keeps_the_last_message_of(self):
        for name, (_, _, latched, _) in told("What the gateway tells").items():
            self.assertIn(latched, ("yes", "no"), name)
            subscriber = rospy.Subscriber(name, rospy.AnyMsg)
            support.wait_until(lambda: heads_of(subscriber), "a connection to " + name)  # pylint: disable=cell-var-from-loop
            self.assertEqual([head.get("latching") == "1" for head in heads_of(subscriber)], [latched == "yes"], name)
            subscriber.unregister()

    def test_topics_that_the_gateway_hears(self):
        topics = {name: document.code(cells[0]) for name, cells in told("What the gateway hears").items()}
        topics.update(action_topics(("goal", "cancel")))
        self.assertEqual(self.subscribed, set(topics))
        for name, message_type in topics.items():
            self.assertIn(self.types[name], (message_type, "*"), name)  # *: nobody publishes it

    def test_services(self):
        services = told("What the gateway answers", "| service |")
        self.assertEqual(self.served, set(services))
        for name, (service_type, *_) in services.items():
            self.assertEqual(document.code(service_type), rosservice.get_service_type(name), name)


if __name__ == "__main__":
    rospy.init_node("vehicle_interface_test")
    rostest.rosrun("external_command", "vehicle_interface", VehicleInterfaceTest)
