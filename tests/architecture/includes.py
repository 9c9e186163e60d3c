"""The dependency rule: a file includes its own module and the modules before it, in the order of data flow.

    base -> segment -> cam -> devices -> sim -> app

The sub-modules of a module stand in an order of their own. Folders that stand in the same folder do not include each
other in a circle at any depth; a folder below a sub-module is a part of it. A compilation unit is a header together with the source of the same name; units do not include each other in a circle.
faults(root) lists every violation, one line each, in the tree at `root`. The tables below are the rule; README.md and
docs/developer/architecture.md describe it.
"""

import functools
import re
from pathlib import Path

MODULES = ["base", "segment", "cam", "devices", "sim", "app"]

# Inside these modules the sub-modules are ordered as well. "" is the root of the module.
SUB_MODULES = {
    "base": ["", "files"],
    "segment": [
        "mesh",
        "raster",
        "io",
        "repair",
        "import",
        "structure",
        "cut",
        "simplify",
        "sample",
        "fuse",
        "picture",
        "access",
        "objectives",
        "regions",
        "search",
        "joint",
    ],
    "cam": ["cell", "setup", "stock", "toolpath", "program", "post", "job", "export"],
    "devices": ["wire", "keys", "journal", "hand_off", "link_check"],
    "sim": ["cell", "program", "replay"],
    "app": ["store", "pictures", "jobs", "display", "engine", "guide", "dispatch", "report", "console", "cli"],
}

# What a module or sub-module may include beside itself, where that is less than everything before it. A name that ends
# in / is a folder. The two halves of sim do not see each other: what runs jobs, and what proves programs.
VIEW = {
    "devices": {"base/", "cam/job/ticket.h"},
    "sim/cell": {"base/", "devices/wire/"},
    "sim/program": {"base/"},
    "sim/replay": {"base/", "cam/cell/", "segment/mesh/", "sim/program/"},
}

# Modules in which no included header may belong to a source that includes CGAL.
FREE_OF_CGAL = ["devices", "sim"]

# Heavy headers: included by sources only, and by no more of them than this.
HEAVY = {
    "CGAL": (r"CGAL/", 7),
    "OpenMesh": (r"OpenMesh/", 2),
    "Eigen": (r"Eigen/", 6),
    "Embree": (r"embree3/", 1),
    "tinygltf": (r"(.*/)?tiny_gltf\.h$", 2),
    "TBB": (r"tbb/", 1),
    "libmodbus": (r"(modbus/)?modbus(-.*)?\.h$", 0),  # only the tests use it, as a client that is not ours
    "toml++": (r"toml\+\+/", 1),
    "JSON": (r"nlohmann/(?!json_fwd\.hpp)", 32),
    "Boost.Graph": (r"boost/graph/", 1),
    "Beast": (r"boost/(beast|asio)/", 1),
    "CLI11": (r"CLI/", 2),
    "libzip": (r"zip\.h$", 2),
    "OpenSSL": (r"openssl/", 3),
    "SQLite": (r"sqlite3(ext)?\.h$", 1),
    "expat": (r"expat\.h$", 1),
    "libpng": (r"png\.h$", 1),
    "libhersheyfont": (r"hersheyfont\.h$", 1),
    "libhpdf": (r"hpdf\.h$", 1),
}

@functools.cache
def heavy(name):
    """The libraries of HEAVY to which an included header belongs."""
    return {library for library, (pattern, _) in HEAVY.items() if re.match(pattern, name)}


INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(text):
    """Every (line number, quote or bracket, name) that the text of a file includes."""
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def module_of(name):
    return name.split("/")[0]


def sub_module_of(name):
    parts = name.split("/")
    return parts[1] if len(parts) > 2 else ""


def named(module, sub):
    return f"{module}/{sub}" if sub else f"the root of {module}"


def unit_of(name):
    return name.rpartition(".")[0]


def is_seen(name, view):
    return any(name.startswith(entry) if entry.endswith("/") else name == entry for entry in view)


@functools.cache
def why_not(source, target):
    """Why the file `source` must not include the header `target`, or nothing."""
    module, other = module_of(source), module_of(target)
    if MODULES.index(other) > MODULES.index(module):
        return f"{other} comes after {module}"
    for folder, view in VIEW.items():
        if source.startswith(folder + "/") and not target.startswith(folder + "/") and not is_seen(target, view):
            return f"{folder} sees only a part of {other}, and this is not in it"
    if other != module:
        return None
    order = SUB_MODULES.get(module)
    if order is None:
        return None
    here, there = sub_module_of(source), sub_module_of(target)
    for sub in (here, there):
        if sub not in order:
            return f"{named(module, sub)} has no place in the order of the sub-modules of {module}"
    if order.index(there) > order.index(here):
        return f"{named(module, there)} comes after {named(module, here)}"
    return None


