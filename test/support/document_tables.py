# SPDX-License-Identifier: Apache-2.0
"""The tables of a page in doc/, for tests that compare them with what they tell of."""
import os
import re

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))


def page(name):
    with open(os.path.join(ROOT, "doc", name), encoding="utf-8") as file:
        return file.read()


def section(text, title):
    """What stands below the heading, up to the next one of any level."""
    found = re.search(r"^#+ %s$(.*?)(?=^#|\Z)" % re.escape(title), text, re.MULTILINE | re.DOTALL)
    if not found:
        raise AssertionError("there is no section %r" % title)
    return found.group(1)


def rows(text):
    """The cells of each row of the tables in `text`, without heads and rulers."""
    lines = [line.strip() for line in text.splitlines()]
    ruler = re.compile(r"^\|(-+\|)+$")
    table = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
             for line, below in zip(lines, lines[1:] + [""])
             if line.startswith("|") and not ruler.match(line) and not ruler.match(below)]
    return table


def code(cell):
    """What stands between backticks; None where nothing does."""
    found = re.match(r"`([^`]*)`", cell)
    return found.group(1) if found else None
