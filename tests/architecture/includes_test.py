"""Holds the #include lines of the modules to the rule in includes.py, and the rule to planted violations."""

import tempfile
import unittest
from pathlib import Path

from includes import MODULES, Tree, faults, faults_in, includes

ROOT = Path(__file__).resolve().parents[2]

# A line added to a file of the tree, and words of the fault that must then be found. A file that is not there is made.
PLANTED = {
    "base sees mesh": ("base/error.h", '#include "segment/mesh/connectivity/edges.h"', "segment comes after base"),
    "segment sees cam": ("segment/cut/cut.h", '#include "cam/cell/cell.h"', "cam comes after segment"),
    "mesh sees cut": ("segment/mesh/connectivity/shells.cpp", '#include "segment/cut/cut.h"', "segment/cut comes after"),
    "import sees search": ("segment/import/import_scan.cpp", '#include "segment/search/search.h"', "comes after"),
    "a sub-module without a place": ("segment/more/more.h", '#include "segment/cut/cut.h"', "has no place"),
    "cell sees job": ("cam/cell/cell.cpp", '#include "cam/job/job.h"', "cam/job comes after cam/cell"),
    "devices sees the job file": ("devices/wire/codec.cpp", '#include "cam/job/job.h"', "sees only a part of cam"),
    "devices sees the cell file": ("devices/hand_off/dispatch.cpp", '#include "cam/cell/cell.h"', "sees only a part of cam"),
    "devices sees geometry": ("devices/wire/codec.h", '#include "segment/mesh/connectivity/shells.h"', "sees only a part of segment"),
    "devices sees sim": ("devices/hand_off/dispatch.cpp", '#include "sim/cell/machine.h"', "sim comes after devices"),
    "sim sees the hand-off": ("sim/cell/machine.cpp", '#include "devices/hand_off/hand_off.h"', "sees only a part of devices"),
    "sim sees dispatch": ("sim/cell/cell_sim.h", '#include "devices/hand_off/dispatch.h"', "sees only a part of devices"),
    "sim sees setup": ("sim/cell/machine.cpp", '#include "cam/setup/setup.h"', "sees only a part of cam"),
    "sim sees cut": ("sim/cell/machine.cpp", '#include "segment/cut/cut.h"', "sees only a part of segment"),
    "sim reaches CGAL": ("sim/cell/machine.h", '#include "segment/mesh/oriented_box.h"', "whose source sees CGAL"),
    "devices reaches CGAL through a header": (
        "cam/cell/material.h",
        '#include "segment/mesh/oriented_box.h"',
        'devices/wire/codec.cpp: reaches "segment/mesh/oriented_box.h"',
    ),
    "sim sees app": ("sim/cell/cell_sim.cpp", '#include "app/cli/terminal.h"', "app comes after sim"),
    "the store sees report": ("app/store/project_json.cpp", '#include "app/report/columns.h"', "app/report comes after"),
    "report sees cli": ("app/report/columns.cpp", '#include "app/cli/commands.h"', "app/cli comes after"),
    "two units see each other": (
        "segment/mesh/measure.cpp",
        '#include "segment/mesh/rays.h"',
        "in a circle: segment/mesh/measure, segment/mesh/rays",
    ),
    "CGAL in a header": ("segment/cut/cap.h", "#include <CGAL/Surface_mesh.h>", "a header must not include CGAL"),
    "CGAL in one more source": ("segment/cut/cut.cpp", "#  include <CGAL/Surface_mesh.h>", "8 files, 7 are allowed"),
    "Embree in one more source": ("segment/picture/shade.cpp", "#include <embree3/rtcore.h>", "seen by 2 files"),
    "JSON in a header": ("app/report/columns.h", "#include <nlohmann/json.hpp>", "a header must not include JSON"),
    "the option parser in a header": ("app/cli/arguments/arguments.h", "#include <CLI/CLI.hpp>", "must not include CLI11"),
    "libmodbus in sim": ("sim/cell/modbus_pdu.cpp", "#include <modbus/modbus.h>", "libmodbus is seen by 1 files"),
    "SQLite in one more source": ("devices/hand_off/dispatch.cpp", "#include <sqlite3.h>", "seen by 2 files"),
    "base sees its files": ("base/text.cpp", '#include "base/files/file.h"', "base/files comes after the root of base"),
    "access sees objectives": ("segment/access/inside.h", '#include "segment/objectives/weights.h"', "comes after"),
    "the wire sees the journal": ("devices/wire/codec.cpp", '#include "devices/journal/journal.h"', "comes after"),
    "the journal sees the hand-off": (
        "devices/journal/journal.cpp",
        '#include "devices/hand_off/seen_store.h"',
        "devices/hand_off comes after devices/journal",
    ),
    "the root of sim": ("sim/more.h", '#include "sim/cell/random.h"', "the root of sim has no place"),
    "the simulated cell sees the cell file": (
        "sim/cell/machine.cpp",
        '#include "cam/cell/cell.h"',
        "sim/cell sees only a part of cam",
    ),
    "the simulated cell sees the replay": (
        "sim/cell/machine.cpp",
        '#include "sim/replay/replay.h"',
        "sim/cell sees only a part of sim",
    ),
    "the replay sees the simulated cell": (
        "sim/replay/replay.cpp",
        '#include "sim/cell/machine.h"',
        "sim/replay sees only a part of sim",
    ),
    "the replay sees the registers": (
        "sim/replay/replay.cpp",
        '#include "devices/wire/codes.h"',
        "sim/replay sees only a part of devices",
    ),
    "the replay sees a reader of meshes": (
        "sim/replay/replay.cpp",
        '#include "segment/io/read_mesh.h"',
        "sim/replay sees only a part of segment",
    ),
    "the reader of programs sees the cell file": (
        "sim/program/krl_line.cpp",
        '#include "cam/cell/cell.h"',
        "sim/program sees only a part of cam",
    ),
    "dispatch sees cli": ("app/dispatch/dispatch_jobs.cpp", '#include "app/cli/exit_code.h"', "app/cli comes after"),
    "two folders see each other": (
        "sim/program/krl_line.cpp",
        '#include "sim/replay/turn.h"',
        "these folders include each other in a circle: sim/program, sim/replay",
    ),
    "libhpdf in one more source": ("cam/job/sheet/preview.cpp", "#include <hpdf.h>", "libhpdf is seen by 2 files"),
    "a path from elsewhere": ("segment/cut/cut.cpp", '#include "../mesh/shells.h"', "written from the root"),
    "a module in angle brackets": ("sim/cell/machine.cpp", "#include <devices/hand_off/hand_off.h>", "write it in quotes"),
}

