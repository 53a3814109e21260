# SPDX-License-Identifier: Apache-2.0
"""What `external_command_client` prints: lines for a person, or JSON for a program."""

import json
import shutil
import sys

from external_command.client import accepted, describe, describe_progress
from external_command.msg import CommandStatus
from external_command.plain import KIND_NAMES, plain


class JsonOutput:
    """An object on each line."""

    def response(self, response):
        fields = {"status": plain(response.status)}
        if hasattr(response, "report"):
            fields["report"] = plain(response.report)
        if hasattr(response, "path") and response.path.points:
            fields["path"] = plain(response.path)
        self._print(fields)

    def status(self, status):
        self._print({"status": plain(status)})

    progress = status

    def cancelled(self, response):
        self._print(plain(response))

    def current(self, response):
        self._print(plain(response))

    def unmet(self, readiness, conditions):
        self._print({"is_ready": readiness.is_ready, "unmet": plain(conditions)})

    def objects(self, objects):
        self._print({"objects": plain(list(objects)), "total_count": objects.total_count})

    def map_info(self, info):
        self._print(info)

    def error(self, text):
        self._print({"error": text})

    @staticmethod
    def _print(fields):
        print(json.dumps(fields), flush=True)


class TextOutput:
    def __init__(self):
        self._bar = 0  # letters of a progress bar that stands on the last line

    def response(self, response):
        self._print(describe(response.status))
        if hasattr(response, "report") and accepted(response.status):
            self._report(response.report)

    def status(self, status):
        self._print(describe(status))

    def progress(self, status):
        """Of a command that runs: a bar that is drawn over itself on a terminal, else a line."""
        if not sys.stdout.isatty():
            return self._print(describe(status))
        text = progress_bar(status, (shutil.get_terminal_size().columns or 80) - 1)  # 0: not told
        sys.stdout.write("\r" + text.ljust(self._bar))
        sys.stdout.flush()
        self._bar = len(text)

    def cancelled(self, response):
        told = "was running" if response.was_running else "was not running"
        self._print("%s; it %s" % (describe(response.status), told))

    def current(self, response):
        if response.motion.status == CommandStatus.UNKNOWN:
            self._print("no motion command so far")
        else:
            is_driven = response.motion.status == CommandStatus.RUNNING
            self._print("%s: %s" % ("driven" if is_driven else "last driven", _with_service(response.motion)))
        for status in response.running:
            if status.command_id != response.motion.command_id:
                self._print("runs: " + _with_service(status))

    def unmet(self, readiness, conditions):
        for condition in conditions:
            needed = ", ".join(name.replace("_", "-") for name in condition.needed_by)
            self._print("%s: %s%s" % (condition.name, condition.message, " (needed by %s)" % needed if needed else ""))
        if not conditions:
            self._print("nothing is missing")

    def objects(self, objects):
        for found in objects:
            self._print(_object_line(found))
        if len(objects) < objects.total_count:
            self._print("%d of %d (--max shows more)" % (len(objects), objects.total_count))
        if not objects:
            self._print("there is none")

    def map_info(self, info):
        for name, value in info.items():
            self._print("%s: %s" % (name.replace("_", " "), value))

    def error(self, text):
        self._end_bar()
        print(text, file=sys.stderr)

    def _report(self, report):
        lengths = [(report.route_length, "route %.1f m"), (report.path_length, "path %.1f m"),
                   (report.reverse_length, "%.1f m in reverse"), (report.lane_changes, "%d lane changes"),
                   (report.gear_changes, "%d gear changes"), (report.min_clearance, "clearance %.2f m"),
                   (report.wheel_turns, "%.1f turns of the wheels to full lock"),
                   (report.near_length, "%.1f m near obstacles"),
                   (100.0 * report.coverage_ratio, "covers %.1f %%"),
                   (100.0 * report.reachable_coverage_ratio, "%.1f %% of what can be reached"),
                   (1000.0 * report.planning_time, "planned in %.1f ms")]
        self._print("  " + ", ".join(text % value for value, text in lengths if value))
        if report.lane_ids:
            self._print("  lanes: " + " ".join(report.lane_ids))
        for warning in report.warnings:
            self._print("  warning: " + warning)

    def _print(self, line):
        self._end_bar()
        print(line, flush=True)

    def _end_bar(self):
        if self._bar:
            sys.stdout.write("\n")
            self._bar = 0


def progress_bar(status, width):
    """`[#####.....] 42 %, 120.0 m and 15 s left, command 7`, no wider than `width`."""
    text = " %s, command %d" % (describe_progress(status) if status.has_progress else "no progress known",
                                status.command_id)
    room = max(0, min(40, width - len(text) - 2))
    done = int(round(room * min(1.0, max(0.0, status.share_done))))
    bar = "[%s%s]" % ("#" * done, "." * (room - done)) if room >= 5 else ""
    return (bar + text)[:width]


def _with_service(status):
    return describe(status) + (" (%s)" % status.service.replace("_", "-") if status.service else "")


def _object_line(found):
    parts = ["%-5s %s" % (KIND_NAMES.get(found.kind, found.kind), found.id),
             "at %.2f %.2f" % (found.pose.x, found.pose.y) + (" %.3f" % found.pose.heading if found.pose.has_heading else "")]
    if found.distance:
        parts.append("%.1f m away" % found.distance)
    if found.length:
        parts.append("%.1f x %.1f m" % (found.length, found.width))
    if found.lane_ids:
        parts.append("lanes " + " ".join(found.lane_ids))
    return "   ".join(parts)
