#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The adapter for legacy routing requests, with services that are the test's own."""
import threading
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point

import support
from external_command.msg import CommandStatus, LaneWaypoint, RoutingRequest, RoutingResponse
from external_command.srv import LaneFollow, LaneFollowResponse


class OldRoutingAloneTest(unittest.TestCase):
    def setUp(self):
        self.requests = rospy.Publisher("/alone/routing_request", RoutingRequest, queue_size=100)
        support.wait_until(lambda: self.requests.get_num_connections() > 0, "the adapter listens")
        self.responses = support.Collector("/alone/routing_response", RoutingResponse)

    def tearDown(self):
        self.requests.unregister()
        self.responses.close()

    def test_says_which_service_is_missing(self):
        self.send(1.0)
        response = self.responses.wait_for(lambda m: m.error_code == CommandStatus.NOT_READY, "a response")
        self.assertIn("/alone/external_command/lane_follow", response.error_message)

    def test_requests_wait_in_line_and_the_oldest_of_too_many_is_refused(self):
        gate, served = threading.Event(), []

        def serve(request):
            served.append(request.command.end_pose.x)
            gate.wait(support.DEADLINE)
            return LaneFollowResponse(status=CommandStatus(status=CommandStatus.RUNNING))

        service = rospy.Service("/alone/external_command/lane_follow", LaneFollow, serve)
        try:
            self.send(1.0)
            support.wait_until(lambda: served, "the first request is being served")
            for x in range(2, 15):
                self.send(float(x))
            dropped = self._dropped(3)
            self.assertEqual(dropped, [2.0, 3.0, 4.0])
            gate.set()
            support.wait_until(lambda: len(served) == 11, "all others are served")
            self.assertEqual(served, [1.0] + [float(x) for x in range(5, 15)])
        finally:
            gate.set()
            service.shutdown()

    def send(self, x):
        self.requests.publish(RoutingRequest(waypoint=[LaneWaypoint(pose=Point(x, 0.0, 0.0))]))

    def _dropped(self, count):
        def refused():
            return [m.routing_request.waypoint[0].pose.x for m in self.responses.messages
                    if m.error_code == CommandStatus.SUPERSEDED]
        support.wait_until(lambda: len(refused()) >= count, "%d dropped requests" % count)
        return refused()


if __name__ == "__main__":
    rospy.init_node("old_routing_alone_test")
    rostest.rosrun("external_command", "old_routing_alone", OldRoutingAloneTest)
