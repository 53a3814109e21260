# SPDX-License-Identifier: Apache-2.0
"""Runs the benchmark programs: run_benchmarks.py BUILD_DIR MAP... [--cities CITY...]

A CITY is a map file for which only the search for routes is measured.

Each program prints a JSON document (an object or a list of objects, a measurement each) to its standard output.
"""
import contextlib
import json
import os
import signal
import subprocess
import sys

from demo_stack import DemoError, Stack

MAP_TIMEOUT = 1800.0  # of a program over all maps [s]
SERVICE_TIMEOUT = 300.0


def executable(build_dir, name):
    return os.path.join(build_dir, "devel", "lib", "external_command", name)


def measure(name, command, timeout):
    """The measurements of one program, each with its name; a program that fails is a measurement with `error`."""
    if not os.path.exists(command[0]):
        return [{"benchmark": name, "error": f"{command[0]} is not built"}]
    result = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=timeout, check=False)
    output = result.stdout.decode()
    try:
        document = json.loads(output)
    except ValueError:
        return [{"benchmark": name, "error": f"exit code {result.returncode}, no JSON but: {output[-500:]}"}]
    measurements = document if isinstance(document, list) else [document]
    if result.returncode != 0:
        measurements.append({"error": f"exit code {result.returncode}"})
    return [{"benchmark": name, **measurement} for measurement in measurements]


def measure_service(build_dir, map_file):
    """The round trip of a lane-follow call over a long route, beside that of an empty service of the same process."""
    stack = Stack(build_dir)
    try:
        stack.launch("external_command_process.launch", map=map_file, map_origin="auto",
                     executable="service_benchmark_server")
        from demo_drive import Drive  # rospy reads ROS_MASTER_URI when it is first imported
        drive = Drive(stack)
        drive.connect()
        with contextlib.redirect_stdout(sys.stderr):
            start, goal = drive.choose(None, None)
        command = [executable(build_dir, "service_benchmark"), "__ns:=/apollo",
                   *(repr(value) for value in (start.x, start.y, goal.x, goal.y))]
        return measure("service_benchmark", command, SERVICE_TIMEOUT)
    except DemoError as error:
        return [{"benchmark": "service_benchmark", "error": str(error)}]
    finally:
        stack.end()


def summary(measurement):
    """One line: name, words, then numbers to four digits."""
    words = [str(value) for value in measurement.values() if isinstance(value, str)]
    values = [f"{key} {value:.4g}" for key, value in measurement.items()
              if isinstance(value, (int, float)) and not isinstance(value, bool)]
    return "  ".join(words) + ("\n    " + ", ".join(values) if values else "")


def main(build_dir, maps, cities):
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it in background jobs, for children too
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    measurements = []
    for name in ("map_benchmark", "routing_benchmark") if maps else ():
        measurements += measure(name, [executable(build_dir, name), *maps], MAP_TIMEOUT)
    measurements += measure("route_search_benchmark",
                            [executable(build_dir, "route_search_benchmark"), *maps, *cities], MAP_TIMEOUT)
    if maps:
        measurements += measure_service(build_dir, maps[0])
    lines = "".join(json.dumps(measurement) + "\n" for measurement in measurements)
    with open(os.path.join(build_dir, "benchmark.jsonl"), "w", encoding="utf-8") as file:
        file.write(lines)
    print(lines + "\n" + "\n".join(summary(measurement) for measurement in measurements))
    return 1 if any("error" in measurement for measurement in measurements) else 0


if __name__ == "__main__":
    files = sys.argv[2:]
    split = files.index("--cities") if "--cities" in files else len(files)
    sys.exit(main(sys.argv[1], files[:split], files[split + 1:]))
