# SPDX-License-Identifier: Apache-2.0
"""Counts test cases in the JUnit XML files of gtest, rosunit, rostest and Python's unittest."""
import os
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from typing import List


@dataclass
class Counts:
    passed: int = 0
    failures: List[str] = field(default_factory=list)  # one text per failed case
    skipped: List[str] = field(default_factory=list)  # one text per skipped case

    def add(self, other):
        self.passed += other.passed
        self.failures += other.failures
        self.skipped += other.skipped

    def text(self):
        parts = [f"{self.passed} passed", f"{len(self.failures)} failed"]
        return ", ".join(parts + ([f"{len(self.skipped)} skipped"] if self.skipped else []))


def count_file(path):
    """The cases of one XML file. One that is absent or broken is one failure."""
    counts = Counts()
    try:
        cases = ElementTree.parse(path).getroot().iter("testcase")
    except (OSError, ElementTree.ParseError) as error:
        counts.failures.append(f"no readable results in {path}: {error}")
        return counts
    for case in cases:
        _count_case(case, counts)
    return counts


def count_program(result_file, sub_results, exit_code, last_words):
    """The cases of one test program.

    `result_file` is the program's own; rostest writes a case per <test> tag there, and the cases inside each into
    `sub_results`. A program that failed without a failed case (a crash at its end, a test node that died before it
    wrote anything) counts one failure, told by `last_words`, the end of its output.
    """
    if not os.path.exists(result_file):
        return Counts(failures=[f"the program left no results\n{last_words}"])
    own = count_file(result_file)
    counts = Counts()
    for path in sub_results:
        counts.add(count_file(path))
    if not sub_results:
        counts = own
    elif not counts.failures:
        counts.failures += own.failures
    if exit_code != 0 and not counts.failures:
        counts.failures.append(f"the program ended with exit code {exit_code}, though no case failed\n{last_words}")
    if not counts.passed and not counts.failures and not counts.skipped:
        counts.failures.append(f"{os.path.basename(result_file)} holds no test case")
    return counts


def _count_case(case, counts):
    if case.get("status") == "notrun":  # gtest: disabled or filtered out
        return
    name = ".".join(part for part in (case.get("classname"), case.get("name")) if part)
    problems = [child for child in case if child.tag in ("failure", "error")]
    skip = case.find("skipped")
    if problems:
        counts.failures.append(name + "\n" + "\n".join(_message(problem) for problem in problems))
    elif skip is not None or case.get("result") == "skipped":
        counts.skipped.append(f"{name}: {_message(skip) if skip is not None else 'no reason given'}")
    else:
        counts.passed += 1


def _message(element):
    """gtest has the whole text in both places, unittest's traceback is the element's text."""
    message, text = (element.get("message") or "").strip(), (element.text or "").strip()
    return text if message in text or not message else f"{message}\n{text}".strip()
