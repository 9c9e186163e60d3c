"""The glossary's rule: some words have a standard term in this project and must not come back (docs/developer/glossary.md).

faults(root) lists every place where one of them stands: in identifiers as whole parts (crumb in `crumb_volume_mm3` and
in `CrumbList`), in help, messages and comments as whole words, and in the documents.
"""

import re
from pathlib import Path

# The word, as parts of an identifier in a row, and the term to use.
REFUSED = {
    "crumb": "fragment",
    "crumbs": "fragments",
    "straight_way": "parallel rays",
    "straight_ways": "parallel rays",
    "tether": "cavity link",
    "tethers": "cavity links",
    "straddler": "crossed triangle",
    "straddlers": "crossed triangles",
    "price": "evaluation",
    "prices": "evaluations",
    "priced": "evaluated",
    "pricing": "evaluation",
    "price_book": "evaluation cache",
    "piece_book": "evaluation cache",
    "oracle": "reference",
    "hopeless": "unrepairable",
    "take_in": "import",
    "intake": "import",
    "our_fault": "internal error",
    "pinched": "non-manifold",
    "faulty": "non-manifold",
    "deep_point": "interior_point",
    "the_house": "the project",
    "the_walk": "the data flow",
    "sub_room": "sub-module",
    "shadow_mm2": "projected_area_mm2",
    "turn_under_way": "StepContext",
    "dent": "groove",
    "dents": "grooves",
    "smooth_marks": "smooth_pen_grooves",
    "draw_marks": "draw_pen_grooves",
    "loose_sheet": "open component",
    "size_in_words": "describe_size",
    "volume_in_words": "describe_volume",
    "standing_cuts": "committed_cuts",
    "whoever": "the user, the caller, the client",
    "foam_map": "dexel map, stock height field",
    "foam_tile": "dexel tile",
    "foam_interval": "dexel",
    "foam_columns": "dexel columns",
    "carve_foam": "mill_stock",
    "carved_stock": "stock record",
    "carving_tool": "cutting tool",
    "carving_block": "stock block",
    "carving_space": "milling space",
    "carving_pose": "milling pose",
    "carving_poses": "milling poses",
    "carvable": "machinable",
    "arm_branch": "arm configuration",
    "region_hold": "arm posture",
    "hold_search": "posture search",
    "hold_drilling": "reachable holes",
    "drill_direction": "drill orientation",
    "scene_direction": "scene orientation",
    "joint_way": "approach, retract, PTP path",
    "joint_ways": "approach, retract, PTP paths",
    "section_end": "end of an operation",
    "tip_surface": "CL surface",
    "tip_surfaces": "CL surfaces",
    "tip_view": "view of a CL surface",
    "target_map": "piece height field",
    "target_maps": "piece height fields",
    "middles_around": "bilinear cell",
    "disc_max": "dilation by a disc",
    "holder_limit": "holder clearance height",
    "holder_limits": "holder clearance heights",
    "level_lines": "waterlines",
    "level_passes": "waterline passes",
    "surface_reach": "surface access",
    "reach_sweep": "access sweep",
    "dense_reach": "dense access",
    "cut_reach": "access after a cut",
    "reach_rank": "access rank",
    "envelope_cure": "remedy",
    "envelope_margin": "reachability margin",
    "envelope_pose": "reachability pose",
    "cut_verdict": "review of a cut",
    "setup_verdict": "review by setups",
    "start_verdict": "start outcome",
    "handover": "dispatch, hand-off",
    "beat": "heartbeat",
}

FOLDERS = ["base", "segment", "cam", "devices", "sim", "app", "tests", "bench", "docs", "scripts"]
SUFFIXES = {".h", ".cpp", ".py", ".md", ".txt", ""}
# Where the words stand because they are listed, or because of what was.
EXEMPT = {
    "docs/developer/glossary.md",
    "tests/architecture/words.py",
    "tests/architecture/words_test.py",
}

# Older names of options that are still taken, for one version.
ALIASES = {"app/cli/arguments/project_options.cpp": {"crumbs", "smooth_marks"}}

WORD = re.compile(r"[A-Za-z]+")
CAMEL = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def parts_of(line):
    """The parts of identifiers and the words of a line, in lower case, as one text between underscores."""
    words = (part.lower() for word in WORD.findall(line) for part in CAMEL.findall(word))
    return "_" + "_".join(words) + "_"


def refused_in(line):
    parts = parts_of(line)
    return [word for word in REFUSED if f"_{word}_" in parts]


def files(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.is_file() and path.suffix in SUFFIXES and "/corpus/" not in name and name not in EXEMPT:
                yield name, path
    for name in ("README.md", "CMakeLists.txt"):
        yield name, root / name


def faults(root):
    root = Path(root)
    for name, path in files(root):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for word in set(refused_in(line)) - ALIASES.get(name, set()):
                yield f"{name}:{number}: \"{word.replace('_', ' ')}\": the term is {REFUSED[word]} (docs/developer/glossary.md)"
