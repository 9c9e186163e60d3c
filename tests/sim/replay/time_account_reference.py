#!/usr/bin/env python3
"""The machine time of a KUKA program by its text alone, to hold the account of the replay against.

    time_account_reference.py CELL.toml JOB     JOB is a job file, or a folder with the .src files of one

Prints a line for each kind of operation and tool: what is named in COLUMNS, then the operation. Nothing is shared with
the program: the text is split at blanks, corners are parabolas whose curvature comes from their derivatives. Left out:
limits of axes on straight moves, and the way from the end of a joint move to the first point of a chunk. A joint move
begins where the one before it ended, whatever lines are between them.
"""

import json
import math
import re
import sys
import tomllib
import zipfile
from pathlib import Path

COLUMNS = ["tool", "at_feed_s", "link_s", "acceleration_s", "joint_move_s", "tool_change_s", "at_feed_mm", "link_mm"]
COLUMNS += ["lines", "stops", "short_lines", "tool_changes"]
OPERATIONS = ["roughing", "finishing", "fine finishing", "drilling"]


def texts_of(job):
    """The lines of every source, by its name in lower case without ending."""
    if Path(job).is_dir():
        files = {path.name: path.read_text(encoding="ascii") for path in Path(job).iterdir() if path.suffix == ".src"}
    else:
        with zipfile.ZipFile(job) as package:
            files = {name: package.read(name).decode("ascii") for name in package.namelist() if name.endswith(".src")}
    return {name[:-4].lower(): text.splitlines() for name, text in files.items()}


def numbers(line):
    """The components of {X 1.0,Y 2.0}, by name."""
    return {name: float(value) for name, value in re.findall(r"([A-Z]\d?) (-?[\d.]+)", line[line.index("{") :])}


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def corner_speed(start, line, after):
    """At most, in the middle of the parabola between two lines; 0 where the tip stands."""
    before_mm, after_mm = math.dist(start, line["to"]), math.dist(line["to"], after["to"])
    side = min(line["rounding"], before_mm / 2, after_mm / 2)
    if side <= 0:
        return 0
    point = line["to"]
    first = [p + side * (s - p) / before_mm for p, s in zip(point, start)]
    last = [p + side * (e - p) / after_mm for p, e in zip(point, after["to"])]
    speed = min(line["feed"], after["feed"])
    slope = minus(last, first)
    bend = [2 * (f - 2 * p + l) for f, p, l in zip(first, point, last)]
    length = math.hypot(*slope)
    if length == 0:
        return 0
    curvature = math.hypot(*cross(slope, bend)) / length**3
    if curvature > 0:
        speed = min(speed, math.sqrt(min(line["acceleration"], after["acceleration"]) / curvature))
    return speed


def trapezoid(length, begin, end, top, acceleration):
    """Seconds from one speed to another, by the area under the speed."""
    if length == 0:
        return 0
    peak = math.sqrt((2 * acceleration * length + begin**2 + end**2) / 2)
    if peak <= top:
        return (peak - begin + peak - end) / acceleration
    ramps = (top**2 - begin**2 + top**2 - end**2) / (2 * acceleration)
    return (2 * top - begin - end) / acceleration + max(0, length - ramps) / top