class Tree:
    def __init__(self, root):
        self.root = Path(root)
        self.files = {}
        for module in MODULES:
            for path in sorted((self.root / module).rglob("*")):
                if path.suffix in (".h", ".cpp"):
                    self.files[path.relative_to(self.root).as_posix()] = list(includes(path.read_text(encoding="utf-8")))

    def sees_cgal(self, name):
        return any("CGAL" in heavy(target) for _, _, target in self.files.get(name, []))

    def reached_from(self, name):
        """Every header of the project that a file includes, itself or through others."""
        reached, to_do = set(), [name]
        while to_do:
            for _, how, target in self.files.get(to_do.pop(), []):
                if how == '"' and target not in reached:
                    reached.add(target)
                    to_do.append(target)
        return sorted(reached)

    def units(self):
        """Per compilation unit the other units that it includes."""
        result = {}
        for name, lines in self.files.items():
            seen = result.setdefault(unit_of(name), set())
            seen |= {unit_of(target) for _, how, target in lines if how == '"'} - {unit_of(name)}
        return result

    def folders(self):
        """Per folder the folders that stand in the same folder and of which it includes something."""
        result = {}
        for name, lines in self.files.items():
            here = name.split("/")[:-1]
            for _, how, target in lines:
                there = target.split("/")[:-1]
                depth = next((i for i, (a, b) in enumerate(zip(here, there)) if a != b), None)
                if how == '"' and depth is not None:
                    result.setdefault("/".join(here[: depth + 1]), set()).add("/".join(there[: depth + 1]))
        return result


def direction_faults(tree):
    for name, lines in tree.files.items():
        for number, how, target in lines:
            at = f"{name}:{number}: "
            if how == "<":
                if module_of(target) in MODULES and "/" in target:
                    yield f"{at}<{target}> is of this project: write it in quotes"
                continue
            if target not in tree.files:
                yield f'{at}"{target}" is not in any module (includes are written from the root)'
                continue
            why = why_not(name, target)
            if why:
                yield f'{at}must not include "{target}": {why}'


def circles(graph):
    """The strongly connected components of more than one unit (R. Tarjan, Depth-first search and linear graph
    algorithms, SIAM J. Comput. 1, 1972), each as a sorted list."""
    index, low, stack, on_stack, result = {}, {}, [], set(), []

    def visit(unit):
        index[unit] = low[unit] = len(index)
        stack.append(unit)
        on_stack.add(unit)
        for other in sorted(graph.get(unit, ())):
            if other not in index:
                visit(other)
                low[unit] = min(low[unit], low[other])
            elif other in on_stack:
                low[unit] = min(low[unit], index[other])
        if low[unit] == index[unit]:
            component = []
            while not component or component[-1] != unit:
                component.append(stack.pop())
                on_stack.discard(component[-1])
            if len(component) > 1:
                result.append(sorted(component))

    for unit in sorted(graph):
        if unit not in index:
            visit(unit)
    return sorted(result)


def circle_faults(tree):
    for circle in circles(tree.units()):
        yield f"these units include each other in a circle: {', '.join(circle)}"
    for circle in circles(tree.folders()):
        yield f"these folders include each other in a circle: {', '.join(circle)}"


def reach_faults(tree):
    """What a module with a narrow view must not get through the headers of others either."""
    for name in tree.files:
        if module_of(name) not in FREE_OF_CGAL:
            continue
        for target in tree.reached_from(name):
            if tree.sees_cgal(target) or tree.sees_cgal(target.removesuffix(".h") + ".cpp"):
                yield f'{name}: reaches "{target}", whose source sees CGAL'


def heavy_faults(tree):
    users = {library: {} for library in HEAVY}  # each with its first line
    for name, lines in tree.files.items():
        for number, _, target in lines:
            for library in heavy(target):
                users[library].setdefault(name, number)
    for library, (_, most) in HEAVY.items():
        for name, number in users[library].items():
            if name.endswith(".h"):
                yield f"{name}:{number}: a header must not include {library}: every file that includes the header would compile it too"
        if len(users[library]) > most:
            yield f"{library} is seen by {len(users[library])} files, {most} are allowed: {', '.join(users[library])}"


def faults_in(tree):
    return [*direction_faults(tree), *circle_faults(tree), *reach_faults(tree), *heavy_faults(tree)]


def faults(root):
    return faults_in(Tree(root))
