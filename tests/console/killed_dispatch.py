"""Kills the server of the console in each phase of a dispatch to a simulated cell, and asks what became of the job.

    killed_dispatch.py QCHOPPER PROJECT.qch [KILLS]

The project holds a job. Phases: waiting for consent, carving, held. In each, the server is killed by SIGKILL so many
times (2), at a random moment of the phase; then a new server must show the job by the right state within 3 s, and at the
end the cell must have started it once: STARTS_TOTAL is what was ordered. The simulated cell is a process of its own, so
that it outlives the server, as a real one does.
"""

import http.client
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path

LIMIT_S = 3
PHASES = ["asks", "carving", "held"]


class Cell:
    """A simulated cell that asks for consent, and says yes when it is told to."""

    def __init__(self, program, folder):
        words = [program, "cell-sim", "--listen", "127.0.0.1:0", "--consent", "ask", "--drop", folder, "--json"]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = json.loads(self.process.stdout.readline())["listening"]
        self.program = program

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def status(self):
        words = [self.program, "cell", "status", "--to", self.address, "--json"]
        return json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout)

    def end(self):
        self.process.kill()
        self.process.wait()


class Server:
    def __init__(self, program, folder, address):
        words = [program, "serve", folder, "--listen", "127.0.0.1:0", "--to", address]
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        link = self.process.stdout.readline().strip()
        self.host = link.removeprefix("http://").split("/")[0]
        self.key = link.split("key=")[1]

    def ask(self, method, path, body=None, revision=None):
        """(status, document) of a request."""
        headers = {"Authorization": f"Bearer {self.key}", "Content-Type": "application/json"}
        headers["X-Request-Id"] = str(uuid.uuid4())
        if revision:
            headers["If-Match"] = f'"{revision}"'
        connection = http.client.HTTPConnection(self.host, timeout=30)
        connection.request(method, path, json.dumps(body) if body is not None else None, headers)
        answer = connection.getresponse()
        return answer.status, json.loads(answer.read())

    def state(self):
        return self.ask("GET", "/api/state")[1]

    def entry(self):
        queue = self.state()["queue"]
        return queue[-1] if queue else {"state": "none", "why": ""}

    def wait_for(self, states, limit_s):
        """The entry as soon as it is in one of the states; as it is at the end of the time."""
        end = time.monotonic() + limit_s
        entry = self.entry()
        while entry["state"] not in states and time.monotonic() < end:
            time.sleep(0.05)
            entry = self.entry()
        return entry

    def kill(self):
        self.process.kill()
        self.process.wait()


def hand_over(server, name):
    """Hands the first job of the project over, once the cell is read."""
    end = time.monotonic() + 20
    while time.monotonic() < end:
        state = server.state()
        project = next((p for p in state["projects"] if p["name"] == name), None)
        if project and any(cell["link"] == "connected" for cell in state["cells"]):
            break
        time.sleep(0.1)
    path = f"/api/projects/{project['id']}"
    status, answer = server.ask("POST", path + "/questions", {"jobs": {}})
    assert status == 200, answer
    piece = answer["document"]["jobs"][0]["piece"]
    body = {"pieces": [piece], "again": True, "accept_unreachable": True}
    status, plan = server.ask("POST", path + "/plans", body, answer["revision"])
    assert status == 201, plan
    status, answer = server.ask("POST", "/api/dispatches", {"plan": plan["plan"]})
    assert status == 202, answer
    again, answer = server.ask("POST", "/api/dispatches", {"plan": plan["plan"]})
    assert again == 409, "a plan was taken twice"


def cell_id(server):
    return next(cell for cell in server.state()["cells"] if cell["link"] == "connected")


def hold(server):
    status, answer = server.ask("POST", f"/api/cells/{cell_id(server)['id']}/commands", {"command": "hold"})
    assert status == 200 and answer["end"] == "done", answer


def bring_to(phase, server, cell):
    assert server.wait_for(["asks"], 30)["state"] == "asks"
    if phase == "asks":
        return
    cell.say("consent yes")
    assert server.wait_for(["carving"], 30)["state"] == "carving"
    if phase == "held":
        hold(server)
        assert server.wait_for(["held"], 10)["state"] == "held"


def kill_in(phase, program, project, chance):
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
            for _ in range(kills):
                fault = kill_in(phase, program, project, chance)
                if fault:
                    faults.append(fault)
            print(f"{phase}: {kills} kills, {len(faults)} faults so far", flush=True)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
