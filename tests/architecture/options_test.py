"""No sentence outside of app/cli and app/report names an option of the command line: a page says the same sentences.

Where an option helps, the sentence has a key (base/sentence.h), and the table in app/report/command_line_text.cpp a row
for it, with a place for each value. Documents are checked where the tests of the program print them
(tests/app/cli/program.cpp).
"""

import re
import unittest

from ratchet import ROOT, sources

# The arguments themselves, the lines that the command line prints, and the commands that the console runs.
ALLOWED = ("app/cli/", "app/report/", "app/console/command_words.cpp")
TABLE = "app/report/command_line_text.cpp"

COMMENT = re.compile(r"^\s*//.*$|(?<=[;{}(),])\s+// .*$", re.MULTILINE)
LITERAL = re.compile(r'"(?:[^"\\\n]|\\.)*"')
OPTION = re.compile(r"(?<![\w-])--[a-z]")
ROW = re.compile(r'\{\s*"([a-z_]+)",\s*((?:"(?:[^"\\]|\\.)*"\s*)+)\}')
KEYED = re.compile(r'\bwith_key\(\s*"([a-z_]+)",\s*\{')


def options_in(text):
    """The literals of a source that name an option."""
    return [literal for literal in LITERAL.findall(COMMENT.sub("", text)) if OPTION.search(literal)]


def named_options(texts):
    return [f"{name}: {literal}" for name, text in texts.items() if not name.startswith(ALLOWED) for literal in options_in(text)]


def rows_in(text):
    """key -> how many values its row asks for."""
    table = text[text.index("constexpr Row rows[]"):]
    return {
        key: len(set(re.findall(r"\{(?:word )?(\d)\}", literals)))
        for key, literals in ROW.findall(table[: table.index("\n};")])
    }


def values_behind(text):
    """How many values stand in the list that `text` begins with, which ends with its }."""
    text = LITERAL.sub('""', text)
    depth, commas, end = 0, 0, 0
    for end, character in enumerate(text):
        if character in "({[":
            depth += 1
        elif character in ")}]":
            if depth == 0:
                break
            depth -= 1
        elif character == "," and depth == 0:
            commas += 1
    return commas + 1 if text[:end].strip() else 0


def keyed_in(texts):
    """(key, number of values) of every sentence with a key."""
    return [
        (match.group(1), values_behind(text[match.end():])) for text in texts.values() for match in KEYED.finditer(text)
    ]


class Options(unittest.TestCase):
    def setUp(self):
        self.texts = sources(ROOT)

    def test_no_sentence_of_the_engine_names_an_option(self):
        self.assertEqual(named_options(self.texts), [])

    def test_every_key_has_a_row_with_its_values_and_every_row_is_used(self):
        rows = rows_in(self.texts[TABLE])
        keyed = keyed_in(self.texts)
        self.assertGreater(len(rows), 40)
        self.assertEqual([one for one in keyed if one != (one[0], rows.get(one[0]))], [])
        self.assertEqual(sorted(rows.keys() - {key for key, _ in keyed}), [])
        used = sum(text.count("with_key(") for name, text in self.texts.items() if name != "base/sentence.h")
        self.assertEqual(used, len(keyed), "a key that is no literal, or values that are no list")

    def test_a_planted_option_is_found(self):
        for line in ('throw InputError("pass --units mm");', 'text += "--again";', 'f("a", "leave --pose out");'):
            self.assertEqual(len(named_options({"cam/a.cpp": line})), 1, line)
            self.assertEqual(named_options({"app/cli/a.cpp": line}), [])
        for line in ('// "pass --units mm"', 'a = b;  // of "--units"', 'text = "well--known";', "--count;"):
            self.assertEqual(named_options({"cam/a.cpp": line}), [], line)

    def test_rows_and_values_are_counted(self):
        table = 'constexpr Row rows[] = {\n    {"a_b", "x {0}"\n     " {word 1}[ {0}]"},\n    {"c", "d"},\n};\n{"e", "f"}'
        self.assertEqual(rows_in(table), {"a_b": 2, "c": 0})
        for text, count in (("}", 0), (" }", 0), ("f(a, b)}", 1), ('{a, b}, "x, }"}', 2)):
            self.assertEqual(values_behind(text), count, text)
        self.assertEqual(keyed_in({"a": 'Sentence::with_key(\n "k", {a, "b"}, "t")'}), [("k", 2)])


if __name__ == "__main__":
    unittest.main()
