# SPDX-License-Identifier: Apache-2.0
"""Asks map_findings, the program that knows what is wrong with a map, and tells it in words."""

import json
import os
import subprocess
import sys

import yaml

PROGRAM = "map_findings"


class MapCheckFailed(Exception):
    """The map, or something else that is needed, cannot be read; the text says what."""


def check_map(map_file, vehicle=None, max_link_gap=None, ignore=(), svg=None):
    """What `map_findings` says of a map, as a dictionary; doc/check_map.md describes it. Raises MapCheckFailed.

    `vehicle`: {key: value} as in config/vehicle.yaml. `max_link_gap` [m]. `ignore`: kinds. `svg`: file to draw into.
    """
    words = []
    if max_link_gap is not None:
        words += ["--max-link-gap", repr(max_link_gap)]
    for key, value in (vehicle or {}).items():
        words += ["--vehicle", "%s=%r" % (key, value)]
    for kind in ignore:
        words += ["--ignore", kind]
    if svg:
        words += ["--svg", svg]
    return json.loads(_output(words + [map_file]))


def kinds():
    """[{"kind": ..., "severity": ..., "what": ..., "advice": ...}, ...]: all that can be found."""
    return json.loads(_output(["--kinds"]))


def read_vehicle(name):
    """The keys and numbers of a file like config/vehicle.yaml. Raises MapCheckFailed."""
    try:
        with open(name, encoding="utf-8") as file:
            vehicle = yaml.safe_load(file)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise MapCheckFailed("--vehicle %s: %s" % (name, error)) from error
    if isinstance(vehicle, dict) and isinstance(vehicle.get("vehicle"), dict):
        vehicle = vehicle["vehicle"]
    if not isinstance(vehicle, dict):
        raise MapCheckFailed("--vehicle %s: lines like 'width: 2.0' are needed" % name)
    wrong = [key for key, value in vehicle.items() if isinstance(value, bool) or not isinstance(value, (int, float))]
    if wrong:
        raise MapCheckFailed("--vehicle %s: %s is no number" % (name, wrong[0]))
    return vehicle


def is_failure(report, fail_on):
    """True where there are findings of severity `fail_on`, or worse; "never" is never."""
    wanted = {"error": report["errors"], "warning": report["errors"] + report["warnings"], "never": 0}
    return wanted[fail_on] > 0


def describe(report, meanings, most=5):
    """The lines of a report for a person, with at most `most` findings of a kind, the largest first; 0: all.

    `meanings`: what kinds() returns.
    """
    by_name = {kind["kind"]: kind for kind in meanings}
    alike = {}  # in the order of the report: errors first
    for finding in report["findings"]:
        alike.setdefault((finding["severity"], finding["kind"]), []).append(finding)
    lines = ["%s: %s" % (report["map"], _contents(report))]
    for (severity, name), findings in alike.items():
        lines += _kind_lines(severity, by_name[name], findings, most)
    lines += ["note: " + note for note in report["notes"]]
    lines.append("%s, %s" % (_count(report["errors"], "error"), _count(report["warnings"], "warning")))
    return lines


def _kind_lines(severity, kind, findings, most):
    lines = ["%s %s: %d %s" % (severity.upper(), kind["kind"], len(findings), kind["what"])]
    shown = sorted(findings, key=lambda finding: -finding["size"])[:most or None]
    lines += ["    " + finding["what"] + _place(finding) for finding in shown]
    if len(shown) < len(findings):
        lines.append("    and %d more (--max 0 shows all)" % (len(findings) - len(shown)))
    return lines + ["  what next: " + kind["advice"]]


def _place(finding):
    if finding["x"] is None:
        return ""
    place = "(%.2f, %.2f)" % (finding["x"], finding["y"])
    return "" if place in finding["what"] else "   at " + place


def _contents(report):
    parts = [_count(report["lanes"], "lane"), "%.1f km of them to drive on" % (report["driving_length"] / 1000.0)]
    parts += [_count(report[key], name) for key, name in (("parking_spaces", "parking space"), ("areas", "area"),
                                                          ("junctions", "junction")) if report[key]]
    return ", ".join(parts)


def _count(number, name):
    return "%d %s%s" % (number, name, "" if number == 1 else "s")


def _output(words):
    try:
        result = subprocess.run([_program()] + words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    except OSError as error:
        raise MapCheckFailed(str(error)) from error
    if result.returncode != 0:
        told = result.stderr.decode("utf-8", "replace").strip()
        raise MapCheckFailed(told or "%s ended with %d" % (PROGRAM, result.returncode))
    return result.stdout.decode("utf-8", "replace")


def _program():
    """Beside the command itself, or where the workspace has its programs."""
    folders = [os.path.dirname(os.path.abspath(sys.argv[0]))]
    folders += [os.path.join(prefix, "lib", "external_command")
                for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if prefix]
    for folder in folders:
        path = os.path.join(folder, PROGRAM)
        if os.access(path, os.X_OK):
            return path
    raise MapCheckFailed("there is no program %s in %s: build the package, and source the workspace's setup.bash" %
                         (PROGRAM, " or ".join(folders)))
