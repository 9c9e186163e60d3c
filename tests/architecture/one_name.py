"""One name, one thing: no two types of the project share a name.

All modules share one namespace. Two types of one name in two files would compile and link, and then the destructor of
one is called for the other. In anonymous namespaces that cannot happen, but a reader would confuse the two: types there
count as well. Not counted are nested types, aliases in sources, declarations without a body, and out-of-line definitions
of what a header declares, such as `struct ThreadLimit::State` in two sources of which one is compiled. faults(root)
lists the names that are defined more than once.
"""

import re
from collections import defaultdict
from pathlib import Path

from includes import MODULES

# At the start of a line: nested types are indented, types in a namespace are not.
DEFINITION = re.compile(r"^(?:struct|class|enum class|enum|union)\s+(\w+)(?!\w|::)[^;]*$|^using\s+(\w+)\s*=")


def types_in(path):
    """Names of the types that a file defines."""
    for line in path.read_text(encoding="utf-8").splitlines():
        match = DEFINITION.match(line)
        if match and not (path.suffix == ".cpp" and match.group(2)):
            yield match.group(1) or match.group(2)


def faults(root):
    where = defaultdict(list)
    for module in MODULES:
        for path in sorted((Path(root) / module).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                for name in types_in(path):
                    where[name].append(path.relative_to(root).as_posix())
    return [f"{name} is defined in {' and in '.join(files)}" for name, files in sorted(where.items()) if len(files) > 1]
