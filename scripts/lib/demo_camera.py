# SPDX-License-Identifier: Apache-2.0
"""rviz for the demo, on the display there is or on an invisible one, and a picture of it."""
import os
import subprocess
import time

import numpy
import rosgraph
import rospy
import yaml

import demo_captions
import demo_overlay
from demo_stack import DemoError

WIDTH, HEIGHT = 1600, 1000  # of rviz's window [pixels]
FRAME = 92  # pixels of the window's height that show no map
SIDES = 20  # of its width
MARGIN = 1.15
START_TIMEOUT = 90.0  # [s]; drawing by software is slow
FOLLOWING_SCALE = 12.0  # of a view that follows the vehicle [pixels/m]
ENOUGH = 0.2  # of the pixels that a straight path would take


class Camera:
    def __init__(self, stack, picture):
        self.has_picture = False
        self.problem = "rviz was not started"
        self.overlay = None  # once open
        self.captions = None  # of a view that stands still, once open
        self._stack = stack
        self._picture = picture
        self._display = {}
        self._enough_pixels = 0

    def open(self, config, extent, path_length):
        """Starts rviz with the settings of file `config`, looking down on `extent` (min x, min y, max x, max y)."""
        view = looking_down_on(extent)
        scale = view["Scale"]
        self.captions = demo_captions.Captions(scale, view["X"] - 0.5 * (WIDTH - SIDES) / scale,
                                               view["Y"] - 0.5 * (HEIGHT - FRAME) / scale)
        self._start(config, view)
        self._enough_pixels = ENOUGH * path_length * demo_overlay.line_width(scale) * scale ** 2

    def follow(self, config):
        """Starts rviz looking down on the vehicle, wherever it goes."""
        self._start(config, {"Target Frame": "base_link", "X": 0.0, "Y": 0.0, "Scale": FOLLOWING_SCALE})

    def shoot(self, picture):
        """Takes a picture of whatever is to be seen. What was wrong with it; empty: nothing."""
        self._picture, self._enough_pixels = picture, 0
        return self._shoot()

    def _start(self, config, view):
        if not display_works():
            self._open_invisible_display()
        own_config = os.path.join(self._stack.log_dir, "demo.rviz")
        write_config(config, view, own_config)
        self.overlay = demo_overlay.Overlay(view["Scale"])
        # Drawing by software takes whole cores, and plans have a time to be ready in.
        self._stack.spawn("rviz", ["nice", "--adjustment=19", "rviz", "--display-config", own_config, "__ns:=/apollo"],
                          QT_X11_NO_MITSHM="1", **self._display)
        self._stack.wait_for(self._listens_to_markers, "rviz", START_TIMEOUT, "rviz")
        time.sleep(3.0)  # until the map is drawn

    def take(self):
        """Takes the picture; once more, for a while, where no path is to be seen in it."""
        for _ in range(10):
            self.problem = self._shoot()
            if not self.problem:
                self.has_picture = True
                return
            time.sleep(1.0)

    def _open_invisible_display(self):
        read_end, write_end = os.pipe()
        log = self._stack.log_file("xvfb")
        self._stack.spawn("xvfb", ["Xvfb", "-displayfd", str(write_end), "-nolisten", "tcp", "-screen", "0",
                                   f"{WIDTH}x{HEIGHT}x24"], pass_fds=(write_end,))
        os.close(write_end)
        with os.fdopen(read_end, encoding="ascii") as number:
            display = number.readline().strip()  # empty where Xvfb has ended
        if not display:
            raise DemoError(f"no display, and Xvfb did not start; see {log}")
        self._display = {"DISPLAY": ":" + display, "LIBGL_ALWAYS_SOFTWARE": "1"}

    @staticmethod
    def _listens_to_markers():
        _, subscribers, _ = rosgraph.Master(rospy.get_name()).getSystemState()
        return any("rviz" in node for topic, nodes in subscribers if topic.endswith("/markers") for node in nodes)

    def _shoot(self):
        """What was wrong with the picture; empty: nothing."""
        environment = {**os.environ, **self._display}
        window = self._window(environment)
        command = ["import", "-window", window, self._picture]
        shot = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if shot.returncode != 0:
            return "no screenshot: " + shot.stdout.decode(errors="replace").strip()
        colours = (demo_overlay.PATH_COLOUR, demo_overlay.TRAIL_COLOUR)
        if sum(count_pixels(self._picture, colours)) < self._enough_pixels:
            return f"the path is not to be seen in {self._picture}; rviz's output: {self._stack.log_file('rviz')}"
        return ""

    def _window(self, environment):
        """The whole invisible display; on a real one only rviz's window."""
        if self._display:
            return "root"
        tree = subprocess.run(["xwininfo", "-root", "-tree"], env=environment, stdout=subprocess.PIPE, check=False)
        windows = [line.split()[0] for line in tree.stdout.decode(errors="replace").splitlines()
                   if '("rviz" "rviz")' in line and " - RViz" in line]
        return windows[0] if windows else "root"


def display_works():
    return bool(os.environ.get("DISPLAY")) and subprocess.run(
        ["xdpyinfo"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode == 0


def looking_down_on(extent):
    """The settings of a view that shows (min x, min y, max x, max y) [m] beside the legend; its scale is in pixels/m."""
    low_x, low_y, high_x, high_y = extent
    width, height = WIDTH - SIDES - demo_captions.STRIP, HEIGHT - FRAME
    scale = min(width / max(high_x - low_x, 20.0), height / max(high_y - low_y, 20.0)) / MARGIN
    return {"Target Frame": "<Fixed Frame>", "X": float((low_x + high_x - demo_captions.STRIP / scale) / 2.0),
            "Y": float((low_y + high_y) / 2.0), "Scale": float(scale)}


def write_config(source, view, target):
    """A copy of an rviz configuration that looks straight down as `view` says, without panels, in lines of a visible width."""
    with open(source, encoding="utf-8") as file:
        config = yaml.safe_load(file)
    current = config["Visualization Manager"]["Views"]["Current"]
    current.clear()
    current.update({"Class": "rviz/TopDownOrtho", "Name": "Current View", "Angle": 0.0, "Near Clip Distance": 0.01, **view})
    displays = config["Visualization Manager"]["Displays"]
    for display in displays:
        if display["Class"] == "rviz/Path":
            display["Line Width"] = float(demo_overlay.line_width(view["Scale"]))
    for name, topic in (("Drive", demo_overlay.TOPIC), ("Captions", demo_captions.TOPIC)):
        displays.append({"Class": "rviz/MarkerArray", "Name": name, "Enabled": True, "Value": True, "Namespaces": {},
                         "Marker Topic": topic, "Queue Size": 10})
    config["Visualization Manager"]["Global Options"]["Frame Rate"] = 10
    config["Panels"] = []
    config["Window Geometry"] = {"Width": WIDTH, "Height": HEIGHT, "X": 0, "Y": 0, "Hide Left Dock": True,
                                 "Hide Right Dock": True}
    with open(target, "w", encoding="utf-8") as file:
        yaml.safe_dump(config, file)


def count_pixels(picture, colours):
    """How many pixels of an image file have about each of the colours."""
    raw = subprocess.run(["convert", picture, "-depth", "8", "rgb:-"], stdout=subprocess.PIPE, check=False).stdout
    pixels = numpy.frombuffer(raw[:len(raw) // 3 * 3], dtype=numpy.uint8).reshape(-1, 3).astype(int)
    return [int((numpy.abs(pixels - colour).max(axis=1) < 40).sum()) for colour in colours]
