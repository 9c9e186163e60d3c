"""Holds the lists of known violations to what ratchet.py says of them."""

import tempfile
import unittest
from collections import Counter
from pathlib import Path

from ratchet import KNOWN, RULES, faults, parse, shrink, written

LIST = "# May only shrink.\na.cpp\nb.cpp x3\n"


class Ratchet(unittest.TestCase):
    def test_a_list_is_read_as_it_is_written(self):
        self.assertEqual(parse(LIST), Counter({"a.cpp": 1, "b.cpp": 3}))
        self.assertEqual(parse(written(parse(LIST))), parse(LIST))

    def test_what_is_not_listed_and_what_is_listed_in_vain_are_faults(self):
        known = parse(LIST)
        self.assertEqual(list(faults(known, Counter({"a.cpp": 1, "b.cpp": 3}))), [])
        for found, words in (
            ({"a.cpp": 1, "b.cpp": 3, "c.cpp": 1}, "c.cpp: found 1 times, 0 are known"),
            ({"a.cpp": 2, "b.cpp": 3}, "a.cpp: found 2 times, 1 are known"),
            ({"b.cpp": 3}, "a.cpp: found 0 times, 1 are listed"),
            ({"a.cpp": 1, "b.cpp": 2}, "b.cpp: found 2 times, 3 are listed"),
        ):
            lines = list(faults(known, Counter(found)))
            self.assertEqual(len(lines), 1)
            self.assertIn(words, lines[0])

    def test_a_list_shrinks_and_never_grows(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "list.txt"
            path.write_text(LIST, encoding="utf-8")
            shrink(path, Counter({"b.cpp": 2, "c.cpp": 1}))
            self.assertEqual(path.read_text(encoding="utf-8"), "# May only shrink.\nb.cpp x2\n")

    def test_every_rule_has_its_list_and_every_list_its_rule(self):
        self.assertEqual(sorted(path.stem for path in KNOWN.iterdir()), sorted(RULES))


if __name__ == "__main__":
    unittest.main()
