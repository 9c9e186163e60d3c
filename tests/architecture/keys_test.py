"""A key of a document is written once: in the table of fields of its struct, or else in one place.

A table of fields has a line v("key", x.member, ...) for each; keys in tables are not counted, because two structs may
have a field of one name. Counted is every other place in a source that sees JSON where a literal stands as a key: in
{"key", value}, in json["key"], in json.at("key"), and as the second argument of a function that reads a member. The keys
that stand more than once are listed in known/keys.txt, with the number of places.
"""

import re
import unittest
from collections import Counter

from ratchet import ROOT, known_faults, sources

KEY = r'"([a-z][a-z0-9]*(?:_[a-z0-9]+)*)"'
PLACES = [
    re.compile(r"\{\s*" + KEY + r"\s*,"),
    re.compile(r"\[" + KEY + r"\]"),
    re.compile(r"\b(?:at|value|contains|find|count|erase)\(" + KEY),
    re.compile(r"\b\w+\((?!\")[\w.\[\]>*&-]+(?:\([^()\"]*\))?, " + KEY + r"\s*[,)]"),
]
SEES_JSON = re.compile(r'#\s*include\s*(?:<nlohmann/|"base/json\.h")')
COMMENT = re.compile(r"^\s*//.*$", re.MULTILINE)


def keys_in(text):
    """Every key that a source writes outside of tables of fields, as often as it does; nothing if it sees no JSON."""
    if not SEES_JSON.search(text):
        return Counter()
    text = COMMENT.sub("", text)
    places = {match.start(1): match.group(1) for place in PLACES for match in place.finditer(text)}
    return Counter(places.values())


def repeated(texts):
    keys = sum(map(keys_in, texts.values()), Counter())
    return Counter({key: count for key, count in keys.items() if count > 1})


def found():
    return repeated(sources(ROOT))


def source(text):
    return f"#include <nlohmann/json.hpp>\n{text}\n"


class Keys(unittest.TestCase):
    def test_no_key_is_written_twice_outside_of_tables(self):
        self.assertEqual(known_faults("keys", found()), [])

    def test_a_planted_key_is_found_in_every_form(self):
        for text in (
            'Json j{{"length_mm", x.length}};',
            'Json j{\n    {"length_mm",\n     x.length}};',
            'j["length_mm"] = 1;',
            'j.at("length_mm").get<double>();',
            'if (j.contains("length_mm")) return;',
            'real(member, "length_mm");',
            'real(member(json, "other"), "other_mm"); not_negative(json, "length_mm");',
            'to_pose(lying.front(), "length_mm");',
        ):
            two = {"base/a.cpp": source(text), "cam/b.cpp": source('write({{"length_mm", 1}});')}
            self.assertEqual(repeated(two), Counter({"length_mm": 2}), text)

    def test_tables_words_comments_and_sources_without_json_are_no_places_of_a_key(self):
        for text in (
            source('v("length_mm", x.length, "path at feed and rapid");'),
            source('v("length_mm", x.length, "of a pass"); v("length_mm", x.pass, "of all");'),
            source('say("length_mm");'),
            source('// j["length_mm"]'),
            'names["length_mm"] = 1;',
        ):
            two = {"base/a.cpp": text, "cam/b.cpp": source('write({{"length_mm", 1}});')}
            self.assertEqual(repeated(two), Counter(), text)


if __name__ == "__main__":
    unittest.main()
