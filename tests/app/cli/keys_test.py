"""Keys and signatures as a person uses them: passphrases, key files that are refused, and a cell that requires signatures.

keys_test.py PROGRAM
"""

import json
import os
import pty
import select
import signal
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = Path(sys.argv.pop(1)).resolve()
LONGEST_S = 600
USE, MISSING, CREATE, CONFIG, BROKEN = 64, 66, 73, 78, 1


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="qchopper-keys-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.environment = dict(os.environ, XDG_STATE_HOME=str(self.folder / "state"), TERM="dumb")
        self.keys = self.folder / "state" / "qchopper" / "keys"

    def run_here(self, *arguments, passphrase=None):
        """With a passphrase the words end in a descriptor from which one line can be read, and a second one."""
        words = [str(PROGRAM), *map(str, arguments)]
        descriptors = ()
        if passphrase is not None:
            read, write = os.pipe()
            os.write(write, passphrase.encode() + b"\nnext line\n")
            os.close(write)
            words += ["--passphrase-fd", str(read)]
            descriptors = (read,)
        ended = subprocess.run(words, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, pass_fds=descriptors,
                               start_new_session=True, capture_output=True, text=True, timeout=LONGEST_S, check=False)
        if descriptors:
            self.left = os.read(descriptors[0], 100)
            os.close(descriptors[0])
        return ended

    def expect(self, code, *arguments, says=(), **more):
        ended = self.run_here(*arguments, **more)
        text = ended.stdout + ended.stderr
        self.assertEqual(ended.returncode, code, text)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, text)
        return ended

    def make(self, name):
        self.expect(0, "keys", "make", name, "--no-passphrase")
        return self.keys / f"{name}.key"


class Typed:
    """A command on a terminal of its own; each question is answered by the next line."""

    def __init__(self, words, environment, answers):
        self.output = ""
        child, terminal = pty.fork()
        if child == 0:
            os.execvpe(words[0], words, environment)
        questions = 0
        began = time.monotonic()
        while time.monotonic() < began + LONGEST_S:
            if terminal not in select.select([terminal], [], [], 0.1)[0]:
                continue
            try:
                got = os.read(terminal, 65536)
            except OSError:
                break
            self.output = (self.output + got.decode(errors="replace")).replace("\r\n", "\n")
            while self.output.count(": \n") + self.output.endswith(": ") > questions and questions < len(answers):
                os.write(terminal, answers[questions].encode() + b"\n")
                questions += 1
        else:
            os.kill(child, signal.SIGKILL)
        self.took_s = time.monotonic() - began
        self.questions = questions
        self.code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        os.close(terminal)


class Passphrases(InFolder):
    def typed(self, *arguments, answers):
        return Typed([str(PROGRAM), *map(str, arguments)], self.environment, answers)

    def test_a_new_key_asks_twice_and_shows_nothing_that_is_typed(self):
        made = self.typed("keys", "make", "anna", answers=["correct horse", "correct horse"])
        self.assertEqual(made.code, 0, made.output)
        self.assertNotIn("horse", made.output)
        self.assertIn("ENCRYPTED PRIVATE KEY", (self.keys / "anna.key").read_text())
        self.assertEqual((self.keys / "anna.key").stat().st_mode & 0o7777, 0o600)
        differ = self.typed("keys", "make", "otto", answers=["correct horse", "incorrect horse"])
        self.assertEqual(differ.code, USE, differ.output)
        self.assertFalse((self.keys / "otto.key").exists())

    def test_a_wrong_one_takes_a_second_and_is_asked_for_three_times(self):
        self.expect(0, "keys", "make", "anna", passphrase="correct horse")
        ended = self.typed("keys", "sign", "none.qjob", "--key", "anna", answers=["a", "b", "c", "correct horse"])
        self.assertEqual((ended.code, ended.questions), (USE, 3), ended.output)
        self.assertGreaterEqual(ended.took_s, 3)
        self.assertIn("is wrong", ended.output)

    def test_by_a_descriptor_there_is_one_try(self):
        self.expect(0, "keys", "make", "anna", passphrase="correct horse")
        began = time.monotonic()
        self.expect(USE, "keys", "sign", "none.qjob", "--key", "anna", passphrase="wrong",
                    says="the passphrase of " + str(self.keys / "anna.key") + " is wrong")
        self.assertGreaterEqual(time.monotonic() - began, 1)
        self.assertEqual(self.left, b"next line\n")  # a second line was not read
        # With the right one the command comes as far as its input.
        self.expect(MISSING, "keys", "sign", "none.qjob", "--key", "anna", passphrase="correct horse")

    def test_nobody_there_to_ask_is_said(self):
        self.expect(0, "keys", "make", "anna", passphrase="correct horse")
        self.expect(USE, "keys", "sign", "none.qjob", "--key", "anna", says="--passphrase-fd")
        self.expect(USE, "keys", "sign", "none.qjob", "--key", "anna", "--passphrase-fd", "77", says="descriptor 77")
        self.expect(USE, "keys", "make", "otto", passphrase="", says="the passphrase is empty")

    def test_no_option_takes_a_passphrase(self):
        for words in (["keys", "make"], ["keys", "sign"], ["dispatch"]):
            self.expect(USE, *words, "X", "--passphrase", "secret")


