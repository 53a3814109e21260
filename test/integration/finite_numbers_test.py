#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Numbers that are not finite: refused by name where they are read or sent on, left alone where nobody reads them."""
import copy
import math

import genpy
import rospy
import rostest
from geometry_msgs.msg import Point

import support
from external_command.client import CommandClient, pose, polygon
from external_command.msg import (CommandStatus, FreeSpaceCommand, LaneFollowCommand, LaneSegment, PathFollowCommand,
                                  PlanningCommand, Pose, PreciseParkingCommand, ValetParkingCommand, ZoneCoverCommand)

FIELD = polygon([(90.0, 185.0), (130.0, 185.0), (130.0, 225.0), (90.0, 225.0)])
HOLE = polygon([(120.0, 210.0), (124.0, 210.0), (124.0, 214.0), (120.0, 214.0)])


def line(y):
    return [Point(100.0 + 5.0 * i, y, 0.0) for i in range(5)]


def commands():
    """{service: (a command with something in every list, numbers of it beside polygons' z that nobody reads)}"""
    start = pose(100.0, 195.0, 0.0)
    unread_pose = {"heading", "z"}
    return {
        "lane_follow": (LaneFollowCommand(
            is_start_pose_set=True, way_point=[Pose(x=100.0, y=195.0)], end_pose=Pose(x=300.0, y=195.0),
            blacklisted_lane=[LaneSegment("lane_that_is_none", 1.0, 2.0)]), unread_pose),
        "valet_parking": (ValetParkingCommand(
            is_start_pose_set=True, way_point=[Pose(x=100.0, y=195.0)], parking_spot_id="n_out_5"), unread_pose),
        "free_space": (FreeSpaceCommand(
            parking_spot_pose=pose(110.0, 200.0, 0.0), drivable_roi=FIELD, non_drivable_roi=[HOLE]), set()),
        "path_follow": (PathFollowCommand(
            way_point=line(195.0), left_boundary=line(198.0), right_boundary=line(192.0), heading=[0.0] * 5), set()),
        "precise_parking": (PreciseParkingCommand(
            is_start_pose_set=True, way_point=[start], parking_spot_pose=pose(262.0, 110.0, 0.0)), set()),
        "zone_cover": (ZoneCoverCommand(
            is_start_pose_set=True, way_point=[start], drivable_roi=FIELD, non_drivable_roi=[HOLE]), set()),
    }


def numbers(message, path=""):
    """Every floating-point field, as (its name in the message, a function that sets it, its value)."""
    for name, field_type in zip(message.__slots__, message._slot_types):
        value = getattr(message, name)
        own = path + name
        if field_type == "float64":
            yield own, lambda number, n=name: setattr(message, n, number), value
        elif field_type == "float64[]":
            for i in range(len(value)):
                yield "%s[%d]" % (own, i), lambda number, v=value, k=i: v.__setitem__(k, number), value[i]
        elif isinstance(value, genpy.Message):
            yield from numbers(value, own + ".")
        elif isinstance(value, list):
            for i, item in enumerate(value):
                if isinstance(item, genpy.Message):
                    yield from numbers(item, "%s[%d]." % (own, i))


class FiniteNumbersTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.client = CommandClient(rospy.get_namespace())
        support.wait_until_ready(cls.client)

    def refusal_of(self, service, command):
        status = self.client.call(service, command).status
        return status.message if status.error_code == CommandStatus.INVALID_REQUEST else ""

    def test_each_is_refused_by_its_name_where_it_is_read_or_sent_on(self):
        for service, (command, unread) in sorted(commands().items()):
            for i, (name, *_) in enumerate(numbers(command)):
                for number in (math.nan, math.inf):
                    wrong = copy.deepcopy(command)
                    wrong.dry_run = True
                    list(numbers(wrong))[i][1](number)
                    with self.subTest(service=service, field=name, number=number):
                        refusal = self.refusal_of(service, wrong)
                        if name.rpartition(".")[2] in unread or (".points[" in name and name.endswith(".z")):
                            self.assertNotIn(name, refusal)
                        else:
                            self.assertIn(name, refusal)
                            self.assertTrue("finite" in refusal or "must lie in" in refusal, refusal)

    def test_what_nobody_reads_goes_nowhere(self):
        sent = support.Collector("planning/command", PlanningCommand)
        for service in ("lane_follow", "valet_parking"):
            command, _ = commands()[service]
            command.blacklisted_lane = []
            for unread in (command.way_point[0], getattr(command, "end_pose", Pose())):
                unread.heading, unread.z = math.nan, math.inf
            with self.subTest(service):
                answer = self.client.call(service, command).status
                self.assertEqual(answer.status, CommandStatus.RUNNING, support.describe(answer))
                planned = sent.wait_for(lambda m, i=answer.command_id: m.command_id == i, "the planning command")
                self.assertEqual([name for name, _, number in numbers(planned) if not math.isfinite(number)], [])
        sent.close()


if __name__ == "__main__":
    rospy.init_node("finite_numbers_test")
    rostest.rosrun("external_command", "finite_numbers", FiniteNumbersTest)
