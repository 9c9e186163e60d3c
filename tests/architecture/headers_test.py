"""A header that one file of the modules includes is folded into that file, unless it states a contract worth a test.

A header with one user is sound if a test includes it. Not counted as a user is the source of the same name.
known/headers.txt holds those that are neither folded nor tested yet.
"""

import unittest
from collections import Counter

from includes import INCLUDE, unit_of
from ratchet import ROOT, known_faults, sources


def quoted(text):
    return {match.group(2) for line in text.splitlines() if (match := INCLUDE.match(line)) and match.group(1) == '"'}


def untested_with_one_user(production, tests):
    users = Counter()
    for name, text in production.items():
        users.update(target for target in quoted(text) if unit_of(target) != unit_of(name))
    tested = set().union(*map(quoted, tests.values()))
    return Counter(name for name in production if name.endswith(".h") and users[name] < 2 and name not in tested)


def found():
    return untested_with_one_user(sources(ROOT), sources(ROOT, folders=("tests",)))


PRODUCTION = {
    "base/thing.h": "",
    "base/thing.cpp": '#include "base/thing.h"\n',
    "base/a.cpp": '#include "base/thing.h"\n',
    "base/b.cpp": '#include "base/thing.h"\n',
}
TESTS = {"tests/base/thing_test.cpp": '#include "base/thing.h"\n'}


class Headers(unittest.TestCase):
    def test_no_header_with_one_user_is_without_a_test_of_its_own(self):
        self.assertEqual(known_faults("headers", found()), [])

    def test_two_users_or_a_test_are_reason_enough(self):
        one = {name: text for name, text in PRODUCTION.items() if name != "base/b.cpp"}
        self.assertEqual(untested_with_one_user(PRODUCTION, {"t": ""}), Counter())
        self.assertEqual(untested_with_one_user(one, TESTS), Counter())

    def test_a_planted_header_is_found(self):
        thing = Counter({"base/thing.h": 1})
        one = {name: text for name, text in PRODUCTION.items() if name != "base/b.cpp"}
        none = {name: text for name, text in one.items() if name != "base/a.cpp"}
        self.assertEqual(untested_with_one_user(one, {"t": ""}), thing)
        self.assertEqual(untested_with_one_user(none, {"t": ""}), thing, "its own source is no user")
        commented = PRODUCTION | {"base/b.cpp": '// #include "base/thing.h"\n'}
        self.assertEqual(untested_with_one_user(commented, {"t": ""}), thing)
        self.assertEqual(untested_with_one_user(one, {"t": '// as "base/thing.h" says\n'}), thing)


if __name__ == "__main__":
    unittest.main()
