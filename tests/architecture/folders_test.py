"""Holds the folders of the modules to folders.py, and it to planted faults."""

import tempfile
import unittest
from pathlib import Path

from folders import MOST_FILES, MOST_LINES, faults

ROOT = Path(__file__).resolve().parents[2]

README = """# base/things

Things of all kinds.

Entry: `a.h`, what others include.

- `a.h`: the first
- `b.h`: the second
- `c.h`: the third
- `inner/`: what the first is made of
"""
INNER = "# base/things/inner\n\nWhat a thing is made of.\n\nEntry: `../a.h`\n"


class Folders(unittest.TestCase):
    def test_every_folder_is_small_and_has_a_readme(self):
        self.assertEqual(list(faults(ROOT)), [])

    def faults_with(self, readme=README, more=()):
        """Those of one folder of three headers, with one folder in it."""
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            folder = root / "base" / "things"
            (folder / "inner").mkdir(parents=True)
            (root / "base" / "README.md").write_text("# base\n\nEntry: `things/`\n\n- `things/`: all\n", encoding="utf-8")
            (folder / "inner" / "d.cpp").touch()
            (folder / "inner" / "README.md").write_text(INNER.replace("../a.h", "d.cpp"), encoding="utf-8")
            for header in ("a.h", "b.h", "c.h", *more):
                (folder / header).touch()
            if readme is not None:
                (folder / "README.md").write_text(readme, encoding="utf-8")
            return [fault.removeprefix("base/things: ") for fault in faults(root)]

    def test_a_sound_folder_has_no_fault(self):
        self.assertEqual(self.faults_with(), [])

    def test_too_many_files_are_found(self):
        more = [f"more_{number}.h" for number in range(MOST_FILES - 4)]
        self.assertEqual(self.faults_with(more=more), [])
        self.assertEqual(self.faults_with(more=[*more, "last.h"]), ["holds 41 files, 40 are allowed"])

    def test_a_planted_fault_of_a_readme_is_found(self):
        for what, readme, words in (
            ("none", None, "has no README.md"),
            ("of another folder", README.replace("# base/things", "# base/other"), "name of the folder"),
            ("no entry", README.replace("Entry: `a.h`", "See `a.h`"), "names no entry"),
            ("two entries", README + "Entry: `b.h`\n", "names no entry, or more than one"),
            ("an entry that is gone", README.replace("Entry: `a.h`", "Entry: `gone.h`"), "names gone.h, which is not"),
            ("a landmark that is gone", README.replace("`b.h`", "`gone.h`"), "names gone.h, which is not there"),
            ("a folder that is gone", README + "- `outer/`: nothing\n", "names outer/, which is not there"),
            ("a name in passing that is gone", README.replace("of all kinds", "of `gone.md`"), "names gone.md"),
            ("too few landmarks", README.replace("- `b.h`: the second\n", ""), "has 2 files as landmarks"),
            ("too many landmarks", README + "- `a.h`: again\n" * 4, "has 7 files as landmarks"),
            ("a folder left out", README.replace("- `inner/`", "- inner"), "has no line for inner/"),
            ("too long", README + "\n" * MOST_LINES, "lines, 24 are allowed"),
        ):
            with self.subTest(what):
                self.assertTrue(any(words in fault for fault in self.faults_with(readme)), self.faults_with(readme))


if __name__ == "__main__":
    unittest.main()
