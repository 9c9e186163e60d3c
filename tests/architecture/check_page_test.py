"""Holds scripts/check_page: the age of lines, quarters, and what is added to docs/checks.md. And what scripts/tidy --new
looks at."""

import importlib.machinery
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def script(name):
    """A script without .py, as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    sys.modules[name] = module  # where dataclasses look
    loader.exec_module(module)
    return module


check_page, tidy = script("check_page"), script("tidy")

HEAD = "# Checks\n\n| date | commit | part | what ran | counts | minutes |\n|---|---|---|---|---|---|\n"


def line(part, commit, counts="9 of 9 passed, 0 skipped"):
    return f"| 2026-11-22 | {commit} | {part} | tests | {counts} | 5 |\n"


class Repository:
    """A folder with a history of empty commits."""

    def __init__(self, test):
        if shutil.which("git") is None:
            test.skipTest("skipped: git is not installed")
        folder = tempfile.TemporaryDirectory()
        test.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "whole"
        self.root.mkdir()
        self.git("init", "-q", "-b", "main")

    def git(self, *words):
        identity = ["-c", "user.name=a", "-c", "user.email=a@b"]
        return subprocess.run(["git", *identity, *words], cwd=self.root, capture_output=True, text=True, check=True).stdout

    def commit(self, files=()):
        for name, text in dict(files).items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text, encoding="utf-8")
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", "a")
        return self.git("rev-parse", "--short", "HEAD").strip()


class Ages(unittest.TestCase):
    def faults(self, root, page):
        return {part: text for part, text, is_fault in check_page.ages(root, page) if is_fault}

    @unittest.mock.patch.object(check_page, "MAX_AGE", 5)
    def test_a_part_may_lie_as_many_commits_back_and_no_more(self):
        repository = Repository(self)
        first = repository.commit()
        second = repository.commit()
        for _ in range(check_page.MAX_AGE):
            repository.commit()
        young = HEAD + "".join(line(part, second) for part in check_page.PARTS)
        self.assertEqual(self.faults(repository.root, young), {})
        self.assertEqual(self.faults(repository.root, young + line("fuzz", first)), {"fuzz": "ran 6 commits ago"})
        self.assertEqual(self.faults(repository.root, young + line("tidy", f"{second} with changes")), {})
        self.assertEqual(
            self.faults(repository.root, young.replace(line("slow", second), "")), {"slow": "has no line"}
        )
        self.assertIn("no ancestor", self.faults(repository.root, young + line("bench", "0123456"))["bench"])

    def test_a_shallow_clone_says_unknown_and_passes(self):
        repository = Repository(self)
        first = repository.commit()
        for _ in range(3):
            repository.commit()
        page = HEAD + "".join(line(part, first) for part in check_page.PARTS)
        shallow = repository.root.parent / "shallow"
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{repository.root}", shallow], check=True)
        told = list(check_page.ages(shallow, page))
        self.assertEqual(len(told), len(check_page.PARTS))
        for _, text, is_fault in told:
            self.assertIn("unknown", text)
            self.assertFalse(is_fault)

    def test_150_commits_are_allowed(self):
        self.assertEqual(check_page.MAX_AGE, 150)

    def test_the_parts_are_those_of_scripts_check(self):
        text = (ROOT / "scripts" / "check").read_text(encoding="utf-8")
        self.assertIn(f"\nwhole=({' '.join(check_page.PARTS)})\n", text)


class Quarters(unittest.TestCase):
    LISTING = "Test project /x\n" + "".join(f"  Test  #{n}: Suite.Case{n}\n" for n in range(1, 401)) + "\nTotal Tests: 400\n"

    def test_every_test_is_in_one_quarter_and_quarters_are_alike(self):
        chosen = [check_page.choose(self.LISTING, quarter) for quarter in (1, 2, 3, 4)]
        numbers = [list(map(int, text.removeprefix("0,0,0,").split(","))) for text in chosen]
        self.assertEqual(sorted(sum(numbers, [])), list(range(1, 401)))
        for quarter in numbers:
            self.assertGreater(len(quarter), 70)

    def test_a_test_keeps_its_quarter_whatever_others_there_are(self):
        for quarter in (1, 2, 3, 4):
            alone = f"  Test #7: Suite.Case{quarter}\n"
            self.assertEqual(check_page.choose(alone, check_page.quarter_of(f"Suite.Case{quarter}")), "0,0,0,7")

    def test_an_empty_quarter_is_refused_because_ctest_would_run_all(self):
        with self.assertRaises(SystemExit):
            check_page.choose("Total Tests: 0\n", 1)

    def test_four_runs_are_one_line_and_the_fifth_begins_another(self):
        page = HEAD + line("sanitize", "aaaaaaa") + line("tidy", "bbbbbbb")
        for run, commit in enumerate(["ccccccc", "ccccccc", "ddddddd", "ddddddd", "eeeeeee"]):
            quarter = check_page.quarter(page, "sanitize")
            self.assertEqual(quarter, run % 4 + 1)
            page = check_page.added(page, "sanitize", commit, "tests", f"{run} of {run} passed", 7, quarter)
            page = check_page.added(page, "tidy", commit, "clang-tidy", "none", 1)
        lines = [found for found in check_page.lines_of(page) if found[2] == "sanitize"]
        self.assertEqual([found[1] for found in lines], ["aaaaaaa", "ccccccc", "eeeeeee"])
        counts = "1/4: 0 of 0 passed; 2/4: 1 of 1 passed; 3/4: 2 of 2 passed on ddddddd; 4/4: 3 of 3 passed on ddddddd"
        self.assertEqual(lines[1][4:], [counts, "28"])
        self.assertEqual(lines[2][4], "1/4: 4 of 4 passed")
        self.assertEqual(check_page.since(page, "tidy"), "eeeeeee")


class Tidy(unittest.TestCase):
    def test_new_is_what_changed_since_the_last_line_of_tidy(self):
        repository = Repository(self)
        repository.commit({"base/a.cpp": "1", "tests/t.cpp": "1", "cam/old.cpp": "1"})
        then = repository.commit({"base/a.cpp": "2"})
        repository.commit({"tests/t.cpp": "2"})
        repository.commit({"base/b.h": "1"})
        repository.commit({"cam/c.cpp": "1", "README.md": "1"})
        (repository.root / "cam/old.cpp").write_text("2", encoding="utf-8")
        known = ["base/a.cpp", "cam/c.cpp", "cam/old.cpp", "tests/t.cpp"]
        self.assertEqual(tidy.new_names(repository.root, then, known), ["cam/old.cpp", "cam/c.cpp", "base/b.h", "tests/t.cpp"])
        newest = ["cam/c.cpp"]
        self.assertEqual(tidy.new_names(repository.root, "0123456", known), newest, "the newest commit, without that history")
        self.assertEqual(tidy.new_names(repository.root, "", known), newest)

    def test_other_rules_ask_for_every_source(self):
        repository = Repository(self)
        then = repository.commit({"base/a.cpp": "1"})
        repository.commit({"cam/c.cpp": "1", ".clang-tidy": "Checks: '*'"})
        known = ["base/a.cpp", "cam/c.cpp"]
        self.assertEqual(tidy.new_names(repository.root, then, known), ["cam/c.cpp", "base/a.cpp"])


if __name__ == "__main__":
    unittest.main()
