"""The commands of docs/user/tutorial.md, in their order, and what the page says that they print.

tutorial_test.py PROGRAM: every line after "$ " of a code block is run; the block with cell-sim is the second terminal,
where each question is answered with y. A block marked "long" takes minutes and is run if QCHOPPER_LONG is set. The lines
below a command are compared with the output, numbers left out: a line "..." stands for any lines.
"""

import os
import re
import threading
import time
import unittest

from terminal_test import ROOT, InFolder, Terminal, free_port

PAGE = ROOT / "docs" / "user" / "tutorial.md"
UUID = re.compile(r"\b[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}\b")
# What a terminal shows beside the lines: progress, which is overwritten, and codes.
OVERWRITTEN = re.compile(r"[^\n]*\r(?!\n)|\x1b\[[0-9;]*[A-Za-z]")


def blocks_of(page):
    """Of each code block the commands and the lines that are printed below them."""
    blocks = []
    for mark, text in re.findall(r"^```(\w*)\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
        if mark == "long" and "QCHOPPER_LONG" not in os.environ:
            continue
        lines = text.splitlines()
        commands = [line[2:] for line in lines if line.startswith("$ ")]
        shown = [line for line in lines if not line.startswith("$ ") and line.strip() not in ("", "...")]
        if commands:
            blocks.append((commands, shown))
    return blocks


def masked(line):
    line = UUID.sub("#", line)
    line = re.sub(r"\d[\d.,]*(?:e[+-]?\d+)?", "#", line)
    return re.sub(r"\s+", " ", line).strip()


class Tutorial(InFolder):
    def setUp(self):
        super().setUp()
        self.port = str(free_port())
        path = f"{self.folder / 'build' / 'release'}:{os.environ['PATH']}"
        self.environment = dict(self.environment, PATH=path, COLUMNS="200")
        self.ended = threading.Event()

    def start(self, script):
        """The second terminal; it is served until the test ends."""
        terminal = Terminal(script, self.folder, self.environment, b"y")
        end = time.monotonic() + 60
        while "listening" not in terminal.output and time.monotonic() < end and terminal.step():
            pass

        def serve():
            while not self.ended.is_set() and terminal.step():
                pass

        server = threading.Thread(target=serve)
        server.start()

        def stop():
            self.ended.set()
            server.join()
            os.write(terminal.terminal, b"\x03")
            terminal.end()

        self.addCleanup(stop)
        return terminal

    def test_works_as_it_is_printed(self):
        blocks = blocks_of(PAGE.read_text(encoding="utf-8"))
        self.assertGreater(len(blocks), 5)
        serving = []
        for commands, shown in blocks:
            script = "set -e\n" + "\n".join(commands).replace("15020", self.port)
            with self.subTest(commands=commands):
                if "cell-sim" in script:
                    serving.append((self.start(script), shown))
                    continue
                terminal = Terminal(script, self.folder, self.environment, b"n")
                self.assertEqual(terminal.wait(), 0, terminal.output)
                self.compare(terminal.output, shown)
        for terminal, shown in serving:
            self.compare(terminal.output, shown)

    def compare(self, output, shown):
        printed = [masked(line) for line in OVERWRITTEN.sub("", output.replace("\r\n", "\n")).split("\n")]
        for line in shown:
            self.assertIn(masked(line.replace("15020", self.port)), printed)


if __name__ == "__main__":
    unittest.main()
