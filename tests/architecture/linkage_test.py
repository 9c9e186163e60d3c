"""A free function that no other object needs is internal to its source, or gone.

nm lists what every object of the build defines and needs; tests count as others, those of tests/reference do not: what
only a slow reference needs has a line in FOR_REFERENCES. Skipped where not everything is built, or not as it stands.
known/linkage.txt holds the functions that are neither internal nor gone yet.

    linkage_test.py [BUILD]      of that build; build/release otherwise
"""

import re
import subprocess
import sys
import tempfile
import unittest
from collections import Counter, defaultdict
from pathlib import Path

from includes import MODULES
from ratchet import ROOT, known_faults

BUILD = ROOT / "build" / "release"
NOT_IN_ALL = ("bench/", "tests/fuzz/")  # folders that a build of everything leaves out, at least in part
OBJECT = re.compile(r"^build ([^\s:]+\.o): \w*CXX_COMPILER\w* (\S+)", re.MULTILINE)

# Functions that nothing but a slow reference of tests/reference needs, and why they stand in the modules.
FOR_REFERENCES = {}


def objects(build, root):
    """The objects of the modules and tests by source, as ninja knows them; nothing if one is missing or too old."""
    if not (build / "build.ninja").exists():
        return None
    made = {}
    for name, source in OBJECT.findall((build / "build.ninja").read_text(encoding="utf-8")):
        path, source = build / name, Path(source)
        if not source.is_relative_to(root) or source.is_relative_to(build) or name.startswith(NOT_IN_ALL):
            continue
        if not path.exists() or path.stat().st_mtime < source.stat().st_mtime:
            return None
        made[path] = source.relative_to(root).as_posix()
    return made


def symbols(made):
    """(what is defined where, what is needed where), from one call of nm over all objects."""
    text = subprocess.run(["nm", "-A", "-g", "-P", *made], capture_output=True, text=True, check=True).stdout
    defined, needed = defaultdict(set), defaultdict(set)
    for line in text.splitlines():
        path, _, symbol = line.partition(": ")
        name, kind = symbol.split(" ")[:2]
        if kind == "T":
            defined[name].add(made[Path(path)])
        elif kind == "U":
            needed[name].add(made[Path(path)])
    return defined, needed


def free_function(demangled):
    """The name of a free function of the project, with its namespaces; nothing for what a class has."""
    name = re.sub(r"\[abi:\w+\]", "", demangled).partition("(")[0]
    parts = name.split("::")
    if parts[0] != "qchopper" or len(parts) < 2 or not all(re.match(r"[a-z]", part) for part in parts):
        return None
    return "::".join(parts[1:])


def needed_by_no_other(made):
    defined, needed = symbols(made)
    ours = [
        (name, source)
        for name, places in defined.items()
        for source in places
        if source.split("/")[0] in MODULES and not any(not user.startswith("tests/reference/") for user in needed[name])
    ]
    demangled = subprocess.run(
        ["c++filt"], input="\n".join(name for name, _ in ours), capture_output=True, text=True, check=True
    ).stdout.split("\n")
    result = Counter()
    for (_, source), text in zip(ours, demangled):
        if (function := free_function(text)) and function not in FOR_REFERENCES:
            result[f"{source} {function}"] += 1
    return result


def found():
    made = objects(BUILD, ROOT)
    return None if made is None else needed_by_no_other(made)


# Sources of a small build, by path.
SMALL = {
    "base/a.cpp": "namespace qchopper { int used() { return 1; } int alone() { return 2; } int of_a_reference() { return 3; }"
    " namespace { [[gnu::noinline]] int inside() { return 4; } } struct Type { int member(); };"
    " int Type::member() { return inside(); } }",
    "cam/b.cpp": "namespace qchopper { int used(); int user() { return used(); } }",
    "tests/b_test.cpp": "namespace qchopper { int user(); } int main() { return qchopper::user(); }",
    "tests/reference/r.cpp": "namespace qchopper { int of_a_reference(); int r() { return of_a_reference(); } }",
}


class Linkage(unittest.TestCase):
    def test_every_free_function_with_external_linkage_is_needed_by_another_object(self):
        functions = found()
        if functions is None:
            self.skipTest("skipped: not every object of the build is there and newer than its source")
        self.assertGreater(len(objects(BUILD, ROOT)), 500)
        self.assertEqual(known_faults("linkage", functions), [])

    def test_planted_functions_are_found_and_no_other_ones(self):
        with tempfile.TemporaryDirectory() as folder:
            made = {}
            for name, text in SMALL.items():
                path = Path(folder) / (name.replace("/", "_") + ".o")
                subprocess.run(["g++", "-x", "c++", "-c", "-", "-o", path], input=text, text=True, check=True)
                made[path] = name
            self.assertEqual(
                needed_by_no_other(made), Counter({"base/a.cpp alone": 1, "base/a.cpp of_a_reference": 1})
            )

    def test_an_object_that_is_missing_or_older_than_its_source_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            build = root / "build"
            build.mkdir()
            self.assertIsNone(objects(build, root))
            (root / "a.cpp").touch()
            rule = f"build CMakeFiles/x.dir/a.cpp.o: CXX_COMPILER__x_unscanned_Release {root}/a.cpp || y\n"
            (build / "build.ninja").write_text(rule, encoding="utf-8")
            self.assertIsNone(objects(build, root))
            made = build / "CMakeFiles/x.dir/a.cpp.o"
            made.parent.mkdir(parents=True)
            made.touch()
            self.assertEqual(objects(build, root), {made: "a.cpp"})

    def test_what_belongs_to_a_class_is_no_free_function(self):
        self.assertEqual(free_function("qchopper::to_text[abi:cxx11](qchopper::Cell const&)"), "to_text")
        self.assertEqual(free_function("qchopper::hand_off::next(int)"), "hand_off::next")
        for name in ("qchopper::Cell::read(int)", "qchopper::Cell::Cell()", "other::name(int)", "main"):
            self.assertIsNone(free_function(name), name)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        BUILD = Path(sys.argv.pop(1)).resolve()
    unittest.main()
