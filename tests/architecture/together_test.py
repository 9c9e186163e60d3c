"""Who may read together what a concept is made of: a concept that is computed in one place is not computed again.

  block box   where the block lies in setup coordinates: `-spoil` and the size of the block stand in one
              function in cam/setup/setup.h only, as Setup::block_box() and milled_box()
  tool axis   a direction of the piece turned into the setup: cam/setup/setup.h only, as Setup::tool_axis()
  degrees     pi / 180 and 180 / pi: base/units.h only

known/together.txt holds, by rule and file, how many places are left.
"""

import re
import unittest
from collections import Counter

from ratchet import ROOT, known_faults, sources

COMMENT = re.compile(r"//.*$", re.MULTILINE)
TOP = re.compile(r"^\}.*$", re.MULTILINE)  # the end of a function or type

# Rule: (the files that may, patterns that no function or type elsewhere may hold together). With one pattern every
# place counts, with several every function.
RULES = {
    "block box": (
        {"cam/setup/setup.h"},
        [
            re.compile(r"(?<=[\s{(,])- ?(?!foam\.|margins\.)[\w.>-]*\bspoil\b"),
            re.compile(r"\bblock(?:\.|->)size\b|(?:\.|->)block\(\)(?:\.|->)size\b"),
        ],
    ),
    "tool axis": ({"cam/setup/setup.h"}, [re.compile(r"\brotate\([\w.>-]*piece_in_setup_?,")]),
    "degrees": (
        {"base/units.h"},
        [re.compile(r"\bpi(?:_v<double>)? / 180\b|\b180(?:\.0?)? / (?:std::numbers::)?pi\b|0\.01745|57\.29")],
    ),
}


def places(texts):
    result = Counter()
    for name, text in texts.items():
        text = COMMENT.sub("", text)
        for rule, (allowed, patterns) in RULES.items():
            if name in allowed:
                continue
            if len(patterns) == 1:
                count = len(patterns[0].findall(text))
            else:
                count = sum(all(pattern.search(part) for pattern in patterns) for part in TOP.split(text))
            if count:
                result[f"{rule}: {name}"] = count
    return result


def found():
    return places(sources(ROOT))


PLANTED = {
    "block box": [
        "Box box(const Setup& s) {\n    return {{0, 0, -s.spoil}, {s.block.size.x, 0, s.block.size.z - s.spoil}};\n}\n",
        "Box box(const Setup* s) {\n    const Vec3 size = s->block.size;\n    return {{0, 0, -s->spoil}, size};\n}\n",
    ],
    "tool axis": [
        "const Vec3 axis = rotate(setup.piece_in_setup, orientation.tool_axis);\n",
        "const Vec3 axis = rotate(setup_->piece_in_setup, d);\n",
        "const Vec3 axis = -rotate(piece_in_setup_, d);\n",
    ],
    "degrees": [
        "constexpr double degree = std::numbers::pi / 180;\n",
        "return turn * 180 / std::numbers::pi;\n",
        "return turn * pi / 180;\n",
        "constexpr double degrees = 57.29578;\n",
    ],
}
SOUND = [
    "double a(const Setup& s) {\n    return s.spoil;\n}\n\nVec3 b(const Setup& s) {\n    return s.block.size;\n}\n",
    "const Vec3 axis = setup.tool_axis(orientation);\n",
    "const Vec3 point = apply(setup.piece_in_setup, p);\n",
    "// pi / 180 is what base/units.h is for\n",
    "const double quarter = std::numbers::pi / 2;\n",
]


class Together(unittest.TestCase):
    def test_what_a_concept_is_made_of_is_read_together_in_one_place(self):
        self.assertEqual(known_faults("together", found()), [])

    def test_a_planted_place_is_found_and_allowed_where_it_belongs(self):
        for rule, texts in PLANTED.items():
            for text in texts:
                self.assertEqual(places({"cam/job/a.cpp": text}), Counter({f"{rule}: cam/job/a.cpp": 1}), text)
                for home in RULES[rule][0]:
                    self.assertEqual(places({home: text}), Counter(), text)

    def test_the_parts_alone_are_no_faults(self):
        for text in SOUND:
            self.assertEqual(places({"cam/job/a.cpp": text}), Counter(), text)


if __name__ == "__main__":
    unittest.main()
