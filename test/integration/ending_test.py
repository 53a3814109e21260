#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The process ends when it is told to, at once and in order, whatever it is doing."""
import os
import random
import signal
import threading
import time

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Point

import support
from component import LANE_FOLLOW, Component
from external_command.msg import (ActionCommand, CommandStatus, PathFollowCommand, Pose, RoiPolygon,
                                  ZoneCoverCommand)
from external_command.srv import Action, GetCommandStatus, PathFollow, ZoneCover

NAMESPACE = "/ending_test"
STATUS = NAMESPACE + "/external_command/command_status"
ZONE_COVER = "external_command/ZoneCoverCommandProcessor"
PATH_FOLLOW = "external_command/PathFollowCommandProcessor"


def component(processors, **others):
    return Component(NAMESPACE, dict(others, external_command={"processors": processors}))


def is_registered(service):
    try:
        return bool(rosgraph.Master(rospy.get_name()).lookupService(service))
    except rosgraph.MasterError:
        return False


class EndingTest(support.TestCase):
    def test_ends_in_order_when_it_is_idle(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number), component([LANE_FOLLOW]) as started:
                started.service("external_command/command_status", GetCommandStatus)
                started.send_signal(number)
                self.assertEqual(started.wait_for_end(), 0, started.output)
                self.assertFalse(is_registered(STATUS), "its service was left behind")

    def test_ends_in_order_while_it_is_starting(self):
        chance = random.Random(1)
        for _ in range(6):
            with component([LANE_FOLLOW, ZONE_COVER]) as started:
                time.sleep(chance.uniform(0.0, 0.5))
                started.send_signal(signal.SIGTERM)
                code = started.wait_for_end()
                self.assertIn(code, (0, -signal.SIGTERM), started.output)
                self.assertNotIn("FATAL", started.output)

    def test_does_not_wait_for_a_plan_that_is_being_computed(self):
        budget = 60.0
        coverage = {"coverage": {"time_budget": budget}}
        with component([ZONE_COVER], zone_cover_command_processor=coverage) as started:
            call = started.service("external_command/zone_cover", ZoneCover)
            statuses = support.Collector(NAMESPACE + "/external_command/status", CommandStatus)
            threading.Thread(target=self._call, args=(call,), daemon=True).start()
            statuses.wait_for(lambda status: status.status == CommandStatus.RUNNING, "the plan is begun")
            begin = time.monotonic()
            started.send_signal(signal.SIGTERM)
            self.assertEqual(started.wait_for_end(), 0, started.output)
            self.assertLess(time.monotonic() - begin, 0.5 * budget)
            statuses.close()

    def test_goes_on_while_nobody_reads_its_output(self):
        reader, writer = os.pipe()
        processors = [PATH_FOLLOW, "external_command/ActionCommandProcessor"]
        try:
            with Component(NAMESPACE, {"external_command": {"processors": processors}}, output=writer) as started:
                follow = started.service("external_command/path_follow", PathFollow)
                motion = follow(PathFollowCommand(way_point=[Point(0.0, 0.0, 0.0), Point(9.0, 0.0, 0.0)])).status
                for _ in range(1500):  # far more lines than a pipe holds
                    self.assertEqual(follow(PathFollowCommand()).status.status, CommandStatus.ERROR)
                act = started.service("external_command/action", Action)
                self.assertEqual(act(ActionCommand(command=ActionCommand.STOP)).status.status, CommandStatus.RUNNING)
                reports = rospy.Publisher(NAMESPACE + "/planning/command_status", CommandStatus, queue_size=1)
                support.wait_until(lambda: reports.get_num_connections() > 0, "somebody listens to the planner")
                reports.publish(CommandStatus(command_id=motion.command_id, status=CommandStatus.FINISHED))
                support.wait_for_status(motion.command_id, CommandStatus.FINISHED, STATUS)
                started.send_signal(signal.SIGKILL)  # what ROS itself still wants to write would keep it
        finally:
            os.close(reader)
            os.close(writer)

    @staticmethod
    def _call(call):
        side = 400.0
        corners = [Point(0.0, 0.0, 0.0), Point(side, 0.0, 0.0), Point(side, side, 0.0), Point(0.0, side, 0.0)]
        start = Pose(x=0.5 * side, y=0.5 * side, heading=0.3, has_heading=True)
        command = ZoneCoverCommand(drivable_roi=RoiPolygon(points=corners), is_start_pose_set=True, way_point=[start])
        try:
            call(command)
        except rospy.ServiceException:
            pass  # it breaks off when the process ends


if __name__ == "__main__":
    rospy.init_node("ending_test")
    rostest.rosrun("external_command", "ending", EndingTest)
