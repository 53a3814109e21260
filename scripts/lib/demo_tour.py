# SPDX-License-Identifier: Apache-2.0
"""The demo's tour: types the examples of README.md one after the other, each once the one before has ended."""
import os
import re
import subprocess
import time

import yaml
from external_command.msg import CommandStatus

from demo_drive import NAMESPACE, STATUS_NAMES

EXAMPLE = re.compile(r"^rosservice call (%sexternal_command/(\w+)).*$" % NAMESPACE, re.MULTILINE)
PICTURE_AT = {"valet_parking": 0.99, "precise_parking": 0.95}  # of the way
PICTURE_OF_OTHERS_AT = 0.5
TIMEOUT = 900.0  # for a command to end [s]
NEWS = 5.0  # between two lines on how far one is [s]
FIGURES = (("path_length", "path %.0f m"), ("reverse_length", "%.0f m of it in reverse"),
           ("gear_changes", "%d gear changes"), ("coverage_ratio", "%.2f of the area swept"))


class Example:
    def __init__(self, call, service, purpose):
        self.call = call
        self.service = service
        self.purpose = purpose  # empty where the page does not say it
        self.is_motion = False  # until it is answered

    def answer(self):
        """What it prints, as a dictionary."""
        printed = subprocess.run(["bash", "-c", self.call], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        text = printed.stdout.decode(errors="replace")
        answer = yaml.safe_load(text) if printed.returncode == 0 else None
        return answer if isinstance(answer, dict) else {"error_code": CommandStatus.INTERNAL_ERROR, "error_message": text}


def read_examples(page):
    """Of README.md: the calls, and what its table of services says of each."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    purposes = dict(re.findall(r"^\| `(\w+)` \| (.*?) \|", text, re.MULTILINE))
    return [Example(found.group(0), found.group(2), purposes.get(found.group(2), "")) for found in EXAMPLE.finditer(text)]


class Tour:
    def __init__(self, stack, command_status, guide=None):
        """`guide`: told of each command that is driven, where there is one."""
        self._stack = stack
        self._command_status = command_status
        self._guide = guide

    def go(self, examples):
        """Returns whether all have ended well."""
        good = 0
        for number, example in enumerate(examples, 1):
            print(f"\n{number} of {len(examples)}  {example.service}: {example.purpose}\n$ {example.call}", flush=True)
            good += self._try(example)
        print(f"\n{good} of {len(examples)} ended as they should", flush=True)
        return good == len(examples)

    def _try(self, example):
        answer = example.answer()
        if "status" not in answer:
            show_other(answer)
            return answer.get("error_code", CommandStatus.OK) == CommandStatus.OK
        show_status(answer["status"])
        example.is_motion = "report" in answer
        show_report(answer.get("report", {}))
        begin = time.monotonic()
        status = self._wait(answer["status"], example)
        if status["status"] != answer["status"]["status"]:
            show_status(status, time.monotonic() - begin)
        return status["status"] == CommandStatus.FINISHED

    def _wait(self, status, example):
        """The status that the command ends with."""
        begin = told = time.monotonic()
        while status["status"] == CommandStatus.RUNNING and time.monotonic() < begin + TIMEOUT:
            self._stack.check()
            time.sleep(0.1)
            now = self._command_status(status["command_id"])
            status = {"status": now.status, "command_id": now.command_id, "message": now.message}
            if self._guide and example.is_motion:
                self._guide.on_way(example, now)
            if now.status == CommandStatus.RUNNING and time.monotonic() > told + NEWS:
                told = time.monotonic()
                print(f"  ... {now.message}", flush=True)
        return status


class Walk:
    """A guide that takes a picture of each motion on its way, in an rviz that follows the vehicle."""

    def __init__(self, camera, folder):
        self._camera = camera
        self._folder = folder
        self._taken = set()

    def on_way(self, example, status):
        is_over = status.status != CommandStatus.RUNNING
        is_far = status.has_progress and status.share_done >= PICTURE_AT.get(example.service, PICTURE_OF_OTHERS_AT)
        if example.service in self._taken or not (is_far or is_over):
            return
        self._taken.add(example.service)
        picture = os.path.join(self._folder, f"tour_{example.service}.png")
        problem = self._camera.shoot(picture)
        print(f"  no picture: {problem}" if problem else f"  picture: {picture}", flush=True)


def show_status(status, seconds=None):
    after = "" if seconds is None else f" after {seconds:.0f} s"
    print(f"  {STATUS_NAMES.get(status['status'], status['status'])}{after}: {status['message']} "
          f"(command {status['command_id']})", flush=True)


def show_report(report):
    figures = [text % report[key] for key, text in FIGURES if report.get(key)]
    if figures:
        print("  " + ", ".join(figures), flush=True)
    for warning in report.get("warnings", []):
        print(f"  warning: {warning}", flush=True)


def show_other(answer):
    lines = yaml.safe_dump(answer, default_flow_style=False).splitlines()
    print("\n".join("  " + line for line in lines[:12] + ["..."] * (len(lines) > 12)), flush=True)
