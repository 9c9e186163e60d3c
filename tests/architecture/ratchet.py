#!/usr/bin/env python3
"""A rule that the code base does not meet everywhere yet: what breaks it is listed, and the list only shrinks.

A rule finds a Counter, entry -> how often. known/NAME.txt holds a line for each entry that is known, with its count
where that is not 1. faults() tells of what is not listed, and of what is listed and is no violation any more.

    python3 tests/architecture/ratchet.py      takes out of all lists what is no violation any more; adds nothing
"""

import importlib
import sys
from collections import Counter
from pathlib import Path

from includes import MODULES

ROOT = Path(__file__).resolve().parents[2]
KNOWN = Path(__file__).resolve().parent / "known"
# The tests that have a list each, known/NAME.txt for NAME_test.py with a function found().
RULES = ["heads", "headers", "keys", "linkage", "together"]


def sources(root, suffixes=(".h", ".cpp"), folders=tuple(MODULES)):
    """The text of every source below `folders`, by its path from the root."""
    return {
        path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
        for folder in folders
        for path in sorted((Path(root) / folder).rglob("*"))
        if path.suffix in suffixes
    }


def parse(text):
    """The entries of a list: ENTRY or ENTRY xCOUNT; a line that begins with # is for people."""
    known = Counter()
    for line in text.splitlines():
        entry, _, count = line.partition(" x")
        if entry and not line.startswith("#"):
            known[entry] = int(count or 1)
    return known


def written(known):
    return "".join(f"{entry} x{count}\n" if count > 1 else f"{entry}\n" for entry, count in sorted(known.items()))


def faults(known, found):
    """Every difference between what is listed and what is found, one line each."""
    for entry in sorted(known.keys() | found.keys()):
        if found[entry] > known[entry]:
            yield f"{entry}: found {found[entry]} times, {known[entry]} are known"
        elif found[entry] < known[entry]:
            yield f"{entry}: found {found[entry]} times, {known[entry]} are listed: run tests/architecture/ratchet.py"


def known_faults(name, found):
    return list(faults(parse((KNOWN / f"{name}.txt").read_text(encoding="utf-8")), found))


def shrink(path, found):
    """Leaves of a list what is found."""
    text = path.read_text(encoding="utf-8")
    head = "".join(line for line in text.splitlines(keepends=True) if line.startswith("#"))
    path.write_text(head + written(parse(text) & found), encoding="utf-8")


def main():
    for name in RULES:
        found = importlib.import_module(f"{name}_test").found()
        if found is None:
            print(f"{name}: not found out, because not everything is built", file=sys.stderr)
        else:
            shrink(KNOWN / f"{name}.txt", found)


if __name__ == "__main__":
    main()
