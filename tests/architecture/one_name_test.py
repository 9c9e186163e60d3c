"""Holds the types of the modules to one_name.py, and it to planted faults."""

import tempfile
import unittest
from pathlib import Path

from one_name import faults
from includes import MODULES

ROOT = Path(__file__).resolve().parents[2]
HEADER = "namespace qchopper {\nstruct Thing {\n    int a = 0;\n};\n}  // namespace qchopper\n"
HIDDEN = "namespace qchopper {\nnamespace {\nstruct Thing {\n    int a = 0;\n};\n}  // namespace\n}  // namespace qchopper\n"
ALIAS = "namespace qchopper {\nusing Thing = int;\n}  // namespace qchopper\n"


class OneName(unittest.TestCase):
    def test_no_two_types_share_a_name(self):
        self.assertEqual(faults(ROOT), [])

    def test_a_planted_fault_is_found_and_a_hidden_type_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for module in MODULES:
                (root / module).mkdir()
            (root / "segment" / "a.h").write_text(HEADER, encoding="utf-8")
            self.assertEqual(faults(root), [])
            (root / "app" / "b.cpp").write_text(HIDDEN, encoding="utf-8")
            self.assertEqual(faults(root), [])
            for name, text in (("b.cpp", HEADER), ("c.h", ALIAS)):
                (root / "app" / name).write_text(text, encoding="utf-8")
                self.assertEqual(faults(root), [f"Thing is defined in segment/a.h and in app/{name}"])
                (root / "app" / name).unlink()


if __name__ == "__main__":
    unittest.main()
