"""Programs of other people against our cell, and our dispatcher against cells that are not ours, on loopback.

  interoperation_test.py QCHOPPER PLC_CELL SOURCES [MODULES]

PLC_CELL is plc_cell.c, built. mbpoll and pymodbus are the Debian packages of `scripts/install test`. MODULES is the
folder node_modules with modbus-serial, for ctest build/release/interoperation/node_modules: `npm install --prefix
build/release/interoperation --ignore-scripts --omit=optional modbus-serial@8.0.25`. What is not there is skipped.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

QCHOPPER, PLC_CELL, SOURCES = sys.argv[1:4]
MODULES = sys.argv[4] if len(sys.argv) > 4 and not sys.argv[4].startswith("-") else ""
del sys.argv[1 : 5 if MODULES else 4]
MAP = os.path.join(SOURCES, "docs", "developer", "formats", "registers.md")
SMALL_CELL = os.path.join(SOURCES, "tests", "interoperation", "small_cell.py")
SYSTEM_PYTHON = "/usr/bin/python3"  # which sees the Debian packages
OWNER, CLAIM = 0x0BADCAFE, 100


def has_pymodbus():
    code = "import pymodbus.client, pymodbus.server, sys; sys.exit(not pymodbus.__version__.startswith('3.0'))"
    try:
        return subprocess.run([SYSTEM_PYTHON, "-c", code], capture_output=True).returncode == 0
    except OSError:
        return False


needs_pymodbus = unittest.skipUnless(has_pymodbus(), "skipped: pymodbus 3.0 is not installed")


def command(what, epoch=1, seq=1):
    """The registers of COMMAND, packed by hand."""
    head = struct.pack(">HHIIHH16sIII32sI36s", 0x5143, 0x0100, epoch, seq, what, 0, bytes(16), 0, 0, 0x1234, bytes(32),
                       OWNER, bytes(36))
    frame = head + struct.pack(">I", zlib.crc32(head))
    return list(struct.unpack(">60H", frame))


class Cell:
    """A cell that runs as a process until the end of the block."""

    def __init__(self, arguments, folder):
        self.arguments, self.folder = arguments, folder

    def __enter__(self):
        self.process = subprocess.Popen(self.arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                        cwd=self.folder, stdin=subprocess.DEVNULL)
        line = self.process.stdout.readline()
        self.address = re.match(r"listening (\S+)", line)[1]
        self.port = int(self.address.rsplit(":", 1)[1])
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(30)
        self.process.stdout.close()


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.environment = dict(os.environ, XDG_STATE_HOME=os.path.join(self.folder, "state"))

    def run_qchopper(self, *arguments):
        return subprocess.run([QCHOPPER, *arguments], cwd=self.folder, env=self.environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, timeout=600)

    def our_cell(self):
        os.makedirs(os.path.join(self.folder, "drop"), exist_ok=True)
        return Cell([QCHOPPER, "cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop"], self.folder)


class OurCell(Folder):
    """Read and written by other people's clients."""

    def expect_claimed(self, before, after):
        self.assertEqual(before[0], 0x5143)
        self.assertEqual(before[7], 2)  # Stopped
        self.assertEqual(after[17], 1)  # ACK_RESULT OK
        self.assertEqual(after[91:93], [OWNER >> 16, OWNER & 0xFFFF])
        self.assertEqual(after[10:12], [0, 1])  # EPOCH_HELD

    @unittest.skipUnless(shutil.which("mbpoll"), "skipped: mbpoll is not installed")
    def test_mbpoll(self):
        def mbpoll(*arguments):
            with_values = subprocess.run(["mbpoll", "-m", "tcp", "-a", "1", "-0", "-1", "-p", str(cell.port), *arguments],
                                         capture_output=True, text=True, timeout=60)
            return with_values.returncode, with_values.stdout + with_values.stderr

        def registers(text):
            return [int(value, 16) for value in re.findall(r"^\[\d+\]:\s+0x([0-9A-F]+)", text, re.MULTILINE)]

        with self.our_cell() as cell:
            read = ["-t", "3:hex", "-r", "0", "-c", "100", "127.0.0.1"]
            _, before = mbpoll(*read)
            frame = [str(value) for value in command(CLAIM)]
            code, text = mbpoll("-t", "4", "-r", "0", "127.0.0.1", *frame)
            self.assertEqual(code, 0, text)
            _, after = mbpoll(*read)
            self.expect_claimed(registers(before), registers(after))
            code, text = mbpoll("-t", "4", "-r", "0", "127.0.0.1", *frame[:-1])
            self.assertNotEqual(code, 0)
            self.assertIn("Illegal data address", text)

    @needs_pymodbus
    def test_pymodbus(self):
        code = """
import json, sys
from pymodbus.client import ModbusTcpClient
client = ModbusTcpClient("127.0.0.1", port=int(sys.argv[1]))
assert client.connect()
frame = json.loads(sys.argv[2])
before = client.read_input_registers(0, 100, slave=1).registers
partial = client.write_registers(0, frame[:-1], slave=1).exception_code
assert not client.write_registers(0, frame, slave=1).isError()
after = client.read_input_registers(0, 100, slave=1).registers
zeros = client.read_holding_registers(0, 60, slave=1).registers
coils = client.read_coils(0, 8, slave=1).exception_code
unit = client.read_input_registers(0, 1, slave=7).exception_code
print(json.dumps([before, partial, after, zeros, coils, unit]))
client.close()
"""
        with self.our_cell() as cell:
            ran = subprocess.run([SYSTEM_PYTHON, "-c", code, str(cell.port), json.dumps(command(CLAIM))],
                                 capture_output=True, text=True, timeout=60)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        before, partial, after, zeros, coils, unit = json.loads(ran.stdout)
        self.expect_claimed(before, after)
        self.assertEqual((partial, coils, unit), (2, 1, 11))
        self.assertEqual(zeros, [0] * 60)

    def test_modbus_serial(self):
        module = os.path.join(MODULES, "modbus-serial")
        if not MODULES or not os.path.isdir(module) or not shutil.which("node"):
            self.skipTest("skipped: modbus-serial is not installed")
        script = os.path.join(SOURCES, "tests", "interoperation", "modbus_serial.cjs")
        frame = "".join(f"{value:04x}" for value in command(CLAIM))
        with self.our_cell() as cell:
            ran = subprocess.run(["node", script, module, str(cell.port), frame], capture_output=True, text=True,
                                 timeout=60)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        told = json.loads(ran.stdout)
        self.expect_claimed(told["before"], told["after"])
        self.assertEqual(told["partial"], 2)