class Replay:
    def __init__(self, cell):
        self.cell = cell
        program = cell["program"]
        self.cycle = program.get("interpolation_cycle", 0.012)
        self.change_s = program.get("tool_change_time", 60)
        self.window = {tool["number"]: tool["feed_mm_per_s"][1] for tool in cell["tool"]}
        self.change_call = program["tool_change"].removeprefix("call ").lower()
        self.joints = cell["start"]["joints_deg"]
        self.percent = {}
        self.rows = {}
        self.row = None
        self.asked = self.tool = None
        self.waiting_s = 0  # joint moves before the first chunk
        self.lines = []

    def run(self, sources):
        main = next(name for name, lines in sources.items() if any("#INITMOV" in line.upper() for line in lines))
        for line in sources[main]:
            called = re.match(r"(\w+)\(\s*(\d*)\s*\)", line)
            if line.startswith(";ASK"):
                asked = re.match(r";ASK tool (\d+) ", line)
                self.asked = int(asked[1]) if asked else self.asked
            elif re.match(r'\w+_ask\("Put tool \d+ ', line):
                self.asked = int(re.search(r"\d+", line.partition("tool ")[2])[0])
            elif called and called[1].lower() == self.change_call:
                self.asked = int(called[2])
            elif called and called[1].lower() in sources:
                self.chunk(sources[called[1].lower()])
            else:
                self.step(line)

    def chunk(self, lines):
        words = next((line[11:] for line in lines if line.startswith(";operation ")), "")
        key = (words if words in OPERATIONS else "unknown", self.asked)
        self.row = self.rows.setdefault(key, dict.fromkeys(COLUMNS, 0) | {"tool": self.asked})
        if self.asked != self.tool:
            self.row["tool_changes"] += 1
            self.row["tool_change_s"] += self.change_s
        self.tool = self.asked
        self.row["joint_move_s"] += self.waiting_s
        self.waiting_s = 0
        for line in lines:
            self.step(line)
        self.flush()

    def step(self, line):
        value = line.partition("=")[2].strip()
        if line.startswith("PTP"):
            self.joint_move(numbers(line))
        elif line.startswith("LIN"):
            to = [numbers(line)[axis] for axis in "XYZ"]
            rounding = self.rounding if line.endswith("C_DIS") else 0
            self.lines.append({"to": to, "feed": self.feed, "acceleration": self.acceleration, "rounding": rounding})
        elif line.startswith("$VEL.CP"):
            self.feed = 1000 * float(value)
        elif line.startswith("$ACC.CP"):
            self.acceleration = 1000 * float(value)
        elif line.startswith("$APO.CDIS"):
            self.rounding = float(value)
        elif line.startswith(("$VEL_AXIS", "$ACC_AXIS")):
            self.percent[line[1:4], int(line[10])] = float(value) / 100

    def joint_move(self, target):
        self.flush()
        longest = 0
        for axis in range(6):
            way = abs(target[f"A{axis + 1}"] - self.joints[axis])
            speed = self.cell["robot"]["speed_deg_per_s"][axis] * self.percent["VEL", axis + 1]
            acceleration = self.cell["robot"]["acceleration_deg_per_s2"][axis] * self.percent["ACC", axis + 1]
            longest = max(longest, trapezoid(way, 0, 0, speed, acceleration))
        self.joints = [target[f"A{axis + 1}"] for axis in range(6)]
        if self.row:
            self.row["joint_move_s"] += longest
        else:
            self.waiting_s += longest

    def flush(self):
        """Takes the lines since the last joint move; the first one has no length."""
        lines, self.lines = self.lines, []
        starts = [line["to"] for line in lines[:1]] + [line["to"] for line in lines[:-1]]
        lengths = [math.dist(start, line["to"]) for start, line in zip(starts, lines)]
        speeds = [0] * (len(lines) + 1)  # where line i begins
        for i in range(len(lines) - 1):
            corner = corner_speed(starts[i], lines[i], lines[i + 1])
            speeds[i + 1] = min(corner, math.sqrt(speeds[i] ** 2 + 2 * lines[i]["acceleration"] * lengths[i]))
        for i in range(len(lines) - 1, -1, -1):
            most = math.sqrt(speeds[i + 1] ** 2 + 2 * lines[i]["acceleration"] * lengths[i])
            speeds[i] = min(speeds[i], most)
        for i, (line, length) in enumerate(zip(lines, lengths)):
            moving = trapezoid(length, speeds[i], speeds[i + 1], line["feed"], line["acceleration"])
            kind = "link" if line["feed"] > 1.001 * self.window[self.tool] else "at_feed"
            self.row[kind + "_s"] += length / line["feed"]
            self.row[kind + "_mm"] += length
            self.row["acceleration_s"] += max(moving, self.cycle) - length / line["feed"]
            self.row["lines"] += 1
            self.row["stops"] += speeds[i + 1] == 0
            self.row["short_lines"] += length < line["feed"] * self.cycle


def main(cell_file, job):
    replay = Replay(tomllib.loads(Path(cell_file).read_text(encoding="utf-8")))
    replay.run(texts_of(job))
    for (operation, _), row in replay.rows.items():
        print(*(json.dumps(row[column]) for column in COLUMNS), operation)


if __name__ == "__main__":
    main(*sys.argv[1:])
