# SPDX-License-Identifier: Apache-2.0
"""Runs the unittest cases of one Python file and writes a JUnit XML file: run_unittest.py TEST_FILE RESULT_FILE"""
import importlib.util
import os
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree


class JunitResult(unittest.TextTestResult):
    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.suite = ElementTree.Element("testsuite")
        self._started = 0.0

    def startTest(self, test):
        super().startTest(test)
        self._started = time.monotonic()

    def addSuccess(self, test):
        super().addSuccess(test)
        self._add(test)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self._add(test, "failure", self.failures[-1][1])

    def addError(self, test, err):
        super().addError(test, err)
        self._add(test, "error", self.errors[-1][1])

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self._add(test, "skipped", reason)

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err is not None:
            self._add(subtest, "failure", "".join(self._exc_info_to_string(err, test)))

    def _add(self, test, kind=None, text=""):
        class_name, _, name = test.id().rpartition(".")
        seconds = f"{time.monotonic() - self._started:.3f}"
        case = ElementTree.SubElement(self.suite, "testcase", classname=class_name, name=name, time=seconds)
        if kind:
            ElementTree.SubElement(case, kind).text = text


def main(test_file, result_file):
    name = os.path.splitext(os.path.basename(test_file))[0]
    spec = importlib.util.spec_from_file_location(name, test_file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    sys.path.insert(0, os.path.dirname(os.path.abspath(test_file)))
    spec.loader.exec_module(module)
    suite = unittest.defaultTestLoader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(resultclass=JunitResult, verbosity=2).run(suite)
    for key, value in (("name", name), ("tests", len(result.suite)), ("failures", len(result.suite.findall("*/failure"))),
                       ("errors", len(result.suite.findall("*/error")))):
        result.suite.set(key, str(value))
    os.makedirs(os.path.dirname(os.path.abspath(result_file)), exist_ok=True)
    ElementTree.ElementTree(result.suite).write(result_file, encoding="utf-8", xml_declaration=True)
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
