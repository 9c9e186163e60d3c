"""A source of more than 150 lines begins with a comment: its method, the method's reference, and its cost.

The cost is in O(), or in words: the head says what costs, takes, keeps or is linear in what. Where the cost is that of
reading and writing texts, field by field, there is nothing to say (NO_COST). known/heads.txt holds the sources that
still say nothing of it.
"""

import re
import unittest
from collections import Counter

from ratchet import ROOT, known_faults, sources

MOST_LINES = 150  # of a source without a head
COST = re.compile(r"\bO\(|\b[Cc]osts?\b|\blinear(ly)?\b|\bmemory\b|seconds?\b|\bminutes?\b|\d [mn]?s\b|\btakes? (most|as long)")
NO_COST = ("app/cli/", "app/report/", "cam/job/sheet/", "app/store/project_json.cpp", "app/store/value_json.cpp")


def head(text):
    """The comment with which a text begins."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("//"):
            break
        lines.append(line.removeprefix("//").strip())
    return " ".join(lines).strip()


def headless(texts):
    result = Counter()
    for name, text in texts.items():
        if not name.endswith(".cpp") or text.count("\n") <= MOST_LINES:
            continue
        comment = head(text)
        if not comment:
            result[f"{name}: no head"] += 1
        elif not name.startswith(NO_COST) and not COST.search(comment):
            result[f"{name}: no cost"] += 1
    return result


def found():
    return headless(sources(ROOT))


BODY = "\nint a = 0;" * MOST_LINES + "\n"


class Heads(unittest.TestCase):
    def test_every_long_source_begins_with_its_method_and_cost(self):
        self.assertEqual(known_faults("heads", found()), [])

    def test_a_sound_or_short_source_and_a_header_are_no_faults(self):
        for name, text in (
            ("base/a.cpp", "// By bisection. O(n log n)." + BODY),
            ("base/a.cpp", "// By bisection.\n// The cost is that of f." + BODY),
            ("base/a.cpp", "\nint a = 0;" * 20),
            ("base/a.h", BODY),
            ("app/report/a.cpp", "// Text from a value." + BODY),
        ):
            self.assertEqual(headless({name: text}), Counter(), name)

    def test_a_planted_source_without_head_or_cost_is_found(self):
        for name, text, words in (
            ("base/a.cpp", BODY, "no head"),
            ("app/report/a.cpp", BODY, "no head"),
            ("base/a.cpp", "//" + BODY, "no head"),
            ("base/a.cpp", "// By bisection." + BODY, "no cost"),
            ("base/a.cpp", "// By bisection.\n\n// O(1) is what this takes." + BODY, "no cost"),
        ):
            self.assertEqual(headless({name: text}), Counter({f"{name}: {words}": 1}))


if __name__ == "__main__":
    unittest.main()
