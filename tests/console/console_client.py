"""A simulated cell and the server of the console as processes, and requests to them; for tests and bench/console.py."""

import http.client
import json
import subprocess
import time
import uuid


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
        connection = http.client.HTTPConnection(self.host, timeout=120)
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
    end = time.monotonic() + 60
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
