# SPDX-License-Identifier: Apache-2.0
"""Obstacle grids and files of zones, damaged; a part of scripts/fuzz."""
import glob
import os
import random
import threading
import time

import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid

import fuzz_bytes
from answer_times import latest_answer
from campaign import Periodic
from external_command.client import CommandClient, ServiceUnavailable

TOPIC = "/apollo/grid"
SOUND_TIME = 4.0  # in which every caller gets past the checks of the grid [s]
PERIOD = 0.2  # of what has to be fresh, and between two requests that may be answered "busy" [s]
FIRST_FILE = 30.0  # [s]
NUMBERS = [0.0, -1.0, 1e-9, 1e9, float("nan"), float("inf")]


def sound_grid():
    """Of the whole field of the requests, without an obstacle."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.resolution = 0.5
    grid.info.width = grid.info.height = 200
    grid.info.origin.position.x, grid.info.origin.position.y = 50.0, 150.0
    grid.info.origin.orientation.w = 1.0
    grid.data = [0] * (grid.info.width * grid.info.height)
    return grid


def damaged_grid(chance):
    """One whose size lies, of noise, or with walls one cell wide."""
    grid = OccupancyGrid()
    grid.header.frame_id = chance.choice(["map", "map", "map", "", "nowhere"])
    grid.info.resolution = chance.choice([0.1, 0.2, 0.5] * 3 + NUMBERS)
    grid.info.width, grid.info.height = chance.choice([(200, 200), (400, 300), (1, 1), (0, 0), (1000, 10)])
    grid.info.origin.position.x, grid.info.origin.position.y = 70.0, 170.0
    grid.info.origin.orientation.w = chance.choice([1.0, 1.0, 1.0, 0.0, float("nan")])
    cells = grid.info.width * grid.info.height
    filled = chance.choice([0.0, 0.001, 0.02, 0.5, 1.0])
    grid.data = [100 if chance.random() < filled else 0 for _ in range(cells)]
    for _ in range(chance.randrange(4)):  # walls
        row = chance.randrange(max(1, grid.info.height))
        for column in range(0, grid.info.width, chance.choice([1, 1, 2])):
            grid.data[row * grid.info.width + column] = 100
    if chance.random() < 0.2:
        grid.info.width = chance.choice([0, 1, 2 ** 32 - 1, 2 ** 16])
    return grid


class Grids:
    """Damaged grids, and a sound one in between: with a damaged one all that is behind its checks is out of reach."""

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self._publisher = rospy.Publisher(TOPIC, OccupancyGrid, queue_size=1)
        self._is_sound = threading.Event()

    def is_left_alone(self, topic):
        """True where nobody else is to publish on `topic` now."""
        return topic == TOPIC and self._is_sound.is_set()

    def damage(self):
        self._is_sound.clear()
        self._publisher.publish(damaged_grid(self.chance))

    def mend(self):
        self._is_sound.set()
        self.repeat()

    def repeat(self):
        """Grids are to be fresh; and a damaged one may have been on its way."""
        if self._is_sound.is_set():
            self._publisher.publish(sound_grid())


def fuzz_grids(grids, end, findings):
    """Plans with grids that are damaged and sound in turn, until `end`."""
    client = CommandClient("apollo")
    with Periodic(PERIOD, grids.repeat):
        while time.monotonic() < end:
            grids.damage()
            call_with_grid(client, grids.chance, "a grid", findings)
            grids.mend()
            sound_until = min(end, time.monotonic() + SOUND_TIME)
            while time.monotonic() < sound_until:
                call_with_grid(client, grids.chance, "a sound grid", findings)
                time.sleep(PERIOD)


def call_with_grid(client, chance, grid, findings):
    service = chance.choice(["zone_cover", "free_space"])
    begin = time.monotonic()
    try:
        status = client.call(service, fuzz_bytes.example(service)).status
    except ServiceUnavailable as error:
        findings.add("%s gave no answer, with %s" % (service, grid), error)
        return
    duration = time.monotonic() - begin
    findings.note("%s with %s" % (service, grid), status.error_code, duration)
    if duration > latest_answer(service):
        findings.add("%s answered late, with %s" % (service, grid), "after %.1f s: %s" % (duration, status.message))


def make_zone_file(grids, folder):
    """{path: content} of the file of a zone that was begun; to be called before anybody sends STOP."""
    broadcaster = tf2_ros.TransformBroadcaster()
    client = CommandClient("apollo")
    command = fuzz_bytes.example("zone_cover")
    command.dry_run = False
    grids.mend()
    with Periodic(PERIOD, lambda: broadcaster.sendTransform(standing_vehicle())), Periodic(PERIOD, grids.repeat):
        end = time.monotonic() + FIRST_FILE
        while time.monotonic() < end:
            client.call("zone_cover", command)
            paths = glob.glob(os.path.join(folder, "*.zone"))
            if paths:
                break
            time.sleep(PERIOD)
    return {path: read(path) for path in paths}


def standing_vehicle():
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = "map", "base_link"
    transform.header.stamp = rospy.Time.now()
    transform.transform.rotation.w = 1.0
    transform.transform.translation.x, transform.transform.translation.y = 90.0, 190.0
    return transform


def read(path):
    with open(path, "rb") as file:
        return file.read()


def fuzz_zone_files(seed, end, files, findings):
    """Damages the files of zones, {path: content}, and resumes these, until `end`. Most are dry runs: a STOP ends the
    planning of others before the files are read."""
    chance = random.Random(seed)
    client = CommandClient("apollo")
    command = fuzz_bytes.example("zone_cover")
    command.resume = True
    while time.monotonic() < end:
        for path, content in files.items():
            with open(path, "wb") as file:
                file.write(fuzz_bytes.damaged(content, chance))
        command.dry_run = chance.random() < 0.9
        begin = time.monotonic()
        try:
            status = client.call("zone_cover", command).status
            findings.note("zone_cover with a zone file", status.error_code, time.monotonic() - begin)
        except ServiceUnavailable as error:
            findings.add("zone_cover gave no answer, with a zone file", error)
        time.sleep(PERIOD)
