#!/usr/bin/env python3
"""How long the console of `qchopper serve` lets a person wait, beside the same by the command line, in one run.

    bench/console.py build/release/qchopper SCAN.ply UNITS CELL.toml

Prints a table in Markdown. The scan is checked, made a project, ranked, previewed and cut by requests as the page sends
them, and by commands; then the state is asked 3,000 times while a search runs, and 10,000 times after it, with eight
streams of events open.
"""

import http.client
import re
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "console"))
from console_client import Server  # noqa: E402

PLANE = "0,0.6,0.8,5.25"


def timed(call):
    begun = time.monotonic()
    result = call()
    return time.monotonic() - begun, result


def memory_mb(process, key="VmHWM"):
    text = Path(f"/proc/{process}/status").read_text()
    return int(re.search(rf"{key}:\s+(\d+)", text).group(1)) / 1000


def children(process):
    path = Path(f"/proc/{process}/task/{process}/children")
    return [int(child) for child in path.read_text().split()]


class Console(Server):
    def expect(self, method, path, body=None, revision=None):
        status, answer = self.ask(method, path, body, revision)
        assert status < 300, answer
        return answer

    def work(self, path, body, revision=None):
        """The result of a work, as soon as it is there."""
        name = self.expect("POST", path, body, revision)["work"]
        while True:
            work = next(w for w in self.state()["work"] if w["id"] == name)
            if work["state"] not in ("queued", "running"):
                assert work["state"] == "done", work
                return work["result"]
            time.sleep(0.02)

    def bytes_of(self, path):
        connection = http.client.HTTPConnection(self.host, timeout=60)
        connection.request("GET", path, headers={"Authorization": f"Bearer {self.key}"})
        return len(connection.getresponse().read())

    def ask_state(self, times):
        """Seconds of each of so many requests over one connection, sorted."""
        connection = http.client.HTTPConnection(self.host, timeout=60)
        seconds = []
        for _ in range(times):
            begun = time.monotonic()
            connection.request("GET", "/api/state", headers={"Authorization": f"Bearer {self.key}"})
            connection.getresponse().read()
            seconds.append(time.monotonic() - begun)
        return sorted(seconds)

    def open_stream(self):
        connection = http.client.HTTPConnection(self.host, timeout=600)
        connection.request("GET", "/api/events", headers={"Authorization": f"Bearer {self.key}"})
        answer = connection.getresponse()

        def read_to_the_end():
            try:
                answer.read()
            except (OSError, http.client.HTTPException):
                pass  # the server was ended

        threading.Thread(target=read_to_the_end, daemon=True).start()


class CommandLine:
    def __init__(self, program):
        self.program = program
        self.peak_mb = 0.0

    def run(self, *words):
        """Seconds, and the peak of memory of all commands so far is kept."""
        words = ["/usr/bin/time", "-f", "%M", self.program, *words]
        seconds, done = timed(lambda: subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))
        assert done.returncode == 0, done.stderr
        self.peak_mb = max(self.peak_mb, int(done.stderr.split()[-1]) / 1000)
        return seconds


def measure(program, scan, units, cell, folder):
    rows = []
    (folder / scan.name).symlink_to(scan.resolve())
    (folder / cell.name).write_bytes(cell.read_bytes())
    command = CommandLine(program)
    console = Console(program, str(folder), "127.0.0.1:9")
    listed = console.expect("GET", "/api/files")["scans"][0]["id"]

    begun = time.monotonic()
    check = console.work("/api/checks", {"scan": listed, "units": units})
    size = console.bytes_of(f"/api/meshes/{check['mesh']}")
    inspect = command.run("inspect", str(folder / scan.name), "--units", units)
    rows.append(("Check to the first picture", time.monotonic() - begun - inspect, "inspect", inspect))

    body = {"check": check["check"], "name": "bench", "units": units, "size_ok": True, "cell": cell.stem}
    project = "/api/projects/" + console.work("/api/projects", body)["project"]
    own = str(folder / "own.qch")
    command.run("segment", str(folder / scan.name), "--units", units, "--size-ok", "--cell", str(folder / cell.name), "-o", own)
    seconds, shown = timed(lambda: console.expect("GET", project))
    rows.append(("project opened, exact pieces", seconds, "segment", command.run("segment", own)))
    display = {"display": {}}
    rows.append(("its pieces drawn", timed(lambda: console.expect("POST", project + "/questions", display))[0], "", None))
    rows.append(("the same again", timed(lambda: console.expect("GET", project))[0], "", None))

    def question(body):
        return timed(lambda: console.expect("POST", project + "/questions", body))[0]

    rows.append(("planes ranked", question({"rank": {}}), "segment --step", command.run("segment", own, "--step")))
    tried = "fragility=2"
    by_command = command.run("segment", own, "--step", "--try-weights", tried)
    rows.append(("exact order by a new weight", question({"rank": {"weights": {"fragility": 2}}}), "the same", by_command))
    plane = [float(number) for number in PLANE.split(",")]
    by_command = command.run("segment", own, "--preview", PLANE)
    rows.append(("plane released to exact values", question({"preview": {"plane": plane}}), "segment --preview", by_command))
    cut = {"cut": {"plane": plane}}
    seconds, _ = timed(lambda: console.expect("POST", project + "/decisions", cut, shown["revision"]))
    rows.append(("cut by that plane", seconds, "segment --plane", command.run("segment", own, "--plane", PLANE)))
    worker = max(memory_mb(child) for child in children(console.process.pid))

    for _ in range(8):
        console.open_stream()
    revision = console.expect("GET", project)["revision"]
    console.expect("POST", project + "/work", {"kind": "search"}, revision)
    time.sleep(0.5)
    busy = console.ask_state(3000)
    console.ask_state(10_000)
    server = memory_mb(console.process.pid)
    console.kill()

    print("| what | console | command line | ratio |\n|---|---|---|---|")
    for what, seconds, name, by_command in rows:
        other = f"{name} {by_command:.2f} s" if by_command else ""
        ratio = f"{seconds / by_command:.2f}" if by_command else ""
        print(f"| {what} | {seconds:.2f} s | {other} | {ratio} |")
    print(f"| GET state, p99 of 3,000 beside a search and 8 streams | {1000 * busy[2970]:.1f} ms | | |")
    print(f"| picture of the scan | {size / 1000:.0f} kB | | |")
    print(f"| peak memory of the server | {server:.0f} MB | | |")
    print(f"| peak memory of the worker | {worker:.0f} MB | {command.peak_mb:.0f} MB | |")


def main():
    program, scan, units, cell = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        measure(str(Path(program).resolve()), Path(scan), units, Path(cell), Path(folder))


if __name__ == "__main__":
    main()
