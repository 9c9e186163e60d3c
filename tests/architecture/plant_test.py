"""Holds the table of scripts/plant to the sources, and the script to what it refuses."""

import tempfile
import unittest
import unittest.mock
from pathlib import Path

from check_page_test import ROOT, script
from includes import MODULES

plant = script("plant")

FAULT = plant.Fault("sum: sign", "base/a.cpp", "    return a + b;", "    return a - b;", "tests/base/test_a", "*")
TEXT = "int sum(int a, int b) {\n    return a + b;\n}\n"


class Plant(unittest.TestCase):
    def test_every_line_of_the_table_is_found_exactly_once(self):
        self.assertEqual(list(plant.unplantable(ROOT, plant.FAULTS)), [])

    def test_faults_are_of_all_modules_and_name_programs_that_are_built(self):
        self.assertEqual(len({fault.what for fault in plant.FAULTS}), len(plant.FAULTS))
        self.assertEqual({fault.file.split("/")[0] for fault in plant.FAULTS}, set(MODULES))
        for fault in plant.FAULTS:
            folder, _, name = fault.program.rpartition("/")
            self.assertIn(f"qchopper_test({name}\n", (ROOT / folder / "CMakeLists.txt").read_text().replace(" ", "\n"))

    def unplantable(self, text, fault=FAULT):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "base").mkdir()
            (Path(folder) / "base" / "a.cpp").write_text(text, encoding="utf-8")
            return list(plant.unplantable(Path(folder), [fault]))

    def test_a_line_that_is_not_there_exactly_once_is_refused(self):
        self.assertEqual(self.unplantable(TEXT), [])
        for text, count in (
            (TEXT.replace("+", "*"), 0),
            (TEXT.replace("    return", "  return"), 0),
            (TEXT.replace("b;", "b; // all"), 0),
            (TEXT + TEXT, 2),
        ):
            self.assertEqual(self.unplantable(text), [f"sum: sign: base/a.cpp has its line {count} times"])
        gone = plant.Fault("sum: sign", "base/gone.cpp", FAULT.old, FAULT.new, FAULT.program, "*")
        self.assertEqual(self.unplantable(TEXT, gone), ["sum: sign: base/gone.cpp has its line 0 times"])
        same = plant.Fault("sum: sign", "base/a.cpp", FAULT.old, FAULT.old, FAULT.program, "*")
        self.assertEqual(self.unplantable(TEXT, same), ["sum: sign: its line changes nothing"])

    def test_what_was_planted_is_taken_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "base" / "a.cpp"
            path.parent.mkdir()
            path.write_text(TEXT, encoding="utf-8")
            seen = []
            with unittest.mock.patch.multiple(
                plant,
                build=lambda root, programs: seen.append(path.read_text()) or unittest.mock.Mock(returncode=0),
                passes=lambda root, fault: False,
            ):
                self.assertEqual(plant.outcome(Path(folder), FAULT), "caught")
            self.assertEqual(seen, [TEXT.replace("+", "-")])
            self.assertEqual(path.read_text(encoding="utf-8"), TEXT)

    def test_a_fault_that_does_not_compile_or_passes_is_not_caught(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "base" / "a.cpp"
            path.parent.mkdir()
            path.write_text(TEXT, encoding="utf-8")
            for code, passed, what in ((1, False, "does not compile"), (0, True, "missed")):
                with unittest.mock.patch.multiple(
                    plant,
                    build=lambda root, programs, code=code: unittest.mock.Mock(returncode=code),
                    passes=lambda root, fault, passed=passed: passed,
                ):
                    self.assertEqual(plant.outcome(Path(folder), FAULT), what)


if __name__ == "__main__":
    unittest.main()