class KeyFiles(InFolder):
    def refused(self, file, says, code=CONFIG):
        self.expect(code, "keys", "sign", "none.qjob", "--key", file, says=says)

    def test_what_is_no_private_key_of_this_user_alone_is_refused(self):
        key = self.make("anna")
        text = key.read_text()
        other = self.folder / "other.key"

        def put(content, mode=0o600):
            other.write_text(content)
            other.chmod(mode)

        self.refused(self.folder / "none.key", "cannot be opened", MISSING)
        put("")
        self.refused(other, "it is empty")
        put(text[:60])
        self.refused(other, "cut short")
        put((self.keys / "anna.pub").read_text())
        self.refused(other, "of another kind")
        put(text, 0o644)
        self.refused(other, "other users may have read it (mode 0644)")
        other.unlink()
        other.symlink_to(key)
        self.refused(other, "symbolic link")
        project = self.folder / "p.qch"
        project.mkdir()
        (project / "project.json").write_text("{}")
        shutil.copy(key, project / "anna.key")
        self.refused(project / "anna.key", "lies in the project")
        self.expect(CONFIG, "keys", "make", project / "new", "--no-passphrase", says="lies in the project")

    def test_a_key_is_made_trusted_and_revoked_once(self):
        key = self.make("anna")
        before = key.read_text()
        self.expect(USE, "keys", "make", "anna", "--no-passphrase", says="another key with the name anna")
        self.assertEqual(key.read_text(), before)
        office = ["--keys", self.folder / "office.json"]
        self.expect(0, "keys", "trust", self.keys / "anna.pub", *office)
        shown = json.loads(self.expect(0, "keys", "show", "--json", *office).stdout)
        self.assertEqual([row["name"] for row in shown["trusted"]], ["anna"])
        self.expect(0, "keys", "revoke", shown["trusted"][0]["key_id"], *office)
        self.expect(0, "keys", "show", *office, says="REVOKED on")
        self.expect(USE, "keys", "trust", self.keys / "anna.pub", *office, says="was revoked, and that is final")
        self.expect(CONFIG, "keys", "trust", key, *office, says="no public Ed25519 key") if "PUBLIC" not in before else None
        (self.folder / "office.json").write_text("{")
        self.expect(CONFIG, "keys", "show", *office, says="is not a list of trusted keys")


