#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What doc/ says of messages, of the example, and of other pages, is so."""
import os
import re
import sys
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "test", "support"))
import document_tables as document  # noqa: E402  (of this package's sources)

BLOCK = re.compile(r"^```(cpp|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)]+)\)")


def read(*parts):
    with open(os.path.join(ROOT, *parts), encoding="utf-8") as file:
        return file.read()


def sources():
    """All code of the package, in which a text over several lines of it is one."""
    text = ""
    for top in ("include", "scripts", "src"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            text += "".join(read(folder, name) for name in names if name.endswith((".h", ".cpp", ".py")))
    return re.sub(r'"\s*\n\s*"', "", text)


def constants(message, kind="uint8"):
    return {name: int(number) for name, number in
            re.findall(r"^%s (\w+)=(\d+)" % kind, read("msg", message + ".msg"), re.MULTILINE)}


def named_numbers(text):
    """`NAME` (7) -> {NAME: 7}"""
    return {name: int(number) for name, number in re.findall(r"`?(\w+)`? \((\d+)\)", text)}


def pages():
    return ["README.md"] + ["doc/" + name for name in sorted(os.listdir(os.path.join(ROOT, "doc"))) if name.endswith(".md")]


def anchors(text):
    """As GitHub makes them of headings."""
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title).lower().replace(" ", "-") for title in titles}


class DocumentsTest(unittest.TestCase):
    def test_the_readme_leads_to_every_page(self):
        linked = set(LINK.findall(document.section(read("README.md"), "Pages")))
        self.assertEqual(linked, set(pages()) - {"README.md"})

    def test_every_error_code_is_explained_and_has_a_way_out(self):
        codes = constants("CommandStatus", "uint16")
        self.assertEqual(len(codes), 16)
        interface = document.section(document.page("vehicle_interface.md"), "Error codes")
        self.assertEqual({name: number for cells in document.rows(interface)
                          for name, number in named_numbers(cells[0]).items()}, codes)
        titles = re.findall(r"^## (\w+ \(\d+\))$", document.page("troubleshooting.md"), re.MULTILINE)
        self.assertEqual(named_numbers(" ".join(titles)), codes)

    def test_the_code_says_the_messages_that_are_explained(self):
        text = sources()
        tables = document.page("troubleshooting.md").split("| the message says |")[1:]
        quoted = [message for table in tables for message, *_ in document.rows("|" + table.split("\n\n")[0])]
        pieces = [piece.strip() for message in quoted for code in re.findall(r"`([^`]*)`", message)
                  for piece in re.split(r"\.\.\.|~", code)]
        self.assertGreater(len(pieces), 40)
        self.assertEqual([piece for piece in pieces if piece not in text], [])

    def test_every_action_is_explained_by_what_is_sent_for_it(self):
        table = document.rows(document.section(document.page("vehicle_interface.md"), "Actions"))
        self.assertEqual({name: number for cells in table for name, number in named_numbers(cells[0]).items()},
                         constants("ActionCommand"))
        for _, sent, _ in table:
            message = document.code(sent)
            self.assertTrue(named_numbers(sent), sent)
            self.assertLessEqual(named_numbers(sent).items(), constants(message).items(), sent)

    def test_reports_have_the_numbers_of_the_message(self):
        table = document.rows(document.section(document.page("vehicle_interface.md"), "Reports"))
        told = {name: number for cells in table for name, number in named_numbers(cells[0]).items()}
        self.assertEqual(set(told), {"RUNNING", "FINISHED", "ERROR"})
        self.assertLessEqual(told.items(), constants("CommandStatus").items())

    def test_code_of_the_planner_stub_is_that_of_the_example(self):
        sources = [read("examples", "planner_stub", *path) for path in (("src", "planner_stub.cpp"),
                                                                         ("scripts", "planner_stub.py"))]
        blocks = BLOCK.findall(document.page("on_the_vehicle.md"))
        self.assertGreater(len(blocks), 2)
        for _, block in blocks:
            self.assertTrue(any(block in source for source in sources), "not in the example:\n" + block)

    def test_links_lead_somewhere(self):
        for page in pages():
            folder = os.path.dirname(os.path.join(ROOT, page))
            for link in LINK.findall(read(page)):
                if link.startswith("http"):
                    continue
                path, _, anchor = link.partition("#")
                target = os.path.join(folder, path) if path else os.path.join(ROOT, page)
                self.assertTrue(os.path.exists(target), "%s: %s" % (page, link))
                if anchor:
                    self.assertIn(anchor, anchors(read(target)), "%s: %s" % (page, link))


if __name__ == "__main__":
    unittest.main()
