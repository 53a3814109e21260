# SPDX-License-Identifier: Apache-2.0
"""Runs the test programs that CMake knows of, and counts their cases.

One line per program, the failures' texts at the end, and as the very last line `N passed, N failed`.
"""
import argparse
import collections
import glob
import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import List

import owned_processes
from test_results import Counts, count_program

# Seconds after which a program counts as hanging.
TIMEOUT = float(os.environ.get("EC_TEST_TIMEOUT", "300"))


@dataclass
class Program:
    kind: str  # gtest, rostest, ...
    name: str
    command: List[str]
    result_file: str
    is_serial: bool  # nothing may run beside it
    cost: float  # about how many seconds it takes; 0 where CMake names none

    @property
    def title(self):
        return f"{self.kind} {self.name}"

    @property
    def is_split_by_rostest(self):
        """The quotes are left out."""
        return self.is_registered_by_rostest and " " in self.result_file

    @property
    def is_registered_by_rostest(self):
        """By its own CMake functions, as in the examples: results of test nodes lie where all of its package do, and are
        mixed up with others' that run at the same time."""
        return self.kind == "rostest" and "run_rostest.py" not in self.command[-1]

    @property
    def result_folder(self):
        return os.path.dirname(self.result_file)

    @property
    def sub_results(self):
        """Files that rostest's test nodes wrote, beside rostest's own."""
        if self.kind != "rostest":
            return []
        folder, name = os.path.split(os.path.splitext(self.result_file)[0])
        pattern = "rosunit-*" if self.is_registered_by_rostest else os.path.join(glob.escape(name), "*.xml")
        return sorted(glob.glob(os.path.join(glob.escape(folder), pattern)))

    def forget_sub_results(self):
        for path in self.sub_results:
            os.remove(path)


def list_programs(build_dir):
    """Those of this package, and of the examples that are built in examples/ of the build folder."""
    programs = _programs_of(build_dir, "external_command", "")
    for folder in sorted(glob.glob(os.path.join(glob.escape(build_dir), "examples", "*"))):
        package = os.path.basename(folder)
        programs += _programs_of(folder, package, package + "/")
    return programs


def _programs_of(build_dir, package, prefix):
    """catkin registers each test with ctest; the command ends in `run_tests.py RESULT_FILE ... COMMAND`."""
    listing = json.loads(subprocess.check_output(["ctest", "--show-only=json-v1"], cwd=build_dir))
    environment = os.path.join(build_dir, "devel", "env.sh")
    return [_program(test, package, prefix, environment) for test in listing["tests"]]


def _program(test, package, prefix, environment):
    command = test["command"]
    wrapper = next(index for index, word in enumerate(command) if word.endswith("/run_tests.py"))
    _, _, rest = test["name"].partition(f"_ctest_{package}_")
    kind, _, name = rest.partition("_")
    properties = {each["name"]: each["value"] for each in test.get("properties", [])}
    return Program(kind, prefix + name, [environment] + command, command[wrapper + 1],
                   is_serial=bool(properties.get("RUN_SERIAL")), cost=properties.get("COST", 0.0))


def select(programs, words):
    """The programs whose title contains one of the words; all where there are none. Longest first, so that none of them
    is at work alone at the end."""
    chosen = [program for program in programs if not words or any(word in program.title for word in words)]
    return sorted(chosen, key=lambda program: (program.is_serial, -program.cost, program.kind == "rostest", program.title))


class Runner:
    def __init__(self, build_dir):
        self._log_dir = os.path.join(build_dir, "test_logs")
        os.makedirs(self._log_dir, exist_ok=True)
        self._live_marks = set()
        self._is_stopped = False
        self._folders = collections.defaultdict(threading.Lock)  # of results that are told apart by the time alone

    def stop(self):
        """Ends what is running, from whichever thread; nothing is started any more."""
        self._is_stopped = True
        for mark in list(self._live_marks):
            owned_processes.end_all(mark)

    def run(self, program):
        """Runs one program to its end, or to the time-out; leaves none of its processes. Returns its Counts."""
        if program.is_registered_by_rostest:
            with self._folders[program.result_folder]:
                return self._run(program)
        return self._run(program)

    def _run(self, program):
        if self._is_stopped:
            return Counts()
        if program.is_split_by_rostest:
            return Counts(skipped=[f"{program.title}: rostest cannot run it in a path with spaces"])
        started = time.monotonic()
        program.forget_sub_results()
        mark = owned_processes.new_mark()
        log_file = os.path.join(self._log_dir, program.title.replace(" ", "-").replace("/", "-") + ".log")
        exit_code, last_words = self._execute(program, mark, log_file)
        if exit_code is None:
            counts = Counts(failures=[f"no end after {TIMEOUT:.0f} s\n{last_words}"])
        else:
            counts = count_program(program.result_file, program.sub_results, exit_code, last_words)
        seconds = time.monotonic() - started
        verdict = "FAIL" if counts.failures else "ok  "
        print(f"{verdict} {program.title:<60} {counts.text()}  ({seconds:.1f} s)", flush=True)
        counts.failures = [f"{program.title}: {text}\n  (output: {log_file})" for text in counts.failures]
        counts.skipped = [f"{program.title}: {text}" for text in counts.skipped]
        return counts

    def _execute(self, program, mark, log_file):
        """Returns the exit code, or None after a time-out, and the end of the output."""
        environment = owned_processes.marked_environment(mark, ROS_LOG_DIR=self._log_dir + "/ros",
                                                         ROS_HOSTNAME="localhost")
        self._live_marks.add(mark)
        with open(log_file, "wb") as log:
            process = subprocess.Popen(program.command, env=environment, stdin=subprocess.DEVNULL, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
            try:
                return process.wait(TIMEOUT), _tail(log_file)
            except subprocess.TimeoutExpired:
                return None, _tail(log_file)
            finally:
                owned_processes.end_all(mark)
                process.wait()
                self._live_marks.discard(mark)


def _tail(path, lines=20):
    with open(path, encoding="utf-8", errors="replace") as file:
        return "".join(file.readlines()[-lines:]).rstrip()


def run_all(programs, runner, jobs):
    total = Counts()
    side_by_side = [program for program in programs if not program.is_serial]
    with ThreadPoolExecutor(jobs) as pool:
        try:
            for counts in pool.map(runner.run, side_by_side):
                total.add(counts)
        except BaseException:  # Ctrl-C; the pool waits for its workers
            runner.stop()
            raise
    for program in programs:
        if program.is_serial:
            total.add(runner.run(program))
    return total


def report(total):
    for heading, texts in (("skipped", total.skipped), ("failed", total.failures)):
        if texts:
            print(f"\n--- {heading} ---")
            print("\n".join(texts))
    print(f"\n{total.passed} passed, {len(total.failures)} failed", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build_dir", type=os.path.abspath)
    parser.add_argument("names", nargs="*", help="only programs whose kind and name contain one of these words")
    parser.add_argument("--list", action="store_true", help="print the programs and stop")
    parser.add_argument("--jobs", type=int, default=(os.cpu_count() or 1) + 2,
                        help="programs that run side by side; half of their time they wait for vehicles that drive")
    args = parser.parse_args()
    programs = select(list_programs(args.build_dir), args.names)
    if args.list:
        print("\n".join(program.title for program in programs))
        return 0
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it in background jobs, for children too
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        total = run_all(programs, Runner(args.build_dir), args.jobs)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    if not programs:
        total.failures.append(f"no test program matches {' '.join(args.names) or 'anything'}")
    report(total)
    return 1 if total.failures else 0


if __name__ == "__main__":
    sys.exit(main())
