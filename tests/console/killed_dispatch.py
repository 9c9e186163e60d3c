"""Kills the server of the console in each phase of a dispatch to a simulated cell, and asks what became of the job.

    killed_dispatch.py QCHOPPER PROJECT.qch [KILLS]

The project holds a job. Phases: waiting for consent, carving, held. In each, the server is killed by SIGKILL so many
times (2), at a random moment of the phase; then a new server must show the job by the right state, and at the end the
cell must have started it once: STARTS_TOTAL is what was ordered. The simulated cell is a process of its own, so
that it outlives the server, as a real one does.
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from console_client import Cell, Server, hand_over, hold

LIMIT_S = 60  # for a machine with much else to do; what it took is printed, beside the target of 3 s
PHASES = ["asks", "carving", "held"]


def bring_to(phase, server, cell):
    assert server.wait_for(["asks"], LIMIT_S)["state"] == "asks"
    if phase == "asks":
        return
    cell.say("consent yes")
    assert server.wait_for(["carving"], LIMIT_S)["state"] == "carving"
    if phase == "held":
        hold(server)
        assert server.wait_for(["held"], LIMIT_S)["state"] == "held"


def kill_in(phase, program, project, chance, waits):
    """One dispatch whose server is killed in a phase; returns the fault, or nothing."""
    with tempfile.TemporaryDirectory() as state, tempfile.TemporaryDirectory() as drop:
        os.environ["XDG_STATE_HOME"] = state
        cell = Cell(program, drop)
        server = Server(program, str(project.parent), cell.address)
        try:
            hand_over(server, project.name)
            bring_to(phase, server, cell)
            time.sleep(chance.random())
            server.kill()
            server = Server(program, str(project.parent), cell.address)
            begun = time.monotonic()
            entry = server.wait_for([phase], LIMIT_S)
            waits.append(time.monotonic() - begun)
            if entry["state"] != phase:
                return f"{phase}: after {time.monotonic() - begun:.1f} s the new server says {entry['state']} ({entry['why']})"
            ordered = 0 if phase == "asks" else 1
            starts = cell.status()["store"]["starts_total"]
            return None if starts == ordered else f"{phase}: {starts} starts, and {ordered} ordered"
        finally:
            server.kill()
            cell.end()
            subprocess.run(["pkill", "-f", f"dispatch {project}"], check=False)


def main():
    program, given = sys.argv[1], Path(sys.argv[2])
    kills = int(sys.argv[3]) if len(sys.argv) > 3 else 2
    chance = random.Random(1)
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder) / "killed.qch"
        shutil.copytree(given, project)
        for phase in PHASES:
            waits = []
            for _ in range(kills):
                fault = kill_in(phase, program, project, chance, waits)
                if fault:
                    faults.append(fault)
            print(f"{phase}: {kills} kills, {len(faults)} faults so far; right after {max(waits, default=0):.1f} s at most, target 3 s", flush=True)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
