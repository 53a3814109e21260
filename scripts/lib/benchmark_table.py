# SPDX-License-Identifier: Apache-2.0
"""The measurements of the benchmark programs as one table: what was timed, beside what it is compared with."""
import os

TITLES = ("what", "map", "lanes", "median", "99 %", "beside", "median", "99 %", "ratio", "99 %")


def _times(scale, unit, *values):
    return tuple("" if value is None else f"{value * scale:.4g} {unit}" for value in values)


def _ratio(one, other):
    return f"{one / other:.2f}" if one is not None and other else ""


def _name(path):
    """A map's folder, and its file where that is not the usual one."""
    folder, file = os.path.split(path)
    folder = os.path.basename(folder)
    return folder if folder and file.startswith("base_map.") else os.path.join(folder, file)


def _row(measurement, what, unit, ours, beside="", theirs=(None, None), scale=1.0):
    """`ours` and `theirs`: names of a median, and of a 99th percentile or None; `beside` says what theirs are of."""
    mine, other = ([measurement.get(key) for key in keys] for keys in (ours, theirs))
    if mine[0] is None:
        return []
    return [(what, _name(measurement.get("map") or measurement.get("file", "")), str(measurement.get("lanes", "")),
             *_times(scale, unit, *mine), beside if other[0] is not None else "", *_times(scale, unit, *other),
             *(_ratio(one, two) for one, two in zip(mine, other)))]


def _rows(measurement):
    program = measurement.get("benchmark")
    if program == "map_benchmark":
        return (_row(measurement, "load", "ms", ("load_ms", None), "protobuf's parsing", ("protobuf_parse_ms", None))
                + _row(measurement, "memory of the map", "MB", ("memory_growth_mb", None), "the file", ("file_mb", None))
                + _row(measurement, "second start", "ms", ("second_start_ms", None), "the first",
                       ("first_start_ms", None))
                + _row(measurement, "memory after it", "MB", ("second_start_mb", None), "the first",
                       ("first_start_mb", None))
                + _row(measurement, "at most meanwhile", "MB", ("second_start_peak_mb", None), "the first",
                       ("first_start_peak_mb", None)))
    if program == "routing_benchmark":
        return _row(measurement, "path, per km", "us", ("path_us_per_km_median", "path_us_per_km_p99"))
    if program == "route_search_benchmark":
        return (_row(measurement, "index of a router", "ms", ("index_s", None), scale=1e3)
                + _row(measurement, "route", "us", ("route_us_median", "route_us_p99"), "Dijkstra",
                       ("plain_us_median", "plain_us_p99")))
    if program == "service":
        vehicles = measurement.get("vehicles", 1)
        what = "lane follow" if vehicles == 1 else f"lane follow, {vehicles} vehicles"
        return (_row(measurement, what, "us", ("lane_follow_us", "lane_follow_p99_us"), "empty service",
                     ("empty_us", "empty_p99_us"))
                + _row(measurement, "memory of one more vehicle", "MB", ("further_vehicle_mb", None),
                       "the first, with the map", ("first_vehicle_mb", None)))
    return []


def text_of(measurements):
    """Columns, the failures below them."""
    rows = [TITLES] + [row for measurement in measurements for row in _rows(measurement)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(TITLES))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    lines += [f"FAILED: {measurement.get('benchmark', '')}: {measurement['error']}"
              for measurement in measurements if "error" in measurement]
    return "\n".join(lines)
