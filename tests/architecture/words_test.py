"""Holds names, comments, messages and documents to the table in words.py, and the table to planted words."""

import unittest
from pathlib import Path

from words import OTHER_USES, REFUSED, faults, not_terms, refused_in, refused_lines, undecided

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

    def test_what_is_found_in_a_line_is_found_in_a_text(self):
        for word in REFUSED:
            for line in (f"// {word.replace('_', ' ')}", word, "".join(part.title() for part in word.split("_")) + ";"):
                self.assertIn((2, refused_in(line)), refused_lines(f"a\n{line}\n"), line)
                self.assertIn(word, refused_in(line))

    def test_every_word_of_the_glossarys_last_column_is_refused_or_has_another_use(self):
        glossary = (ROOT / "docs" / "developer" / "glossary.md").read_text(encoding="utf-8")
        self.assertGreater(len(list(not_terms(glossary))), 50)
        self.assertEqual(list(undecided(glossary)), [])
        self.assertEqual(sorted(OTHER_USES.keys() - set(not_terms(glossary))), [])

    def test_a_planted_row_of_the_glossary_is_found(self):
        self.assertEqual(list(undecided("| term | meaning | not |\n| a | of b; c | crumb, blob |\n")), ["blob"])

    def test_words_that_only_look_alike_are_left_alone(self):
        for line in ("dispatch(patches);", "broom", "bread crumbles", "enterprise", "straightaway"):
            self.assertEqual(refused_in(line), [], line)

    def test_the_table_is_of_lower_case_parts(self):
        for word in REFUSED:
            self.assertRegex(word, r"^[a-z]+(_[a-z]+)*$")


if __name__ == "__main__":
    unittest.main()
