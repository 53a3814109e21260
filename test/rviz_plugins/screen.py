# SPDX-License-Identifier: Apache-2.0
"""rviz on an invisible display, and a hand on its mouse and keys."""
import os
import re
import shutil
import subprocess
import tempfile
import time

import numpy
import yaml

PROGRAMS = ("Xvfb", "rviz", "xdotool", "xwininfo", "import", "convert")
STARTUP = 120.0  # drawn by software, beside other tests [s]
FRAME_RATE = 5  # in place of the file's: drawn by software, a picture takes tens of milliseconds [Hz]
PAUSE = 0.3  # in which rviz draws a picture or two [s]


def missing_programs():
    return [name for name in PROGRAMS if not shutil.which(name)]


class Screen:
    """Xvfb and rviz with a configuration file; to be used in a `with` block.

    Map coordinates are those of the configuration's view, rviz/TopDownOrtho.
    """

    def __init__(self, config):
        with open(config, encoding="utf-8") as file:
            self._config = file.read()
        self._view = yaml.safe_load(self._config)["Visualization Manager"]["Views"]["Current"]
        self._folder = tempfile.TemporaryDirectory()
        self._processes = []
        self._environment = {}
        self._drawing = None  # (left, top, width, height) of what shows the map [pixels]

    def __enter__(self):
        try:
            self._open()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self._processes):
            process.terminate()
        for process in self._processes:
            try:
                process.wait(20.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._folder.cleanup()

    def is_running(self):
        return all(process.poll() is None for process in self._processes)

    def keys(self, *names):
        """Pressed one after the other while the mouse is over the map; "ctrl+Return" for example."""
        for name in names:
            self._do("key", name)
            time.sleep(PAUSE)

    def point_at(self, x, y):
        self._do("mousemove", *self._pixel(x, y))
        time.sleep(PAUSE)

    def click(self, x, y):
        self.point_at(x, y)
        self._do("click", 1)
        time.sleep(PAUSE)

    def drag(self, start, end):
        self.point_at(*start)
        self._do("mousedown", 1)
        for share in (0.3, 0.6, 1.0):
            self.point_at(*(a + share * (b - a) for a, b in zip(start, end)))
        self._do("mouseup", 1)
        time.sleep(PAUSE)

    def count_pixels(self, colour, tolerance=40):
        """How many pixels have about that colour (red, green, blue)."""
        shot = self._run(["import", "-window", "root", "png:-"])
        raw = self._run(["convert", "png:-", "-depth", "8", "rgb:-"], shot)
        pixels = numpy.frombuffer(raw, dtype=numpy.uint8).reshape(-1, 3).astype(int)
        return int((numpy.abs(pixels - colour).max(axis=1) < tolerance).sum())

    def save_picture(self, path):
        self._run(["import", "-window", "root", path])

    def _open(self):
        read_end, write_end = os.pipe()
        self._start(["Xvfb", "-displayfd", str(write_end), "-nolisten", "tcp", "-screen", "0", "1600x1000x24"],
                    pass_fds=(write_end,))
        os.close(write_end)
        with os.fdopen(read_end, encoding="ascii") as number:
            display = number.readline().strip()
        assert display, "Xvfb does not start"
        self._environment = {"DISPLAY": ":" + display, "LIBGL_ALWAYS_SOFTWARE": "1", "QT_X11_NO_MITSHM": "1"}
        config = os.path.join(self._folder.name, "slow.rviz")
        with open(config, "w", encoding="utf-8") as file:
            file.write(re.sub(r"Frame Rate: \d+", f"Frame Rate: {FRAME_RATE}", self._config))
        self._start(["rviz", "-d", config, "__name:=shown_rviz"])
        end = time.monotonic() + STARTUP
        while self._drawing is None:
            assert self.is_running(), "rviz has ended"
            assert time.monotonic() < end, "no window of rviz within %.0f s" % STARTUP
            time.sleep(0.5)
            self._drawing = self._find_drawing()

    def _start(self, command, pass_fds=()):
        self._processes.append(subprocess.Popen(command, env={**os.environ, **self._environment}, pass_fds=pass_fds,
                                                stdin=subprocess.DEVNULL))

    def _run(self, command, data=None):
        return subprocess.run(command, env={**os.environ, **self._environment}, input=data, stdout=subprocess.PIPE,
                              check=True).stdout

    def _do(self, *words):
        self._run(["xdotool", *map(str, words)])

    def _pixel(self, x, y):
        left, top, width, height = self._drawing
        scale = self._view["Scale"]
        return (round(left + width / 2.0 + (x - self._view["X"]) * scale),
                round(top + height / 2.0 - (y - self._view["Y"]) * scale))

    def _find_drawing(self):
        """The largest window inside that of rviz, once rviz has one."""
        tree = self._run(["xwininfo", "-root", "-tree"]).decode(errors="replace")
        if " - RViz" not in tree:
            return None
        inner = []
        for match in re.finditer(r"\(has no name\).* (\d+)x(\d+)\+\S+ +\+(-?\d+)\+(-?\d+)", tree):
            width, height, left, top = map(int, match.groups())
            if 400 < width < 1400 and 400 < height < 900:
                inner.append((left, top, width, height))
        return max(inner, key=lambda window: window[2] * window[3], default=None)
