"""Every relative link in README, CHANGELOG and docs leads to a file, and every #heading in it to a heading.

So does every file of the project that docs, comments and messages name in passing: tests/segment/cut/cut_test.cpp,
docs/user/cell-file.md#tools, or a page of docs/decisions by its number.
"""

import re
import unittest
from pathlib import Path

from includes import MODULES
from ratchet import sources

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
LINK = re.compile(r"\]\(([^)\s]+)\)")
NAMED_SOURCE = re.compile(rf"(?<![\w/.-])(?:{'|'.join(MODULES)}|tests|bench)/[a-z0-9_/]+\.(?:cpp|h|py)\b")

NAMED = re.compile(r"\b(?:docs/[\w/.-]+\w(?:#[\w-]+)?|tests/[a-z0-9_/]+\.(?:cpp|h|py)\b)")


def anchor(heading):
    """As the usual readers of Markdown make it from a heading."""
    words = re.sub(r"[`*_]", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return {anchor(match) for match in re.findall(r"^#+\s+(.*)$", text, re.MULTILINE)}


def named(text):
    """The pages and tests that a source names; a literal that is continued on the next line is one."""
    return NAMED.findall(re.sub(r'"\s*\n\s*"', "", text))


def dead(text):
    """What a source names and is not there."""
    for name in named(text):
        path, _, heading = name.partition("#")
        target = ROOT / path
        if not target.suffix:
            target = next(iter(sorted(target.parent.glob(f"{target.name}*"))), target)
        if not target.exists() or (heading and heading not in anchors(target)):
            yield name


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

    def test_every_source_that_a_page_names_is_there(self):
        count = 0
        for page in PAGES:
            for name in NAMED_SOURCE.findall(page.read_text(encoding="utf-8")):
                count += 1
                with self.subTest(page=page.name, name=name):
                    self.assertTrue((ROOT / name).is_file())
        self.assertGreater(count, 200)

    def test_every_page_and_test_that_a_source_names_is_there(self):
        texts = sources(ROOT, (".h", ".cpp", ".py", ".txt"), (*MODULES, "tests", "bench"))
        self.assertGreater(sum(len(list(named(text))) for text in texts.values()), 100)
        for name, text in texts.items():
            if not name.startswith("tests/architecture/"):  # whose planted faults are not there
                with self.subTest(name):
                    self.assertEqual(list(dead(text)), [])

    def test_a_planted_name_in_a_comment_or_message_is_found(self):
        for text, name in (
            ("// as docs/user/no-page.md says", "docs/user/no-page.md"),
            ('refuse("see docs/user/cell-file.md#no-such-heading");', "docs/user/cell-file.md#no-such-heading"),
            ('refuse("see docs/user/"\n       "no-page.md.");', "docs/user/no-page.md"),
            ("// (docs/decisions/9999)", "docs/decisions/9999"),
            ("// held by tests/base/no_test.cpp", "tests/base/no_test.cpp"),
        ):
            self.assertEqual(list(dead(text)), [name], text)
        for text in ("// docs/decisions/0011.", 'say("docs/user/cell-file.md.");', 'say("docs/user/"\n "cell-file.md");'):
            self.assertEqual(list(dead(text)), [], text)


if __name__ == "__main__":
    unittest.main()
