"""Holds names, comments, messages and documents to the table in words.py, and the table to planted words."""

import unittest
from pathlib import Path

from words import REFUSED, faults, refused_in

ROOT = Path(__file__).resolve().parents[2]


class Words(unittest.TestCase):
    def test_no_refused_word_is_used(self):
        self.assertEqual(list(faults(ROOT)), [])

    def test_a_planted_word_is_found(self):
        for line, word in {
            "double crumb_volume_mm3 = 0;": "crumb",
            "struct CrumbList {": "crumb",
            "// a wall of the house": "the_house",
            'throw InputError("the oracle is hopeless");': "hopeless",
            "class PieceBook;": "piece_book",
            "| straight ways | |": "straight_ways",
            "class FoamMap {": "foam_map",
            "HeightField tip_surface(const HeightField& piece);": "tip_surface",
            "// the joint ways of a section": "joint_ways",
            "enum class StartVerdict { started };": "start_verdict",
        }.items():
            self.assertIn(word, refused_in(line), line)

    def test_words_that_only_look_alike_are_left_alone(self):
        for line in ("dispatch(patches);", "broom", "bread crumbles", "enterprise", "straightaway"):
            self.assertEqual(refused_in(line), [], line)

    def test_the_table_is_of_lower_case_parts(self):
        for word in REFUSED:
            self.assertRegex(word, r"^[a-z0-9]+(_[a-z0-9]+)*$")


if __name__ == "__main__":
    unittest.main()
