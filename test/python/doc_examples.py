# SPDX-License-Identifier: Apache-2.0
"""The examples of a page of doc/."""
import os
import re

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def page(name):
    with open(os.path.join(ROOT, "doc", name), encoding="utf-8") as file:
        return file.read()


def blocks(name, language):
    """The texts of all blocks of code in this language."""
    return [text for found, text in BLOCK.findall(page(name)) if found == language]


def commands(name):
    """Each line that is to be typed into a shell."""
    return [line for block in blocks(name, "sh") for line in block.splitlines() if line and not line.startswith("#")]
