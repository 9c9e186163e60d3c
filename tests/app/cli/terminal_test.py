"""What the program does on a terminal: the session of the README, and questions.

terminal_test.py PROGRAM: the program is run on pseudo-terminals, as a person runs it in a shell.
"""

import os
import pty
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = Path(sys.argv.pop(1)).resolve()
LONGEST_S = 600


class Terminal:
    """A shell command on a terminal of its own, which answers each question the same."""

    def __init__(self, command, folder, environment, answer):
        self.output = ""
        self.answer = answer
        self.answered = 0
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.execvpe("bash", ["bash", "-e", "-c", command], environment)

    def step(self, seconds=0.1):
        """Reads what there is, and answers what is asked. False once the command has ended."""
        if self.terminal not in select.select([self.terminal], [], [], seconds)[0]:
            return True
        try:
            self.output += os.read(self.terminal, 65536).decode(errors="replace")
        except OSError:  # the other side is closed
            return False
        while self.output.count("[y/N]") > self.answered:
            self.answered += 1
            os.write(self.terminal, self.answer + b"\n")
        return True

    def wait(self):
        end = time.monotonic() + LONGEST_S
        while self.step() and time.monotonic() < end:
            pass
        return self.end()

    def end(self):
        """The exit code; a command that still runs gets SIGTERM."""
        for number in (None, signal.SIGTERM, signal.SIGKILL):
            if number is not None:
                os.kill(self.child, number)
            for _ in range(100):
                pid, status = os.waitpid(self.child, os.WNOHANG)
                if pid != 0:
                    os.close(self.terminal)
                    return os.waitstatus_to_exitcode(status)
                if not self.step(0.1):
                    time.sleep(0.1)  # the terminal is closed before the process has ended
        raise AssertionError("it cannot be ended")


def session_blocks():
    """The commands of each code block of the README's section "A session"."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    section = readme.split("\n## A session\n", 1)[1].split("\n## ", 1)[0]
    blocks = re.findall(r"```\w*\n(.*?)```", section, re.DOTALL)
    return [[line[2:] for line in block.splitlines() if line.startswith("$ ")] for block in blocks]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="qchopper-terminal-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "build" / "release").mkdir(parents=True)
        (self.folder / "build" / "release" / "qchopper").symlink_to(PROGRAM)
        (self.folder / "cells").symlink_to(ROOT / "cells")
        self.environment = dict(os.environ, XDG_STATE_HOME=str(self.folder / "state"), TERM="dumb")

    def run_here(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=LONGEST_S, check=False)


class ReadmeSession(InFolder):
    def test_works_as_it_is_printed(self):
        # A free port, and fewer faces: the test is short.
        port = str(free_port())
        blocks = [["set -e"] + [line.replace("15020", port).replace("--faces 60000", "--faces 4000") for line in block]
                  for block in session_blocks()]
        self.assertEqual(len(blocks), 3)
        alone, cell, rest = ["\n".join(block) for block in blocks]
        prepared = Terminal(alone, self.folder, self.environment, b"n")
        self.assertEqual(prepared.wait(), 0, prepared.output)
        self.assertIn("jobs ended complete on the simulated cell", prepared.output)
        serving = Terminal(cell, self.folder, self.environment, b"y")
        end = time.monotonic() + 60
        while "listening" not in serving.output and time.monotonic() < end and serving.step():
            pass
        # The first terminal again, which has the program in its path.
        setting = blocks[0][1]
        self.assertTrue(setting.startswith("PATH="), setting)
        dispatched = Terminal(setting + "\n" + rest, self.folder, self.environment, b"n")
        ended = threading.Event()

        def serve():
            while not ended.is_set() and serving.step():
                pass

        server = threading.Thread(target=serve)
        server.start()
        try:
            code = dispatched.wait()
        finally:
            ended.set()
            server.join()
            os.write(serving.terminal, b"\x03")  # Ctrl-C
            serving.end()
        self.assertEqual(code, 0, dispatched.output + serving.output)
        self.assertGreaterEqual(serving.answered, 1, serving.output)
        self.assertRegex(dispatched.output, r"all \d+ jobs ended complete on the simulated cell")


class SizeQuestion(InFolder):
    """A scan of 3 mm is a scan whose unit is wrong, as a rule."""

    def setUp(self):
        super().setUp()
        self.assertEqual(self.run_here("sample", "vertebra", "--faces", "2000", "-o", "s.ply").returncode, 0)
        self.repair = ["repair", "s.ply", "--units", "mm", "--scale", "0.01", "-o"]
        self.make = ["segment", "s.ply", "--units", "m", "--scale", "1", "--preset", "thesis", "-o"]

    def ask(self, arguments, answer):
        asked = Terminal(" ".join(["exec", str(PROGRAM), *arguments]), self.folder, self.environment, answer)
        return asked.wait(), asked

    def test_is_asked_on_a_terminal(self):
        for arguments, size in ((self.repair, "3.44 mm x 1.63 mm x 3.17 mm"), (self.make, "344")):
            code, asked = self.ask([*arguments, "refused" + (".ply" if arguments[0] == "repair" else ".qch")], b"n")
            self.assertEqual(code, 64, asked.output)
            self.assertEqual(asked.answered, 1, asked.output)
            self.assertIn(size, asked.output)
            code, asked = self.ask([*arguments, "taken" + (".ply" if arguments[0] == "repair" else ".qch")], b"y")
            self.assertEqual(code, 0, asked.output)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir() if path.name[0] in "rt"),
                         ["taken.ply", "taken.qch"])

    def test_is_refused_without_a_terminal_and_taken_with_size_ok(self):
        for arguments, out in ((self.repair, "a.ply"), (self.make, "a.qch"),
                               (["prepare", "--cell", "cells/foam-1.toml", *self.make[1:]], "b.qch")):
            refused = self.run_here(*arguments, out)
            self.assertEqual(refused.returncode, 64, refused.stderr)
            self.assertIn("--size-ok", refused.stderr)
            self.assertFalse((self.folder / out).exists())
        for arguments, out in ((self.repair, "a.ply"), (self.make, "a.qch")):
            taken = self.run_here(*arguments, out, "--size-ok")
            self.assertEqual(taken.returncode, 0, taken.stderr)
        # Once the project is there, its size was agreed to.
        self.assertEqual(self.run_here("segment", "a.qch", "--step").returncode, 0)

    def test_is_told_by_inspect(self):
        self.assertIn("is its unit right?", self.run_here("inspect", "s.ply", "--units", "m").stdout)
        self.assertNotIn("is its unit right?", self.run_here("inspect", "s.ply", "--units", "mm").stdout)


if __name__ == "__main__":
    unittest.main()
