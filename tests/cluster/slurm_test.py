"""Work on a real Slurm: two nodes on this machine, started for the test in a folder of its own, and ended with it.

    slurm_test.py PROGRAM CELL

A worker is killed, a task is requeued, one runs out of time, one out of memory, one is cancelled, a node and the
controller are restarted, one fails under GNU parallel; the jobs are those of one prepare, to the byte. Exit code 77 where
Slurm or munge is not installed; skipped where they do not start.
"""

import hashlib
import json
import os
import pwd
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM, CELL = Path(sys.argv[1]), Path(sys.argv[2])
DAEMONS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue")
SEARCHED = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
SHARDS = 2

CONF = """ClusterName=scratch
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthInfo=socket={folder}/munge/socket,cred_expire=5
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=1
JobAcctGatherParams=OverMemoryKill
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=2,bf_interval=2
ReturnToService=2
SlurmdTimeout=30
KillWait=3
EnforcePartLimits=ALL
NodeName=n[0-1] NodeHostname={host} NodeAddr=127.0.0.1 Port={node_ports} CPUs=1 RealMemory=1500
PartitionName=all Nodes=ALL Default=YES MaxTime=60
"""

def free_ports(count):
    """Ports in a row that nothing listens on."""
    for first in range(26900, 60000, count):
        try:
            for port in range(first, first + count):
                with socket.socket() as probe:
                    probe.bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
    raise AssertionError("no free ports")


