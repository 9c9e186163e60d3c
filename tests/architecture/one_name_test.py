"""Holds the types of the modules to one_name.py, and it to planted faults."""

import tempfile
import unittest
from pathlib import Path

from one_name import faults
from includes import MODULES

ROOT = Path(__file__).resolve().parents[2]


def source(text):
    return f"namespace qchopper {{\n{text}\n}}  // namespace qchopper\n"


DEFINITION = source("struct Thing {\n    int a = 0;\n};")
FAULTS = {
    "b.cpp": DEFINITION,
    "c.h": source("using Thing = int;"),
    "d.cpp": source("namespace {\nclass Thing {\n    int a = 0;\n};\n}  // namespace"),
}
NO_FAULTS = {
    "e.cpp": source("struct Thing::Part {\n    int a = 0;\n};"),
    "f.cpp": source("struct Other {\n    struct Thing {\n        int a = 0;\n    };\n};"),
    "g.cpp": source("using Thing = int;"),
    "h.h": source("struct Thing;"),
}


class OneName(unittest.TestCase):
    def test_no_two_types_share_a_name(self):
        self.assertEqual(faults(ROOT), [])

    def faults_beside_a_definition(self, name, text):
        """Those of a tree that defines Thing in a header, and holds one more file."""
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for module in MODULES:
                (root / module).mkdir()
            (root / "segment" / "a.h").write_text(DEFINITION, encoding="utf-8")
            (root / "app" / name).write_text(text, encoding="utf-8")
            return faults(root)

    def test_a_planted_fault_is_found_also_in_an_anonymous_namespace(self):
        for name, text in FAULTS.items():
            expected = [f"Thing is defined in segment/a.h and in app/{name}"]
            self.assertEqual(self.faults_beside_a_definition(name, text), expected, name)

    def test_nested_types_aliases_and_out_of_line_definitions_are_no_faults(self):
        for name, text in NO_FAULTS.items():
            self.assertEqual(self.faults_beside_a_definition(name, text), [], name)


if __name__ == "__main__":
    unittest.main()
