"""The page of the console is what its sources give: dist/SOURCES.sha256 has the hash of every source and every output.

faults(page) compares them with the files in the folder `page` (app/console/page), without node. Whether the outputs are
those of the sources, byte for byte, is checked by `scripts/console check`.
"""

import hashlib
from pathlib import Path

LIST = "dist/SOURCES.sha256"
UNLISTED = ("README.md", "SOURCES.sha256")


def listed(page):
    """Name to hash, as the list has them."""
    lines = (page / LIST).read_text(encoding="utf-8").splitlines()
    return {name: digest for digest, name in (line.split("  ", 1) for line in lines)}


def present(page):
    """Name to hash, as the files are."""
    return {
        path.relative_to(page).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(page.rglob("*"))
        if path.is_file() and path.name not in UNLISTED
    }


def faults(page):
    page = Path(page)
    if not (page / LIST).is_file():
        return [f"{LIST} is missing"]
    said, there = listed(page), present(page)
    return (
        [f"{name} is not in {LIST}" for name in sorted(there.keys() - said.keys())]
        + [f"{name} is in {LIST} and not there" for name in sorted(said.keys() - there.keys())]
        + [f"{name} has changed" for name in sorted(said.keys() & there.keys()) if said[name] != there[name]]
    )
