"""The README promises two commands; CI runs these two first, spelt the same, and then parts of scripts/check."""

import os
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def two_commands():
    """The lines of the first code block after the heading "Two commands"."""
    section = README.split("## Two commands", 1)[1]
    block = re.search(r"```\w*\n(.*?)```", section, re.DOTALL).group(1)
    return [line for line in block.splitlines() if line.strip()]


class Readme(unittest.TestCase):
    def test_ci_runs_the_two_commands_as_they_are_printed_and_then_the_checks(self):
        script = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
        setting = ("#", "set ", "cd ")
        run = [line for line in script if line.strip() and not line.startswith(setting)]
        self.assertEqual(len(two_commands()), 2)
        self.assertEqual(run, [*two_commands(), "scripts/check tidy-new age console"])

    def test_the_parts_that_ci_runs_are_of_scripts_check(self):
        check = (ROOT / "scripts" / "check").read_text(encoding="utf-8")
        for part in ("age", "tidy-new"):
            self.assertIn(f"\npart_{part}() {{\n", check)

    def test_the_commands_are_files_that_can_be_run(self):
        for name in [command.split()[0] for command in two_commands()] + [".ci/run", "scripts/check"]:
            path = ROOT / name
            self.assertTrue(path.is_file(), name)
            self.assertTrue(os.access(path, os.X_OK), f"{name} is not executable")
            self.assertEqual(path.read_text(encoding="utf-8").splitlines()[0], "#!/usr/bin/env bash")

    def test_it_is_short_and_shows_a_picture(self):
        self.assertLess(len(README.splitlines()), 120)
        pictures = re.findall(r"!\[[^\]]+\]\(([^)]+\.png)\)", README)
        self.assertTrue(pictures)
        for picture in pictures:
            self.assertLess((ROOT / picture).stat().st_size, 250_000, picture)

    def test_it_names_every_module(self):
        for module in ("base/", "segment/", "cam/", "devices/", "sim/", "app/", "tests/", "docs/"):
            self.assertIn(f"`{module}`", README)


if __name__ == "__main__":
    unittest.main()
