#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A zone is swept by the simulated vehicle: to its end, past what the grid shows, and on after a restart."""
import math
import os
import re
import shutil
import signal
import unittest

import rospy
import rostest
import tf2_ros
from nav_msgs.msg import OccupancyGrid

import support
from external_command.msg import CommandStatus, FreeSpaceCommand, Pose
from external_command.srv import FreeSpace
from zone_yard import Sweeper, box, percent_of, polygon, swath_of, wait_until_kept

NODE = "/courtyard/external_command"
PROGRESS_FOLDER = rospy.get_param("/courtyard/zone_cover_command_processor/progress_folder")
YARD = box(13, 10)
SMALL_YARD = box(12, 10)
OCCUPIED = (6.0, 2.0, 8.0, 4.0)  # x0, y0, x1, y1 of an obstacle in the grid [m]
HALF_WIDTH = 0.9  # of the vehicle, less than it is: the rear axle stays at least that far away [m]


def grid(*occupied):
    """60 m x 60 m around the origin, free but for boxes."""
    message = OccupancyGrid()
    message.header.frame_id = "map"
    message.info.resolution = 0.25
    message.info.width = message.info.height = 240
    message.info.origin.position.x = message.info.origin.position.y = -30.0
    message.info.origin.orientation.w = 1.0
    cells = [0] * (240 * 240)
    for x0, y0, x1, y1 in occupied:
        for row in range(int((y0 + 30.0) / 0.25), int((y1 + 30.0) / 0.25)):
            for column in range(int((x0 + 30.0) / 0.25), int((x1 + 30.0) / 0.25)):
                cells[240 * row + column] = 100
    message.data = cells
    return message


SWEEPER = Sweeper("courtyard")


def cover(corners=YARD, **fields):
    return SWEEPER.cover(corners, **fields)


class ZoneCoverTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(PROGRESS_FOLDER, ignore_errors=True)
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        cls.grid_publisher = rospy.Publisher("/courtyard/obstacle_grid", OccupancyGrid, queue_size=1, latch=True)
        cls.grid_publisher.publish(grid())
        SWEEPER.wait_until_ready(YARD)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(PROGRESS_FOLDER, ignore_errors=True)

    def assert_running(self, answer):
        self.assertEqual(answer.status.status, CommandStatus.RUNNING, support.describe(answer.status))
        return answer.status.command_id

    def assert_refused(self, answer, *words):
        self.assertEqual(answer.status.error_code, CommandStatus.INVALID_REQUEST, support.describe(answer.status))
        for word in words:
            self.assertIn(word, answer.status.message)

    def setUp(self):
        """Every test begins in the middle."""
        SWEEPER.wait_until_standing()
        middle = Pose(heading=0.0, has_heading=True)
        command = FreeSpaceCommand(parking_spot_pose=middle, drivable_roi=polygon(box(40, 40)))
        self.finish(self.assert_running(support.service(SWEEPER.ns + "free_space", FreeSpace)(command)))

    def finish(self, command_id):
        SWEEPER.finish(command_id)

    def interrupt_half_way(self, corners):
        """Begins to sweep and stops the vehicle; returns how many swaths there are, and were done, and the per cent."""
        last = SWEEPER.sweep_until(corners, lambda message: swath_of(message) >= 4)[-1]
        return int(re.match(r"swath \d+ of (\d+)", last).group(1)), swath_of(last) - 1, percent_of(last)

    def kill_the_gateway(self):
        killed = support.pid_of(NODE)
        os.kill(killed, signal.SIGKILL)
        support.wait_until(lambda: support.pid_of(NODE) not in (None, killed), "the gateway is started again", 60.0)
        SWEEPER.wait_until_ready(YARD)

    def test_sweeps_to_the_end_and_then_has_nothing_to_resume(self):
        corners = box(12, 9)
        answer = cover(corners)
        self.assertGreater(answer.report.reachable_coverage_ratio, 0.95)
        self.assertGreater(answer.report.coverage_ratio, 0.8)
        self.assertLessEqual(answer.report.coverage_ratio, answer.report.reachable_coverage_ratio)
        self.finish(self.assert_running(answer))
        self.assert_refused(cover(corners, resume=True), "resume", "is swept")

    def test_goes_on_after_a_restart_where_it_was_killed(self):
        total, done, percent = self.interrupt_half_way(YARD)
        wait_until_kept(PROGRESS_FOLDER)
        leftover = os.path.join(PROGRESS_FOLDER, "courtyard-polygon-0.zone.999999999-1.new")
        with open(leftover, "w", encoding="ascii") as file:
            file.write("of a process that was killed while it wrote")
        self.kill_the_gateway()
        self.assertFalse(os.path.exists(leftover))
        again = cover(YARD, dry_run=True)
        answer = cover(YARD, resume=True)
        self.assertLess(answer.report.path_length, again.report.path_length)
        statuses = support.Collector(SWEEPER.ns + "status", CommandStatus)
        command_id = self.assert_running(answer)
        first = statuses.wait_for(lambda m: m.command_id == command_id and swath_of(m.message), "progress")
        self.assertIn("of %d," % total, first.message)
        self.assertGreaterEqual(swath_of(first.message), done)
        self.assertGreaterEqual(percent_of(first.message), percent - 1)
        self.finish(command_id)
        self.assert_refused(cover(YARD, resume=True), "all %d swaths" % total)

    def test_skips_a_swath_and_tries_it_again_at_the_end(self):
        total, done, _ = self.interrupt_half_way(SMALL_YARD)
        blocked = done + 1
        whole, without = (cover(SMALL_YARD, resume=True, dry_run=True, skip_swath=skipped)
                          for skipped in ([], [blocked]))
        self.assertEqual(without.status.status, CommandStatus.FINISHED, support.describe(without.status))
        self.assertAlmostEqual(whole.report.coverage_ratio, without.report.coverage_ratio, places=2)
        self.assertNotEqual(whole.path.points[-1].x, without.path.points[-1].x)
        self.assert_refused(cover(SMALL_YARD, resume=True, skip_swath=[total]), "skip_swath", "0 to %d" % (total - 1))

    def test_refuses_to_resume_what_was_never_begun(self):
        self.assert_refused(cover([(-20, -20), (20, -20), (20, 20), (-20, 20)], resume=True), "no earlier run")
        self.assert_refused(cover(skip_swath=[1]), "skip_swath needs resume")

    def test_keeps_away_from_what_the_grid_shows(self):
        self.grid_publisher.publish(grid(OCCUPIED))
        x0, y0, x1, y1 = OCCUPIED

        def clearance(point):
            return math.hypot(max(x0 - point.x, point.x - x1, 0.0), max(y0 - point.y, point.y - y1, 0.0))

        def stays_away():
            answer = cover(dry_run=True)
            self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
            return min(clearance(point) for point in answer.path.points) > HALF_WIDTH

        try:
            support.wait_until(stays_away, "a plan round the obstacle")
        finally:
            self.grid_publisher.publish(grid())


if __name__ == "__main__":
    rospy.init_node("zone_cover_test")
    rostest.rosrun("external_command", "zone_cover", ZoneCoverTest)
