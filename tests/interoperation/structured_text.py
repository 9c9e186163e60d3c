"""A grammar for the part of IEC 61131-3 structured text in which docs/user/cell-integration.st is written: declarations
of types and of constants, nothing else. parse() raises SyntaxError with the line."""

import re

TOKEN = re.compile(r"\(\*.*?\*\)|[A-Za-z_]\w*|\d+|:=|\.\.|[-:;,()\[\]]|\s+|.", re.DOTALL)
SIMPLE = {"BOOL": (0, 1), "BYTE": (0, 0xFF), "WORD": (0, 0xFFFF), "INT": (-0x8000, 0x7FFF), "UINT": (0, 0xFFFF),
          "UDINT": (0, 0xFFFFFFFF), "DINT": (-(1 << 31), (1 << 31) - 1), "ULINT": (0, (1 << 64) - 1)}
BYTES = {"BYTE": 1, "WORD": 2, "INT": 2, "UINT": 2, "UDINT": 4, "DINT": 4, "ULINT": 8}
KEYWORDS = {"TYPE", "END_TYPE", "STRUCT", "END_STRUCT", "ARRAY", "OF", "STRING", "VAR_GLOBAL", "CONSTANT", "END_VAR",
            "TRUE", "FALSE", "IF", "FOR", "CASE", "END_CASE", *SIMPLE}


class Parser:
    def __init__(self, text):
        self.tokens, line = [], 1
        for token in TOKEN.findall(text):
            if not token.isspace() and not token.startswith("(*"):
                self.tokens.append((token, line))
            line += token.count("\n")
        self.at, self.types, self.constants = 0, {}, {}

    def fail(self, why):
        token, line = self.tokens[min(self.at, len(self.tokens) - 1)]
        raise SyntaxError(f"line {line}, at {token}: {why}")

    def next(self):
        return self.tokens[self.at][0] if self.at < len(self.tokens) else ""

    def take(self, wanted):
        if self.next() != wanted:
            self.fail(f"{wanted} is missing")
        self.at += 1

    def name(self):
        token = self.next()
        if not re.fullmatch(r"[A-Za-z_]\w*", token) or token.upper() in KEYWORDS or "__" in token or token.endswith("_"):
            self.fail("no identifier")
        self.at += 1
        return token

    def number(self):
        sign = -1 if self.next() == "-" else 1
        self.at += sign < 0
        if not self.next().isdigit():
            self.fail("no number")
        self.at += 1
        return sign * int(self.tokens[self.at - 1][0])

    def type_of(self):
        token = self.next()
        if token == "STRING":
            self.at += 1
            self.take("[")
            length = self.number()
            self.take("]")
            return ("STRING", length)
        if token == "ARRAY":
            self.at += 1
            self.take("[")
            ranges = [self.range_of()]
            while self.next() == ",":
                self.at += 1
                ranges.append(self.range_of())
            self.take("]")
            self.take("OF")
            return ("ARRAY", ranges, self.type_of())
        if token not in SIMPLE and token not in self.types:
            self.fail("no type")
        self.at += 1
        return token

    def range_of(self):
        first = self.number()
        self.take("..")
        last = self.number()
        if last < first:
            self.fail("an empty range")
        return first, last

    def struct(self):
        self.take("STRUCT")
        fields = {}
        while self.next() != "END_STRUCT":
            field = self.name()
            if field.upper() in fields:
                self.fail("a field of this name is there already")
            self.take(":")
            fields[field.upper()] = self.type_of()
            self.take(";")
        self.take("END_STRUCT")
        return fields

    def value(self, kind):
        if isinstance(kind, str) and kind in self.types:
            self.take("(")
            fields = dict(self.types[kind])
            while fields:
                field = self.name().upper()
                if field not in fields:
                    self.fail("no field of the structure, or one for the second time")
                self.take(":=")
                self.value(fields.pop(field))
                if fields:
                    self.take(",")
            self.take(")")
        elif kind == "BOOL":
            if self.next() not in ("TRUE", "FALSE"):
                self.fail("neither TRUE nor FALSE")
            self.at += 1
        elif isinstance(kind, str):
            least, most = SIMPLE[kind]
            if not least <= self.number() <= most:
                self.fail(f"out of the range of {kind}")
        elif kind[0] == "ARRAY":
            count = 1
            for first, last in kind[1]:
                count *= last - first + 1
            self.take("[")
            for n in range(count):
                if n:
                    self.take(",")
                self.value(kind[2])
            self.take("]")
        else:
            self.fail("no constant of this type")

    def declarations(self):
        while self.at < len(self.tokens):
            if self.next() == "TYPE":
                self.at += 1
                while self.next() != "END_TYPE":
                    name = self.name()
                    self.take(":")
                    self.types[name] = self.struct()
                    self.take(";")
                self.take("END_TYPE")
            else:
                self.take("VAR_GLOBAL")
                self.take("CONSTANT")
                while self.next() != "END_VAR":
                    name = self.name()
                    if name.upper() in self.constants:
                        self.fail("a constant of this name is there already")
                    self.take(":")
                    kind = self.type_of()
                    self.take(":=")
                    begin = self.at
                    self.value(kind)
                    self.constants[name.upper()] = [token for token, _ in self.tokens[begin : self.at]]
                    self.take(";")
                self.take("END_VAR")


def parse(text):
    parser = Parser(text)
    parser.declarations()
    return parser


def size_of(kind):
    """Bytes on the wire."""
    if isinstance(kind, str):
        return BYTES[kind]
    if kind[0] == "STRING":
        return kind[1]
    count = 1
    for first, last in kind[1]:
        count *= last - first + 1
    return count * size_of(kind[2])
