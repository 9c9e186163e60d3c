"""The declarations for controllers follow the grammar, and every structure has the size of its block."""

import os
import re
import sys
import unittest

import structured_text

FILE = os.path.join(sys.argv.pop(1), "docs", "user", "cell-integration.st")


class StructuredText(unittest.TestCase):
    def setUp(self):
        with open(FILE, encoding="utf-8") as file:
            self.text = file.read()

    def test_it_follows_the_grammar_and_a_structure_has_the_size_of_its_block(self):
        parsed = structured_text.parse(self.text)
        self.assertEqual(len(parsed.types), 9)
        for name, fields in parsed.types.items():
            count = parsed.constants.get(name + "_COUNT")
            if count is not None:
                self.assertEqual(sum(map(structured_text.size_of, fields.values())), 2 * int(count[0]), name)
        self.assertEqual(parsed.constants["QC_CMD_CLAIM"], ["100"])
        self.assertEqual(parsed.constants["QC_ACK_HASH_MISMATCH"], [str(0x306)])
        machine = [int(n) for n in re.findall(r"-?\d+", "".join(parsed.constants["QC_MACHINE"]))]
        self.assertEqual(len(machine), 170)
        self.assertEqual(machine[3 * 10 + 1], 3)  # Idle, Start: Starting

    def test_what_is_broken_is_refused(self):
        changes = [(";", "", 3), ("END_STRUCT", "", 2), ("UINT", "UNIT", 5), (":=", "=", 4), (" 0,", " ,", 1),
                   ("TRUE,", "", 6), ("UDINT", "UDINT UDINT", 1), ("END_TYPE", "", 0), ("1..17", "17..1", 0),
                   ("QC_CMD_CLAIM : UINT := 100", "QC_CMD_CLAIM : UINT := 99999", 0),
                   ("AFTER := 1", "BEFORE := 1", 0), ("EPOCH_HELD", "FLAGS", 0)]
        code = re.sub(r"\(\*.*?\*\)", lambda match: "#" * len(match[0]), self.text, flags=re.DOTALL)
        for old, new, place in changes:
            at = [match.start() for match in re.finditer(re.escape(old), code)][place]
            with self.assertRaises(SyntaxError, msg=f"{old} -> {new}"):
                structured_text.parse(self.text[:at] + new + self.text[at + len(old) :])


if __name__ == "__main__":
    unittest.main()
