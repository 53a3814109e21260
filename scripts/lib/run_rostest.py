# SPDX-License-Identifier: Apache-2.0
"""Runs a rostest and puts its results into a folder of any name: run_rostest.py FOLDER PACKAGE ROSTEST ARGUMENT...

rostest hands the path of the results to its test nodes without quotes, so they are written to a folder without spaces.
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile


def main(folder, package, *rostest):
    with tempfile.TemporaryDirectory(prefix="rostest_") as base:
        code = subprocess.call([sys.executable, *rostest, "--package=" + package, "--results-base-dir", base])
        os.makedirs(folder, exist_ok=True)
        for path in glob.glob(os.path.join(base, package, "*.xml")):
            shutil.move(path, os.path.join(folder, os.path.basename(path)))
    return code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
