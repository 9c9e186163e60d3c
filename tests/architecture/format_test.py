"""Every source is as clang-format would write it. Skipped where clang-format is missing or not of Debian 12 (14)."""

import shutil
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("base", "segment", "cam", "devices", "sim", "app", "tests", "bench")


class Format(unittest.TestCase):
    def test_every_source_is_as_clang_format_writes_it(self):
        tool = shutil.which("clang-format-14") or shutil.which("clang-format")
        if tool is None:
            self.skipTest("skipped: clang-format is not installed")
        version = subprocess.run([tool, "--version"], capture_output=True, text=True, check=True).stdout
        if "version 14." not in version:
            self.skipTest(f"skipped: another version writes otherwise: {version.strip()}")
        files = [
            str(path.relative_to(ROOT))
            for folder in FOLDERS
            for path in sorted((ROOT / folder).rglob("*"))
            if path.suffix in (".h", ".cpp")
        ]
        self.assertGreater(len(files), 100)
        result = subprocess.run([tool, "--dry-run", *files], cwd=ROOT, capture_output=True, text=True, check=False)
        wrong = sorted({line.split(":")[0] for line in result.stderr.splitlines() if "[-Wclang-format" in line})
        self.assertEqual(wrong, [], "clang-format -i mends it")


if __name__ == "__main__":
    unittest.main()
