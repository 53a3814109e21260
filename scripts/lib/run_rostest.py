# SPDX-License-Identifier: Apache-2.0
"""Runs a rostest and puts its results into a folder of any name: run_rostest.py FOLDER PACKAGE ROSTEST ARGUMENT...

rostest hands the path of the results to its test nodes without quotes, so they are written to a folder without spaces.
Those of the test nodes, whose names do not tell the rostest, go into a folder of its name.
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile


def main(folder, package, *rostest):
    own_result = "rostest-" + rostest[rostest.index("--results-filename") + 1]
    of_nodes = os.path.join(folder, os.path.splitext(own_result)[0])
    shutil.rmtree(of_nodes, ignore_errors=True)
    os.makedirs(of_nodes)
    with tempfile.TemporaryDirectory(prefix="rostest_") as base:
        code = subprocess.call([sys.executable, *rostest, "--package=" + package, "--results-base-dir", base])
        for path in glob.glob(os.path.join(base, package, "*.xml")):
            name = os.path.basename(path)
            shutil.move(path, os.path.join(folder if name == own_result else of_nodes, name))
    return code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