def wait_until(what, holds, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if holds():
            return
        time.sleep(0.2)
    raise AssertionError(f"{what}: not within {seconds} s")


class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="qchopper-slurm-"))
        cls.daemons = {}
        cls.addClassCleanup(cls.end)
        for name in ("munge", "state", "log", "n0", "n1"):
            (cls.folder / name).mkdir(mode=0o700)
        key = cls.folder / "munge" / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        port = free_ports(3)
        host = socket.gethostname().split(".")[0]
        conf = cls.folder / "slurm.conf"
        conf.write_text(CONF.format(folder=cls.folder, host=host, port=port, user=pwd.getpwuid(os.getuid()).pw_name,
                                    node_ports=f"{port + 1}-{port + 2}"))
        cls.environment = dict(os.environ, PATH=SEARCHED, SLURM_CONF=str(conf))
        try:
            cls.start_all(key, conf)
        except AssertionError as error:  # a machine that lets no such daemon run says nothing of the program
            logs = "\n".join(file.read_text(errors="replace")[-500:] for file in sorted((cls.folder / "log").iterdir()))
            raise unittest.SkipTest(f"Slurm does not start here: {error}\n{logs}") from error
        cls.program("sample", "vertebra", "--faces", "2000", "-o", "v.ply")
        cls.program("prepare", "v.ply", "--units", "mm", "--scale", "0.35", "--cell", CELL, "-o", "whole.qch")

    @classmethod
    def start_all(cls, key, conf):
        munge = key.parent
        cls.commands = {
            "munged": ["munged", "--foreground", "--force", f"--key-file={key}", f"--socket={munge}/socket",
                       f"--pid-file={munge}/pid", f"--log-file={munge}/log", f"--seed-file={munge}/seed"],
            "slurmctld": ["slurmctld", "-D", "-f", str(conf)],
            "n0": ["slurmd", "-D", "-f", str(conf), "-N", "n0"],
            "n1": ["slurmd", "-D", "-f", str(conf), "-N", "n1"],
        }
        cls.start("munged")
        wait_until("munge", (munge / "socket").exists, 20)
        for name in ("slurmctld", "n0", "n1"):
            cls.start(name)
        cls.wait_for_nodes()

    @classmethod
    def wait_for_nodes(cls):
        wait_until("two idle nodes", lambda: cls.asked("sinfo", "-h", "-o", "%t %D") == "idle 2", 60)

    @classmethod
    def wait_for_controller(cls):
        """Which answers only if munge does. Nodes may be told to be away for some minutes after it was."""
        wait_until("the controller", lambda: "UP" in cls.asked("scontrol", "ping") and cls.asked("sinfo", "-h"), 60)

    @classmethod
    def start(cls, name):
        command = cls.commands[name]
        with (cls.folder / "log" / f"{name}.out").open("ab") as output:
            cls.daemons[name] = subprocess.Popen([shutil.which(command[0], path=SEARCHED), *command[1:]], stdout=output,
                                                 stderr=subprocess.STDOUT, env=cls.environment)

    @classmethod
    def kill(cls, name):
        cls.daemons[name].kill()
        cls.daemons[name].wait()

    @classmethod
    def end(cls):
        for daemon in reversed(cls.daemons.values()):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(cls.folder)

    @classmethod
    def asked(cls, *command):
        """What a command says; nothing if it fails."""
        result = subprocess.run([str(a) for a in command], capture_output=True, text=True, check=False, timeout=60,
                                cwd=cls.folder, env=cls.environment)
        return result.stdout.strip() if result.returncode == 0 else ""

    @classmethod
    def program(cls, *arguments):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                                timeout=300, cwd=cls.folder)
        if result.returncode not in (0, 1):
            raise AssertionError(f"{arguments} ended with {result.returncode}:\n{result.stderr}")
        return result.stdout

    def prepared(self, project, scale="0.35"):
        self.program("prepare", "v.ply", "--units", "mm", "--scale", scale, "--cell", CELL, "--items", "-o", project)

    def submit(self, project, *options, shards=SHARDS):
        return subprocess.run([PROGRAM, "submit", project, "--shards", str(shards), *options], capture_output=True,
                              text=True, check=False, timeout=60, cwd=self.folder, env=self.environment)

    def submitted(self, project, *options, shards=SHARDS):
        """The numbers of the array and of gather after it."""
        said = self.submit(project, *options, shards=shards)
        self.assertEqual(said.returncode, 0, said.stderr)
        found = re.search(r"jobs (\d+) and (\d+) are submitted", said.stderr)
        self.assertTrue(found, said.stderr)
        return found[1], found[2]

    def workers(self, project):
        """The processes that work on it."""
        found = []
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                words = (folder / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[:2] == [bytes(PROGRAM), b"work"] and str(self.folder / project).encode() in words:
                found.append(int(folder.name))
        return found

    def wait_for(self, jobs):
        wait_until(f"jobs {jobs}", lambda: self.asked("squeue", "-h", "-j", ",".join(jobs), "-o", "%t") == "", 150)

    def known_jobs(self):
        """What the controller knows of each job, with its files, which name the project. Those of other tests are among
        them: a controller that was killed may take one that has ended for one that runs."""
        known = self.asked("scontrol", "show", "jobs")
        self.assertTrue(known, "the controller answers")
        return known

    def results(self, project):
        return list((self.folder / project / "work" / "results").glob("*.programs"))

    def assert_same_jobs(self, project, whole="whole.qch"):
        """Those that gather wrote."""
        def jobs(name):
            files = sorted((self.folder / name / "jobs").iterdir())
            return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}

        self.assertGreaterEqual(len(jobs(whole)), 4)
        self.assertEqual(jobs(project), jobs(whole))

    def test_a_worker_that_is_killed_is_submitted_again(self):
        self.prepared("killed.qch")
        jobs = self.submitted("killed.qch")
        wait_until("a worker", lambda: self.workers("killed.qch"), 60)
        os.kill(self.workers("killed.qch")[0], signal.SIGKILL)
        self.wait_for(jobs)
        self.assertEqual(len(self.results("killed.qch")), 1, "the other went on")
        said = (self.folder / "killed.qch" / "work" / "gather.log").read_text()
        self.assertIn("no whole result of 1 piece", said)
        self.wait_for(self.submitted("killed.qch"))
        self.assertRegex((self.folder / "killed.qch" / "work" / "slurm.sh").read_text(), r"--array=\d --cpus")
        self.assert_same_jobs("killed.qch")
        self.assertIn("every result is there", self.submit("killed.qch").stderr)

    def test_a_task_is_requeued_and_a_node_restarted(self):
        self.prepared("re queued.qch")
        jobs = self.submitted("re queued.qch")
        wait_until("a worker", lambda: self.workers("re queued.qch"), 60)
        self.asked("scontrol", "requeue", f"{jobs[0]}_0")
        self.kill("n1")
        self.start("n1")
        self.wait_for(jobs)
        self.assert_same_jobs("re queued.qch")

    def test_the_controller_is_killed_and_restarted_while_a_task_runs(self):
        """After both jobs are in its saved state: what it takes in between is lost with it."""
        self.prepared("restarted.qch", "0.5")
        jobs = self.submitted("restarted.qch", shards=1)
        state = self.folder / "state" / "job_state"
        its_gather = b"restarted.qch/work/gather.log"  # the later of both; the state has those of other tests too
        wait_until("the saved state", lambda: state.exists() and its_gather in state.read_bytes(), 60)
        wait_until("a worker", lambda: self.workers("restarted.qch"), 60)
        self.kill("slurmctld")
        self.assertTrue(self.workers("restarted.qch"), "it goes on")
        self.start("slurmctld")
        self.wait_for_controller()
        self.wait_for(jobs)
        self.program("prepare", "v.ply", "--units", "mm", "--scale", "0.5", "--cell", CELL, "-o", "large.qch")
        self.assert_same_jobs("restarted.qch", "large.qch")

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed")
    def test_what_failed_under_gnu_parallel_is_resumed(self):
        self.prepared("parallel.qch")
        project = str(self.folder / "parallel.qch")
        log = self.folder / "parallel.log"
        words = ["parallel", "--will-cite", "--jobs", "2", "--joblog", str(log)]
        work = [str(PROGRAM), "work", project, "--threads", "1", "--shard", "{}/2", ":::", "0", "1"]
        first = subprocess.Popen([*words, *work], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until("two workers", lambda: len(self.workers("parallel.qch")) == 2, 60)
        os.kill(self.workers("parallel.qch")[0], signal.SIGKILL)
        self.assertEqual(first.wait(150), 1, "one failed")
        self.assertEqual(len(self.results("parallel.qch")), 1)
        again = subprocess.run([*words, "--resume-failed", *work], capture_output=True, check=False, timeout=150)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.program("gather", "parallel.qch")
        self.assert_same_jobs("parallel.qch")

    def failed(self, project):
        """The lines of failed.jsonl by their pieces."""
        text = (self.folder / project / "work" / "failed.jsonl").read_text()
        return {line["piece"]: line for line in map(json.loads, text.splitlines())}

    def test_what_runs_out_of_time_or_memory_or_is_cancelled_is_submitted_again(self):
        self.prepared("ended.qch")
        jobs = self.submitted("ended.qch")
        wait_until("two workers", lambda: len(self.workers("ended.qch")) == 2, 60)
        self.asked("scontrol", "update", f"JobId={jobs[0]}_0", "EndTime=now+1")
        self.asked("scancel", f"{jobs[0]}_1")
        self.wait_for(jobs)
        self.assertTrue(self.failed("ended.qch"))
        self.wait_for(self.submitted("ended.qch", "--", "--mem=20M"))
        failed = self.failed("ended.qch")
        self.assertTrue(failed)
        for line in failed.values():
            self.assertEqual(line["last"]["ended"], True, line)
            self.assertEqual(line["last"]["host"], socket.gethostname().split(".")[0], line)
        self.wait_for(self.submitted("ended.qch", "--retry"))
        self.assert_same_jobs("ended.qch")
        self.assertFalse((self.folder / "ended.qch" / "work" / "failed.jsonl").exists())

    def test_without_controller_or_munge_nothing_is_submitted(self):
        self.prepared("down.qch")
        for name in ("slurmctld", "munged"):
            self.kill(name)
            said = self.submit("down.qch")
            self.assertEqual(said.returncode, 69, said.stderr)
            self.assertIn("Slurm does not take it: s", said.stderr)
            self.start(name)
            self.wait_for_controller()
            self.assertNotIn("down.qch", self.known_jobs())

    def test_what_slurm_refuses_is_told_and_nothing_is_submitted(self):
        self.prepared("refused.qch")
        said = self.submit("refused.qch", "--", "--partition=none")
        self.assertEqual(said.returncode, 69)
        self.assertIn("nvalid partition", said.stderr)
        self.assertNotIn("refused.qch", self.known_jobs())


if __name__ == "__main__":
    lacking = [name for name in DAEMONS if shutil.which(name, path=SEARCHED) is None]
    if lacking:
        print(f"skipped: {', '.join(lacking)} not installed")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], "-v"])
