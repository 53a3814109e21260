#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Rules of the sources that no compiler checks."""
import ast
import importlib.util
import os
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
# ROS headers lie in /usr/include on Debian, so no include path keeps them out of these.
ROS_FREE = ("core", "map", "routing", "motion", "free_space", "coverage")
ROS_INCLUDE = re.compile(
    r'#include\s*[<"](ros|rosgraph|roslib|rosconsole|nodelet|pluginlib|class_loader|tf2?|tf2_\w+|actionlib|xmlrpcpp'
    r"|\w+_msgs|external_command/ros|external_command/[A-Z]\w*\.h|XmlRpc\w*\.h)\b")
# Types of these libraries stay inside; who links this package need not find them.
PRIVATE_INCLUDE = re.compile(r'#include\s*[<"](ompl|google/protobuf|[^>"]*\.pb\.h)')
SOURCES = (".h", ".cpp", ".py", ".cmake", ".proto", ".sh", "CMakeLists.txt")
LICENCE = "SPDX-License-Identifier: Apache-2.0"
MAX_LINES = 400
CATKIN_LINT_IGNORES = ("package_path_name",)  # a checkout may lie in a folder of any name
BUILT = ("build", "CMakeFiles", "__pycache__")


def files(*folders, endings=SOURCES):
    """Paths below the folders of this package (all of it where none is named), hidden and built ones left out."""
    found = []
    for folder in folders or (".",):
        for path, names, file_names in os.walk(os.path.join(ROOT, folder)):
            names[:] = [name for name in names if not name.startswith(".") and name not in BUILT]
            found += [os.path.join(path, name) for name in file_names if name.endswith(endings)]
    return sorted(found)


def scripts():
    """Executable files without an ending in scripts/ (commands and nodes)."""
    folder = os.path.join(ROOT, "scripts")
    paths = [os.path.join(folder, name) for name in sorted(os.listdir(folder)) if "." not in name]
    return [path for path in paths if os.path.isfile(path)]


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def lines_that_match(pattern, paths):
    return [f"{os.path.relpath(path, ROOT)}:{number}: {line}" for path in paths
            for number, line in enumerate(read(path).splitlines(), 1) if pattern.search(line)]


def manifest():
    return ElementTree.parse(os.path.join(ROOT, "package.xml")).getroot()


def imported_packages(paths):
    """Names of what Python files import of other packages: neither of Python itself, nor of this one, nor beside them."""
    names = set()
    for path in paths:
        for node in ast.walk(ast.parse(read(path), path)):
            if isinstance(node, ast.Import):
                names.update(alias.name.split(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                names.add(node.module.split(".")[0])
    return {name for name in names - {"external_command"} if "dist-packages" in _place_of(name)}


def _place_of(module):
    spec = importlib.util.find_spec(module)
    places = [] if spec is None else [spec.origin] + list(spec.submodule_search_locations or [])
    return " ".join(filter(None, places))


class LintTest(unittest.TestCase):
    def test_catkin_lint_finds_nothing(self):
        if not shutil.which("catkin_lint"):
            self.skipTest("catkin_lint is not installed")
        command = ["catkin_lint", "-W2", "--strict", "--quiet", "--offline", ROOT]
        for rule in CATKIN_LINT_IGNORES:
            command += ["--ignore", rule]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual(result.returncode, 0, result.stdout.decode())

    def test_ros_free_libraries_include_nothing_of_ros(self):
        folders = [f"{top}/{name}" for top in ("include/external_command", "src") for name in ROS_FREE]
        self.assertEqual([], lines_that_match(ROS_INCLUDE, files(*folders, endings=(".h", ".cpp"))))

    def test_the_pattern_for_ros_includes_knows_them(self):
        for header in ("ros/ros.h", "nav_msgs/Path.h", "tf2/utils.h", "external_command/ros/status.h",
                       "external_command/Pose.h", "nodelet/nodelet.h"):
            self.assertRegex(f"#include <{header}>", ROS_INCLUDE)
        for header in ("external_command/core/pose.h", "vector", "boost/geometry.hpp", "Eigen/Core"):
            self.assertNotRegex(f"#include <{header}>", ROS_INCLUDE)

    def test_public_headers_include_neither_ompl_nor_protobuf(self):
        self.assertEqual([], lines_that_match(PRIVATE_INCLUDE, files("include", endings=(".h",))))

    def test_every_source_names_its_licence(self):
        nameless = [os.path.relpath(path, ROOT) for path in files() + scripts()
                    if os.path.getsize(path) > 0 and LICENCE not in "".join(read(path).splitlines(True)[:4])]
        self.assertEqual([], nameless)

    def test_no_source_is_too_long(self):
        long = [f"{os.path.relpath(path, ROOT)}: {len(read(path).splitlines())} lines, the limit is {MAX_LINES}"
                for path in files(endings=(".h", ".cpp", ".py")) if len(read(path).splitlines()) > MAX_LINES]
        self.assertEqual([], long)

    def test_the_changelog_begins_with_the_version_of_the_package(self):
        newest = re.search(r"^(\d+\.\d+\.\d+) ", read(os.path.join(ROOT, "CHANGELOG.rst")), re.MULTILINE)
        self.assertEqual(newest.group(1), manifest().findtext("version"))

    def test_package_xml_names_what_python_imports(self):
        declared = {tag: {element.text for element in manifest().iter(tag)}
                    for tag in ("depend", "exec_depend", "test_depend")}
        installed = [path for path in scripts() if "python" in read(path).splitlines()[0]]
        for paths, tags in ((files("src", endings=(".py",)) + installed, ("depend", "exec_depend")),
                            (files("scripts", "test", endings=(".py",)), ("depend", "exec_depend", "test_depend"))):
            known = set().union(*(declared[tag] for tag in tags))
            for name in imported_packages(paths):
                rosdep_key = "python3-" + {"google": "protobuf"}.get(name, name)
                self.assertTrue(known & {name, rosdep_key}, f"{name} is in none of {', '.join(tags)}")

    def test_subtests_of_rostests_are_told_of(self):
        """rosunit shows none that failed; support.TestCase does."""
        silent = [os.path.relpath(path, ROOT) for path in files("test/integration", endings=("_test.py",))
                  if "self.subTest(" in read(path) and "(unittest.TestCase)" in read(path)]
        self.assertEqual([], silent)

    def test_scripts_are_executable_and_parse(self):
        for path in scripts() + files("scripts/lib", endings=(".sh", ".py")):
            with self.subTest(os.path.relpath(path, ROOT)):
                first_line = read(path).splitlines()[0]
                self.assertTrue(os.access(path, os.X_OK) or not first_line.startswith("#!"), "has #!, is not executable")
                if "python" in first_line or path.endswith(".py"):
                    ast.parse(read(path), path)
                else:
                    subprocess.run(["bash", "-n", path], check=True)


if __name__ == "__main__":
    unittest.main()