class StrictCell(InFolder):
    """A project whose cell file requires signatures, and a simulated cell of that file."""

    @classmethod
    def setUpClass(cls):
        cls.shared = Path(tempfile.mkdtemp(prefix="qchopper-keys-shared-"))
        text = (ROOT / "cells" / "foam-1.toml").read_text().replace("\nid = ", "\nrequire_signature = true\nid = ", 1)
        (cls.shared / "strict.toml").write_text(text)
        for words in (["sample", "vertebra", "--faces", "2000", "-o", "v.ply"],
                      ["prepare", "v.ply", "--units", "mm", "--cell", "strict.toml", "--min-cuts", "1", "-o", "v.qch"]):
            subprocess.run([PROGRAM, *words], cwd=cls.shared, check=True, capture_output=True, timeout=LONGEST_S)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.shared / "v.qch", self.folder / "v.qch")
        (self.folder / "drop").mkdir()
        self.make("anna")
        self.list = self.folder / "cell-keys.json"
        self.expect(0, "keys", "trust", self.keys / "anna.pub", "--keys", self.list)
        self.jobs = sorted((self.folder / "v.qch" / "jobs").glob("*.qjob"))
        self.cell = subprocess.Popen([PROGRAM, "cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed", "100000",
                                      "--cell", self.shared / "strict.toml", "--keys", self.list],
                                     cwd=self.folder, env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end_cell)
        self.to = self.cell.stdout.readline().split()[1]

    def end_cell(self):
        self.cell.terminate()
        self.cell.communicate(timeout=60)

    def dispatch(self, code, *more, says=()):
        return self.expect(code, "dispatch", "v.qch", "--to", self.to, "--drop", "drop", "--accept-unreachable",
                           "--accept-workholding", *more, says=says)

    def sign(self, key="anna"):
        self.expect(0, "keys", "sign", "v.qch", "--key", key)

    def test_signed_by_a_trusted_key_the_jobs_run(self):
        self.sign()
        self.expect(0, "keys", "check", *self.jobs, says="signed by a trusted key")
        self.dispatch(0, "--key", "anna", says="ended complete on the simulated cell")

    def test_unsigned_jobs_and_tickets_are_refused(self):
        self.dispatch(BROKEN, "--key", "anna", says="it is not signed, and the cell requires a signature")
        self.expect(BROKEN, "verify", "v.qch", says="Signature REFUSED: it is not signed")
        self.expect(BROKEN, "keys", "check", *self.jobs, says="it is not signed")
        self.sign()
        self.dispatch(BROKEN, says="the cell requires signed tickets: pass --key NAME")

    def test_an_untrusted_and_a_revoked_key_are_refused(self):
        stranger = self.folder / "stranger.json"
        self.expect(0, "keys", "make", "otto", "--no-passphrase", "--keys", stranger)
        self.sign("otto")
        self.dispatch(BROKEN, "--key", "anna", says="which is not trusted here")
        self.sign()
        self.dispatch(BROKEN, "--key", "otto", says="is not trusted here")
        # What the PC trusts, the cell does not.
        self.expect(0, "keys", "trust", self.keys / "otto.pub")
        self.dispatch(BROKEN, "--key", "otto", says=("NOT STARTED", "UNKNOWN_KEY"))
        self.expect(0, "keys", "revoke", "anna", "--keys", self.list)
        self.dispatch(BROKEN, "--key", "anna", says=("NOT STARTED", "the key of the signature is revoked"))
        self.expect(0, "keys", "revoke", "anna")
        self.dispatch(BROKEN, "--key", "anna", says="which was revoked on")

    def test_a_signature_of_another_job_or_cell_or_time_or_cut_off_is_refused(self):
        self.sign()
        beside = self.jobs[0].with_suffix(".signature.json")
        good = beside.read_text()
        other = json.loads(good)

        def refused(text, says):
            beside.write_text(text)
            self.dispatch(BROKEN, "--key", "anna", says=says)
            self.expect(BROKEN, "keys", "check", self.jobs[0], says=says)

        refused(good[:100], "cut short")
        refused("", "is empty")
        refused(good.replace(other["signature"], other["signature"][:60]), "signature is cut off: it has 60 of 128 digits")
        refused(good.replace(other["job_sha256"], "0" * 64), "changed after signing")
        self.expect(BROKEN, "keys", "check", self.jobs[-1], "--cell-id", 9, says="this is cell 9")
        beside.write_text(good)
        self.expect(0, "keys", "check", self.jobs[0])


if __name__ == "__main__":
    unittest.main()
