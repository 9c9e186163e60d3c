"""The outputs of the console's page belong to its sources (console_page.py), obey its Content-Security-Policy, and are small."""

import gzip
import json
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from console_page import LIST, faults

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "app" / "console" / "page"
SENT = ("index.html", "page.css", "page.js", "three.js", "events.js", "icon.svg")
MOST_BYTES = 220_000  # gzip, of all that the page needs


class ConsolePage(unittest.TestCase):
    def test_dist_is_of_these_sources(self):
        self.assertEqual(faults(PAGE), [], "scripts/console build makes it again")

    def test_a_planted_change_is_found(self):
        with tempfile.TemporaryDirectory() as name:
            page = Path(name) / "page"
            shutil.copytree(PAGE, page)
            self.assertEqual(faults(page), [])
            (page / "src" / "main.tsx").write_text("changed", encoding="utf-8")
            (page / "src" / "more.ts").touch()
            (page / "dist" / "events.js").unlink()
            self.assertEqual(
                faults(page),
                [f"src/more.ts is not in {LIST}", f"dist/events.js is in {LIST} and not there", "src/main.tsx has changed"],
            )
            (page / LIST).unlink()
            self.assertEqual(faults(page), [f"{LIST} is missing"])

    def test_what_is_sent_is_small(self):
        sizes = {name: len(gzip.compress((PAGE / "dist" / name).read_bytes(), 9)) for name in SENT}
        self.assertLessEqual(sum(sizes.values()), MOST_BYTES, sizes)

    def test_the_document_has_no_inline_script_or_style_and_asks_no_other_server(self):
        html = (PAGE / "dist" / "index.html").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"<script(?![^>]*\bsrc=)|<style|\bstyle=|\bon\w+=", html), [])
        self.assertEqual(re.findall(r"(?:src|href)=\"(?!/\w)[^\"]*\"", html), [])
        css = (PAGE / "dist" / "page.css").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"@import|url\(", css), [])

    def test_the_scripts_evaluate_no_text(self):
        for name in ("page.js", "events.js", "three.js"):
            text = (PAGE / "dist" / name).read_text(encoding="utf-8")
            for call in (r"\beval\(", r"\bnew Function\(", r"\bWebAssembly\b"):
                self.assertIsNone(re.search(call, text), f"{name}: {call}")

    def test_the_sources_write_no_markup(self):
        sources = [path for path in (PAGE / "src").rglob("*") if path.suffix in (".ts", ".tsx")]
        self.assertGreater(len(sources), 20)
        for path in sources:
            text = path.read_text(encoding="utf-8")
            found = re.search(r"dangerouslySetInnerHTML|\b(?:inner|outer)HTML\b|insertAdjacentHTML|document\.write", text)
            self.assertIsNone(found, f"{path.name}: names from files are text nodes")

    def test_versions_are_exact(self):
        package = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))
        for name, version in {**package["dependencies"], **package["devDependencies"]}.items():
            self.assertRegex(version, r"^\d+\.\d+\.\d+$", name)
        lock = json.loads((PAGE / "package-lock.json").read_text(encoding="utf-8"))
        for name, entry in lock["packages"].items():
            if name:
                self.assertTrue(entry.get("integrity", "").startswith("sha512-"), name)


if __name__ == "__main__":
    unittest.main()