class Includes(unittest.TestCase):
    def test_modules_include_only_what_comes_before_them(self):
        self.assertEqual(faults(ROOT), [])

    def test_every_module_was_looked_at(self):
        seen = {name.split("/")[0] for name in Tree(ROOT).files}
        self.assertEqual(seen, set(MODULES))

    def test_a_planted_fault_is_found(self):
        tree = Tree(ROOT)
        already = set(faults_in(tree))  # the first test tells of these
        for what, (name, line, words) in PLANTED.items():
            with self.subTest(what):
                before = tree.files.get(name)
                tree.files[name] = [*(before or []), *includes(line)]
                found = set(faults_in(tree)) - already
                self.assertTrue(any(words in fault for fault in found), f"{words!r} not in {found}")
                if before is None:
                    del tree.files[name]
                else:
                    tree.files[name] = before

    def test_folders_of_one_sub_module_that_see_each_other_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder) / "segment" / "repair"
            for inner, other in (("holes", "wedges"), ("wedges", "holes"), ("weld", "holes")):
                (root / inner).mkdir(parents=True)
                (root / inner / "a.h").touch()
                (root / inner / "b.h").write_text(f'#include "segment/repair/{other}/a.h"\n', encoding="utf-8")
            words = "these folders include each other in a circle: segment/repair/holes, segment/repair/wedges"
            self.assertEqual(faults(folder), [words])


if __name__ == "__main__":
    unittest.main()
