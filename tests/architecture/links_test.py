"""Every relative link in README, CHANGELOG and docs leads to a file, and every #heading in it to a heading.

So does every file of the project that docs and headers name in passing, such as tests/segment/cut/cut_test.cpp.
"""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
LINK = re.compile(r"\]\(([^)\s]+)\)")
NAMED_TEST = re.compile(r"\btests/[a-z_/]+\.(?:cpp|h|py)\b")


def anchor(heading):
    """As the usual readers of Markdown make it from a heading."""
    words = re.sub(r"[`*_]", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return {anchor(match) for match in re.findall(r"^#+\s+(.*)$", text, re.MULTILINE)}


class Links(unittest.TestCase):
    def test_every_relative_link_leads_somewhere(self):
        count = 0
        for page in PAGES:
            text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
            for link in LINK.findall(text):
                if "://" in link:
                    continue
                count += 1
                name, _, heading = link.partition("#")
                target = (page.parent / name).resolve() if name else page
                with self.subTest(page=page.name, link=link):
                    self.assertTrue(target.exists())
                    self.assertTrue(target.is_relative_to(ROOT), "leads out of the project")
                    if heading:
                        self.assertIn(heading, anchors(target))
        self.assertGreater(count, 10)

    def test_every_test_that_a_page_names_is_there(self):
        for page in PAGES:
            for name in NAMED_TEST.findall(page.read_text(encoding="utf-8")):
                with self.subTest(page=page.name, name=name):
                    self.assertTrue((ROOT / name).is_file())

    def test_every_test_that_a_header_names_as_its_law_is_there(self):
        for module in ("base", "segment", "cam", "devices", "sim", "app"):
            for header in sorted((ROOT / module).rglob("*.h")):
                for name in NAMED_TEST.findall(header.read_text(encoding="utf-8")):
                    with self.subTest(header=header.relative_to(ROOT).as_posix(), name=name):
                        self.assertTrue((ROOT / name).is_file())


if __name__ == "__main__":
    unittest.main()
