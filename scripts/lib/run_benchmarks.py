# SPDX-License-Identifier: Apache-2.0
"""Runs the benchmark programs, and prints what they measure as JSON lines and as a table."""
import argparse
import json
import os
import signal
import sys

import benchmark_table
from benchmark_programs import executable, measure
from measure_service import measure_service

MAP_TIMEOUT = 1800.0  # of a program over all maps [s]


def run(options):
    measurements = []

    def run_program(name, files):
        return measure(name, [executable(options.build_dir, name), *files], MAP_TIMEOUT)

    measurements += run_program("map_benchmark", options.maps + options.cities)
    if options.maps:
        measurements += run_program("routing_benchmark", options.maps)
    measurements += run_program("route_search_benchmark", options.maps + options.cities)
    for map_file in options.maps[:1] + options.cities:
        measurements += measure_service(options.build_dir, map_file, options.vehicles)
    return measurements


def main(words):
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it in background jobs, for children too
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build_dir")
    parser.add_argument("maps", nargs="*", metavar="MAP")
    parser.add_argument("--cities", nargs="*", default=[], metavar="CITY", help="maps whose paths are not measured")
    parser.add_argument("--vehicles", type=int, default=50, metavar="N", help="components of one process")
    options = parser.parse_args(words)
    measurements = run(options)
    lines = "".join(json.dumps(measurement) + "\n" for measurement in measurements)
    with open(os.path.join(options.build_dir, "benchmark.jsonl"), "w", encoding="utf-8") as file:
        file.write(lines)
    print(lines + "\n" + benchmark_table.text_of(measurements))
    return 1 if any("error" in measurement for measurement in measurements) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