class ForeignCells(Folder):
    """Written from docs/user/cell-integration.md: a job runs to its end, and the check finds nothing."""

    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.made)
        cell = os.path.join(SOURCES, "cells", "foam-1.toml")
        for arguments in (["sample", "vertebra", "--faces", "2000", "-o", "scan.ply"],
                          ["prepare", "scan.ply", "--units", "mm", "--cell", cell, "--preset", "thesis", "--min-cuts",
                           "1", "-o", "scan.qch"]):
            ran = subprocess.run([QCHOPPER, *arguments], cwd=cls.made, capture_output=True, text=True, timeout=600)
            assert ran.returncode == 0, ran.stderr
        jobs = os.listdir(os.path.join(cls.made, "scan.qch", "jobs"))
        cls.piece = sorted(jobs, key=lambda name: os.path.getsize(os.path.join(cls.made, "scan.qch", "jobs", name)))[0]
        cls.piece = cls.piece.removesuffix(".qjob")

    def expect_right(self, arguments):
        shutil.copytree(os.path.join(self.made, "scan.qch"), os.path.join(self.folder, "scan.qch"))
        with Cell(arguments, self.folder) as cell:
            checked = self.run_qchopper("cell", "check", cell.address, "--yes", "--json")
            document = json.loads(checked.stdout)
            wrong = [rule for rule in document["rules"] if not rule["holds"]]
            self.assertEqual(wrong, [])
            self.assertEqual(document["not_checked"], [])
            self.assertGreater(len(document["rules"]), 100)
            self.assertEqual(checked.returncode, 0)
            dispatch = ("dispatch", "scan.qch", "--to", cell.address, "--chunks", "--piece", self.piece)
            handed = self.run_qchopper(*dispatch)
            self.assertEqual(handed.returncode, 0, handed.stdout + handed.stderr)
            self.assertIn("Ended, complete", handed.stdout)
            again = self.run_qchopper(*dispatch)  # the cell knows the file
            self.assertIn("--again", again.stdout)
        # The memory outlives the process.
        with Cell(arguments, self.folder) as cell:
            status = json.loads(self.run_qchopper("cell", "status", "--to", cell.address, "--json").stdout)
            self.assertEqual(status["store"]["starts_total"], 1)
            self.assertEqual(status["store"]["boot_count"], 2)
        jobs = json.loads(self.run_qchopper("journal", "jobs", "--json").stdout)["jobs"]
        self.assertEqual([job["end"] for job in jobs if job["state"] == "ended"], ["complete"])

    def test_a_controller_in_c_with_a_cycle_of_10_ms(self):
        self.expect_right([PLC_CELL, "cell.store"])

    @needs_pymodbus
    def test_a_cell_in_python_on_pymodbus(self):
        self.expect_right([SYSTEM_PYTHON, "-B", SMALL_CELL, MAP, "cell.store"])

    def test_our_own_simulated_cell(self):
        with self.our_cell() as cell:
            checked = self.run_qchopper("cell", "check", cell.address, "--yes")
        self.assertEqual(checked.returncode, 0, checked.stdout)
        self.assertIn("no deviation was found", checked.stdout)


class NoCell(Folder):
    def test_nothing_listens_or_the_address_is_wrong(self):
        self.assertEqual(self.run_qchopper("cell", "check", "127.0.0.1:9", "--yes").returncode, 69)
        self.assertEqual(self.run_qchopper("cell", "check", "no address", "--yes").returncode, 64)


if __name__ == "__main__":
    unittest.main()
