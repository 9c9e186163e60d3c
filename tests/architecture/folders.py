"""A folder can be taken in at a glance: at most 40 files, and a README of about ten lines.

The README says what the folder is, names its entry header, and then its landmarks, one line each: from three (or all
headers and sources of TypeScript, where there are fewer) to six files, and every folder in it. Whatever it names between `` and looks like a
file or folder is there. faults(root) lists every violation in the tree at `root`.
"""

import re
from pathlib import Path

from includes import MODULES

MOST_FILES = 40
MOST_LINES = 24  # folders that hold many folders included
LEAST_LANDMARKS, MOST_LANDMARKS = 3, 6

ENTRY = re.compile(r"^Entry: `([\w/]+\.(?:h|cpp|tsx?|html)|[\w/]+/)`")
LANDMARK = re.compile(r"^- `([\w/.]+)`: \S")
NAMED = re.compile(r"`([\w/.-]+(?:\.(?:h|cpp|tsx?|html|mjs|css|md|txt|py|toml)|/))`")


def folders(root):
    for module in MODULES:
        path = Path(root) / module
        if path.is_dir():
            yield from sorted([path, *(folder for folder in path.rglob("*") if folder.is_dir())])


def readme_faults(folder, root):
    readme = folder / "README.md"
    if not readme.is_file():
        yield "has no README.md"
        return
    text = readme.read_text(encoding="utf-8")
    lines = text.splitlines()
    if not lines or lines[0] != f"# {folder.relative_to(root).as_posix()}":
        yield "its README does not begin with the name of the folder"
    if len(lines) > MOST_LINES:
        yield f"its README has {len(lines)} lines, {MOST_LINES} are allowed"
    if len([line for line in lines if ENTRY.match(line)]) != 1:
        yield "its README names no entry, or more than one: Entry: `name.h`"
    for name in NAMED.findall(text):
        if not (folder / name).exists() and not (Path(root) / name).exists():
            yield f"its README names {name}, which is not there"
    marks = [match.group(1) for line in lines if (match := LANDMARK.match(line))]
    files = [mark for mark in marks if not mark.endswith("/")]
    inner = {f"{path.name}/" for path in folder.iterdir() if path.is_dir()}
    for name in sorted(inner - set(marks)):
        yield f"its README has no line for {name}"
    least = min(LEAST_LANDMARKS, len([path for path in folder.iterdir() if path.suffix in (".h", ".ts", ".tsx")]))
    if not least <= len(files) <= MOST_LANDMARKS:
        yield f"its README has {len(files)} files as landmarks, {least} to {MOST_LANDMARKS} are asked for"


def faults(root):
    for folder in folders(root):
        name = folder.relative_to(root).as_posix()
        count = len([path for path in folder.iterdir() if path.is_file()])
        if count > MOST_FILES:
            yield f"{name}: holds {count} files, {MOST_FILES} are allowed"
        for fault in readme_faults(folder, root):
            yield f"{name}: {fault}"
