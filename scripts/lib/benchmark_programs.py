# SPDX-License-Identifier: Apache-2.0
"""The benchmark programs. Each prints a JSON document (an object or a list of objects, a measurement each) to its
standard output."""
import json
import os
import subprocess


def executable(build_dir, name):
    return os.path.join(build_dir, "devel", "lib", "external_command", name)


def measure(name, command, timeout):
    """The measurements of one program, each with its name; a program that fails is a measurement with `error`."""
    if not os.path.exists(command[0]):
        return [{"benchmark": name, "error": f"{command[0]} is not built"}]
    result = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=timeout, check=False)
    output = result.stdout.decode()
    try:
        document = json.loads(output)
    except ValueError:
        return [{"benchmark": name, "error": f"exit code {result.returncode}, no JSON but: {output[-500:]}"}]
    measurements = document if isinstance(document, list) else [document]
    if result.returncode != 0:
        measurements.append({"error": f"exit code {result.returncode}"})
    return [{"benchmark": name, **measurement} for measurement in measurements]
