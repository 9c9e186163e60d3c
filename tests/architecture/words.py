"""The glossary's rule: some words have a standard term in this project and must not come back (docs/developer/glossary.md).

faults(root) lists every place where one of them stands: in identifiers as whole parts (crumb in `crumb_volume_mm3` and
in `CrumbList`), in help, messages and comments as whole words, and in the documents. Every word of the last column of the glossary is in REFUSED, or in OTHER_USES with its reason.
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
    "shadow_mm": "projected_area_mm2",
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
    "law": "rule, invariant",
    "laws": "rules, invariants",
    "provenance": "origin of a value",
    "rooms": "modules",
    "hidden_share": "occluded area ratio",
    "lone_corner": "apex",
    "level_pass": "waterline pass",
    "cure": "remedy",
    "cures": "remedies",
    "residue": "rest material",
    "weld_borders": "snap_borders",
    "border_weld": "snap_borders",
}

# Words of the last column of the glossary that stay allowed alone, because they have another use.
OTHER_USES = {
    "carries": "whatever carries something",
    "node": "of a tree, a graph, a grid",
    "part": "k of n of a job",
    "bound": "of a search",
    "side of a path": "of a file name",
    "nest": "nest_polygons",
    "ears": "of ear clipping",
    "wrap": "alpha wrap, lines of a text",
    "patch": "of colour, the patch test",
    "mark": "of a row, of a place",
    "farthest": "the largest of several distances",
    "masked": "of a mask",
    "words()": "text",
    "verdict": "the file of a job",
    "products": "of numbers",
    "envelope in names": "the file, and what people read",
    "shadow": "of a compiler's warning",
    "room": "space",
    "walk": "of a data structure",
    "carve in names": "texts, and options that are frozen",
    "machine as a verb": "the noun",
    "foam for a model": "the material",
    "out": "outwards",
    "direction alone": "of a ray",
    "branch": "of a tree; a kind of finding of verdicts",
    "way": "of doing something",
    "hold": "what holds",
    "configuration alone": "arm configuration",
    "tool turn": "a key of envelope.json",
    "setup direction": "a direction after a setup, as arguments",
    "no hold carries": "the name of a test",
    "reach alone": "a key of the cell file and of jobs",
    "reach": "a key of the cell file and of jobs",
    "raise": "of a map, of an exception",
    "section": "of a document, through a solid",
    "run for a pass": "passes and links between two retracts",
    "run builder": "a run, and what a builder makes",
    "middle": "of a box",
    "grown": "of a box",
    "step": "of a procedure",
    "left over": "what is over",
    "envelope": "the file, and what people read",
    "held": "what is held",
    "least_": "at least",
    "most_": "at most",
    "verdict for a cut or a start": "the file of a job",
    "hand-over": "made by hand over a block",
    "words": "text",
}

FOLDERS = ["base", "segment", "cam", "devices", "sim", "app", "tests", "bench", "docs", "scripts"]
SUFFIXES = {".h", ".cpp", ".py", ".md", ".txt", ""}
# Where the words stand because they are listed, or because of what was.
EXEMPT = {
    "docs/developer/glossary.md",
    "scripts/same_outputs",
    "tests/architecture/words.py",
    "tests/architecture/words_test.py",
}

# Older names of options that are still taken, for one version.
ALIASES = {
    "app/cli/arguments/project_options.cpp": {"crumbs", "smooth_marks"},
    "tests/app/cli/older_options_test.cpp": {"crumbs"},
}

WORD = re.compile(r"[A-Za-z]+")
CAMEL = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def parts_of(line):
    """The parts of identifiers and the words of a line, in lower case, as one text between underscores."""
    words = (part.lower() for word in WORD.findall(line) for part in CAMEL.findall(word))
    return "_" + "_".join(words) + "_"


def refused_in(line):
    parts = parts_of(line)
    return [word for word in REFUSED if f"_{word}_" in parts]


# Whatever refused_in() can find, and a little more: a search in a text as a whole takes a tenth of its time.
LIKELY = re.compile("|".join(word.replace("_", r"[^a-z\n]*") for word in REFUSED))


def refused_lines(text):
    """(line number, what is refused there) of a text."""
    lower, lines = text.lower(), text.split("\n")
    for number in sorted({lower.count("\n", 0, match.start()) for match in LIKELY.finditer(lower)}):
        yield number + 1, refused_in(lines[number])


def not_terms(glossary):
    """The words of the last column of the glossary's tables."""
    for line in glossary.splitlines():
        match = re.match(r"\|.*\|([^|]+)\|$", line)
        for word in re.split(r"[,;]", match.group(1)) if match else []:
            if word.strip() not in ("", "not", "---"):
                yield word.strip()


def undecided(glossary):
    """Those that are neither refused, in the singular or the plural, nor said to have another use."""
    for word in not_terms(glossary):
        parts = parts_of(word).strip("_")
        if word not in OTHER_USES and not {parts, parts + "s"} & REFUSED.keys():
            yield word


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
        for number, words in refused_lines(path.read_text(encoding="utf-8")):
            for word in set(words) - ALIASES.get(name, set()):
                yield f"{name}:{number}: \"{word.replace('_', ' ')}\": the term is {REFUSED[word]} (docs/developer/glossary.md)"
