#!/usr/bin/env python3
"""Every fault of the list in docs/developer/link-faults.md has a test of its name: TEST(Fault, F07_...), F08_F34_... for two."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COUNT = 63


def named(text):
    """The fault numbers in the names of tests in `text`."""
    found = set()
    for name in re.findall(r"TEST(?:_[FP])?\(\s*Fault,\s*((?:F\d\d_)+)", text):
        found |= {int(number) for number in re.findall(r"F(\d\d)_", name)}
    return found


def missing(root):
    have = set()
    for source in sorted((root / "tests").rglob("*_test.cpp")):
        have |= named(source.read_text(encoding="utf-8"))
    return sorted(set(range(1, COUNT + 1)) - have), sorted(have)


def main():
    assert named("TEST(Fault, F08_F34_AStart) {") == {8, 34}
    assert named("TEST(Other, F08_A) {") == set()
    lacking, _ = missing(ROOT)
    for number in lacking:
        print(f"fault {number} has no test TEST(Fault, F{number:02d}_...)")
    return 1 if lacking else 0


if __name__ == "__main__":
    sys.exit(main())
