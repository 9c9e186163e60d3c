"""The rule of the house: a file includes its own room and the rooms before it, in the order in which the data walk.

    segment -> cam -> devices -> sim -> cli

faults(root) lists what breaks it, one line each, in the tree at `root`. The tables below are the rule; README.md and
docs/walk.md tell it in words.
"""

import re
from pathlib import Path

ROOMS = ["segment", "cam", "devices", "sim", "cli"]

# Inside these rooms the sub-rooms stand in a row as well.
SUB_ROOMS = {
    "segment": ["files", "mesh", "sample", "repair", "intake", "cut", "simplify", "picture", "score", "search"],
    "cam": ["cell", "setup", "job", "export"],
}

# Headers beside the sub-rooms that every file of the house may include, and that include nothing of the house.
ROOT_HEADERS = {"segment/error.h", "segment/context.h", "segment/parallel.h"}

# Values without any geometry to be computed.
MESH_VALUES = {"segment/mesh/vec3.h", "segment/mesh/triangle_mesh.h", "segment/mesh/measure.h"}

# What a room may see of the rooms before it, where that is less than everything. A name that ends in / is a folder.
VIEW = {
    "devices": {"segment/files/", "cam/job/ticket.h"} | MESH_VALUES,
    "sim": {"segment/files/", "segment/mesh/", "segment/intake/", "cam/cell/"}
    | {f"devices/{name}.h" for name in ("registers", "codec", "bus", "words", "packml")},
}

# Rooms in which no included header may belong to a source that sees CGAL.
FREE_OF_CGAL = ["devices", "sim"]

# Heavy headers: seen by sources only, and by no more of them than this.
HEAVY = {
    "CGAL": (r"CGAL/", 7),
    "OpenMesh": (r"OpenMesh/", 2),
    "Embree": (r"embree3/", 1),
    "tinygltf": (r"(.*/)?tiny_gltf\.h$", 2),
    "TBB": (r"tbb/", 1),
    "libmodbus": (r"(modbus/)?modbus(-.*)?\.h$", 0),  # only the tests use it, as a client that is not ours
    "toml++": (r"toml\+\+/", 2),
    "JSON": (r"nlohmann/(?!json_fwd\.hpp)", 16),
    "CLI11": (r"CLI/", 1),
    "libzip": (r"zip\.h$", 3),
    "expat": (r"expat\.h$", 1),
    "libpng": (r"png\.h$", 1),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(path):
    """Every (line number, how, name) that a file includes."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def room_of(name):
    return name.split("/")[0]


def sub_room_of(name):
    parts = name.split("/")
    return parts[1] if len(parts) > 2 else None


def is_seen(name, view):
    return any(name.startswith(entry) if entry.endswith("/") else name == entry for entry in view)


def why_not(source, target):
    """Why the file `source` must not include the header `target`, or nothing."""
    room, other = room_of(source), room_of(target)
    if source in ROOT_HEADERS:
        return "every file may include this header, so it stands alone"
    if target in ROOT_HEADERS:
        return None
    if ROOMS.index(other) > ROOMS.index(room):
        return f"{other} comes after {room}"
    if other != room:
        if room in VIEW and not is_seen(target, VIEW[room]):
            return f"{room} sees only a part of {other}, and this is not in it"
        return None
    order = SUB_ROOMS.get(room)
    if order is None:
        return None
    here, there = sub_room_of(source), sub_room_of(target)
    for sub in (here, there):
        if sub not in order:
            return f"{sub or 'the root'} has no place in the order of the sub-rooms of {room}"
    if order.index(there) > order.index(here):
        return f"{room}/{there} comes after {room}/{here}"
    return None


class Tree:
    def __init__(self, root):
        self.root = Path(root)
        self.files = {}
        for room in ROOMS:
            for path in sorted((self.root / room).rglob("*")):
                if path.suffix in (".h", ".cpp"):
                    self.files[path.relative_to(self.root).as_posix()] = list(includes(path))

    def sees_cgal(self, name):
        return any(re.match(HEAVY["CGAL"][0], target) for _, _, target in self.files.get(name, []))

    def reached_from(self, name):
        """Every header of the house that a file includes, itself or through others."""
        reached, to_do = set(), [name]
        while to_do:
            for _, how, target in self.files.get(to_do.pop(), []):
                if how == '"' and target not in reached:
                    reached.add(target)
                    to_do.append(target)
        return sorted(reached)


def direction_faults(tree):
    for name, lines in tree.files.items():
        for number, how, target in lines:
            at = f"{name}:{number}: "
            if how == "<":
                if room_of(target) in ROOMS and "/" in target:
                    yield f"{at}<{target}> is of the house: write it in quotes"
                continue
            if target not in tree.files:
                yield f'{at}"{target}" is not in any room (includes are written from the root)'
                continue
            why = why_not(name, target)
            if why:
                yield f'{at}must not include "{target}": {why}'


def reach_faults(tree):
    """What a room with a narrow view must not get through the headers of others either."""
    for name in tree.files:
        if room_of(name) not in FREE_OF_CGAL:
            continue
        for target in tree.reached_from(name):
            if tree.sees_cgal(target) or tree.sees_cgal(target.removesuffix(".h") + ".cpp"):
                yield f'{name}: reaches "{target}", whose source sees CGAL'


def heavy_faults(tree):
    for library, (pattern, most) in HEAVY.items():
        users = []
        for name, lines in tree.files.items():
            hits = [number for number, _, target in lines if re.match(pattern, target)]
            if not hits:
                continue
            users.append(name)
            if name.endswith(".h"):
                yield f"{name}:{hits[0]}: a header must not include {library}: whoever includes it would pay for it"
        if len(users) > most:
            yield f"{library} is seen by {len(users)} files, {most} are allowed: {', '.join(users)}"


def faults(root):
    tree = Tree(root)
    return [*direction_faults(tree), *reach_faults(tree), *heavy_faults(tree)]
