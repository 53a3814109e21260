# SPDX-License-Identifier: Apache-2.0
from setuptools import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["external_command"], package_dir={"": "src"}))
