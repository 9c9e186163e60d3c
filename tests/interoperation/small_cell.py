"""A small cell on pymodbus 3.0, written from docs/user/cell-integration.md and the register map that it names, and from
nothing else: addresses, numbers of results and the table of the machine are read from the text of that map.

  small_cell.py MAP STORE    prints "listening 127.0.0.1:PORT"; STORE is the file of its lasting memory

It gives consent by itself, moves nothing, and carves a job in a tenth of a second.
"""

import asyncio
import hashlib
import json
import os
import re
import secrets
import signal
import socket
import sys
import time
import zlib

from pymodbus.datastore import ModbusServerContext
from pymodbus.interfaces import IModbusSlaveContext
from pymodbus.server.async_io import ModbusTcpServer

HOLDING, INPUT, WRITE = 3, 4, 16
NONE, STORED, PREPARED, RUNNING, INTERRUPTED, ENDED, ABORTED_JOB, CANCELLED_JOB = range(8)


class Map:
    """The tables of registers.md."""

    def __init__(self, path):
        self.blocks, self.results, self.machine, self.done = {}, {}, {}, {}
        block = columns = None
        for line in open(path, encoding="utf-8"):
            heading = re.match(r"## (\w+)(.*)", line)
            if heading:
                block, columns = heading[1] if ":" in heading[2] else None, None
            base = re.match(r"(Input|Holding) registers.*base (\d+), (\d+) registers", line)
            if base:
                self.blocks[block] = {"input": base[1] == "Input", "base": int(base[2]), "count": int(base[3])}
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if block and re.match(r"\d+(-\d+)?$", cells[0]) and len(cells) == 4:
                first, last = (cells[0].split("-") * 2)[:2]
                self.blocks[block][cells[2]] = (int(first) - self.blocks[block]["base"], int(last) - int(first) + 1)
            if cells[0].startswith("0x") and len(cells) == 3:
                self.results[cells[1]] = int(cells[0], 16)
            if cells[0] == "state" and "Reset 1" in cells:
                columns = [int(re.search(r"\d+$", cell)[0]) for cell in cells[1:-1]]
            row = re.match(r"(\d+) (\w+)$", cells[0])
            if columns and row:
                self.machine[row[2]] = dict(zip(columns, cells[1:-1]), number=int(row[1]))
                self.done[row[2]] = cells[-1]


def words_of(data):
    return [int.from_bytes(data[i : i + 2], "big") for i in range(0, len(data), 2)]


def bytes_of(words):
    return b"".join(word.to_bytes(2, "big") for word in words)


class Block:
    """Registers of one block, by the names of their fields."""

    def __init__(self, table, words=None):
        self.table = table
        self.words = list(words) if words is not None else [0] * table["count"]

    def __getitem__(self, field):
        at, count = self.table[field]
        return int.from_bytes(bytes_of(self.words[at : at + count]), "big")

    def __setitem__(self, field, value):
        at, count = self.table[field]
        data = value if isinstance(value, bytes) else int(value).to_bytes(2 * count, "big")
        self.words[at : at + count] = words_of(data)

    def raw(self, field):
        at, count = self.table[field]
        return bytes_of(self.words[at : at + count])

    def crc(self, field):
        return zlib.crc32(bytes_of(self.words[: self.table[field][0]]))


class Cell:
    def __init__(self, register_map, path):
        self.map, self.path = register_map, path
        self.result_of = register_map.results
        self.state = self.before = "Stopped"
        self.since = self.boot = time.monotonic()
        self.acks, self.ack, self.lease = {}, {}, None
        self.ticket, self.job = Block(self.map.blocks["TICKET"]), None
        self.job_state, self.job_result, self.sha = NONE, 0, bytes(32)
        self.token = self.old_token = 0
        self.token_until = 0.0
        self.transfer, self.transfer_result, self.file = 0, 0, b""
        self.bad_frames = self.bad_reason = self.snap = 0
        self.answer = Block(self.map.blocks["RESULT"])
        self.power_up()

    # --- memory ---

    def power_up(self):
        if os.path.exists(self.path):
            self.store = json.load(open(self.path, encoding="utf-8"))
        else:
            self.store = {"id": secrets.token_hex(16), "created": int(time.time() * 1000), "boots": 0, "epoch": 0,
                          "starts": 0, "jobs": {}, "grants": {}}
        self.store["boots"] += 1
        for job in self.store["jobs"].values():
            if job["state"] in (RUNNING, INTERRUPTED):
                job.update(state=ABORTED_JOB, result=4)  # it never goes on by itself
                self.state = self.before = "Aborted"
        self.save()

    def save(self):
        with open(self.path + ".new", "w", encoding="utf-8") as out:
            json.dump(self.store, out)
            out.flush()
            os.fsync(out.fileno())
        os.replace(self.path + ".new", self.path)

    # --- time ---

    def go(self, state):
        self.before, self.state, self.since = self.state, state, time.monotonic()

    def pass_time(self):
        now = time.monotonic()
        while self.map.done[self.state] and now - self.since >= 0.1:
            self.go(self.map.done[self.state])
            if self.state == "Complete" and self.is_active():
                self.end_job(ENDED, 1)
            if self.state == "Stopped" and self.is_active():
                self.end_job(ABORTED_JOB, 2)
        if self.lease and now >= self.lease["until"]:
            self.lease = None
            self.drop_token()
        if self.token and now >= self.token_until:
            self.drop_token()

    # --- the job ---

    def is_active(self):
        return self.job_state in (RUNNING, INTERRUPTED)

    def is_current(self, job_id):
        return self.job_state != NONE and self.job.raw("JOB_ID") == job_id

    def end_job(self, how, result):
        self.job_state, self.job_result = how, result
        self.store["jobs"][self.job.raw("JOB_ID").hex()].update(state=how, result=result, end=int(time.time() * 1000))
        self.save()

    def drop_token(self):
        if self.job_state == PREPARED:
            self.job_state, self.old_token = STORED, self.token
        self.token = 0

    def drop_job(self):
        self.drop_token()
        self.job, self.job_state, self.job_result, self.sha = None, NONE, 0, bytes(32)
        self.transfer, self.transfer_result, self.file = 0, 0, b""

    def other_job(self, job_id):
        known = self.store["jobs"].get(job_id.hex())
        if not known:
            return "UNKNOWN_JOB" if self.job_state == NONE else "WRONG_JOB"
        return "CANCELLED" if known["state"] == CANCELLED_JOB else "ALREADY_FINISHED"

    # --- commands: a name of the table of results, or that and ACK_DETAIL ---

    def claim(self, c):
        epoch, held = c["EPOCH"], self.store["epoch"]
        if epoch <= held:
            return "STALE_EPOCH", held
        if epoch - held > 1 << 20:
            return "EPOCH_JUMP", held
        if self.lease and (self.lease["owner"], self.lease["secret"]) != (c["OWNER"], c["ARG1"]):
            return "LEASE_BUSY", self.lease["owner"]
        grant = secrets.randbelow(0xFFFFFFFF) + 1
        self.store["epoch"] = epoch
        self.store["grants"][str(grant)] = epoch
        self.save()
        self.drop_token()
        now = time.monotonic()
        self.lease = {"owner": c["OWNER"], "secret": c["ARG1"], "until": now + 5, "heard": now, "counter": None}
        return "OK", grant

    def release(self, _):
        self.drop_token()
        self.lease = None
        return "OK"

    def wrong_field(self):
        t = self.ticket
        wrong = {"TICKET_VERSION": t["TICKET_VERSION"] != 1, "FILE_SIZE": t["FILE_SIZE"] == 0,
                 "TRANSFER": t["TRANSFER"] != 2,
                 "FILE_NAME": not re.match(rb"[A-Za-z0-9_-][A-Za-z0-9._-]*\0*$", t.raw("FILE_NAME")),
                 "UNIT": t["UNIT"] != 1, "MATERIAL": t["MATERIAL"] > 4, "TOOL_DIAMETER": t["TOOL_DIAMETER"] == 0,
                 "PIECE_NO": not 1 <= t["PIECE_NO"] <= t["PIECE_COUNT"], "ON_LINK_LOSS": t["ON_LINK_LOSS"] > 1,
                 "REQUIREMENTS": t["REQUIREMENTS"] > 1, "CELL_ID": t["CELL_ID"] != 0xFFFF,
                 "MADE_FOR": t["MADE_FOR"] != 1}
        for field, is_wrong in wrong.items():
            if is_wrong:
                return self.map.blocks["TICKET"]["base"] + self.map.blocks["TICKET"][field][0]
        return 191 if any(t.words[91:93]) else 197 if t.words[97] else 0

    def store_job(self, c):
        t, job_id = self.ticket, self.ticket.raw("JOB_ID")
        if not any(t.words):
            return "NO_TICKET"
        if t.crc("CRC") != t["CRC"]:
            return "TICKET_CRC"
        if not any(job_id) or job_id != c.raw("JOB_ID"):
            return "TICKET_FIELD", self.map.blocks["TICKET"]["base"] + self.map.blocks["TICKET"]["JOB_ID"][0]
        known = self.store["jobs"].get(job_id.hex())
        if known:
            return "CANCELLED" if known["state"] == CANCELLED_JOB else "JOB_ID_REUSED"
        if self.is_current(job_id):
            return "ALREADY" if self.job.words == t.words else "JOB_ID_REUSED"
        if self.job_state != NONE:
            return "BUSY_OTHER_JOB"
        if self.state != "Idle":
            return "WRONG_STATE"
        if self.wrong_field():
            return "TICKET_FIELD", self.wrong_field()
        if t.raw("FILE_SHA256") != c.raw("FILE_SHA256"):
            return "HASH_MISMATCH"
        self.job, self.job_state, self.job_result = Block(t.table, t.words), STORED, 0
        self.transfer, self.transfer_result, self.file = 1, 0, b""
        return "OK"

    def why_unfit(self, c):
        job_id = c.raw("JOB_ID")
        if not self.is_current(job_id):
            return self.other_job(job_id)
        if self.job_state >= ENDED:
            return "ALREADY_FINISHED"
        if self.job_state == PREPARED:
            return "ALREADY"
        if self.state != "Idle" or self.job_state != STORED:
            return "WRONG_STATE"
        return "" if c.raw("FILE_SHA256") == self.job.raw("FILE_SHA256") else "HASH_MISMATCH"

    def verify(self, c):
        why = self.why_unfit(c)
        if why:
            return why
        if len(self.file) < self.job["FILE_SIZE"]:
            return "FILE_MISSING"
        self.sha = hashlib.sha256(self.file).digest()
        if self.sha != self.job.raw("FILE_SHA256"):
            self.file = b""
            return "HASH_MISMATCH"
        self.transfer = 2
        return "OK"

    def prepare(self, c):
        why = self.why_unfit(c)
        if why:
            return why
        if self.transfer != 2:
            return "FILE_MISSING"
        if self.job["REQUIREMENTS"] or c["ARG0"]:
            return "REHEARSAL_REQUIRED"
        self.token, self.token_until = secrets.randbelow(0xFFFFFFFF) + 1, time.monotonic() + 120
        self.job_state = PREPARED  # here the operator would be asked: PENDING until then
        return "OK"

    def start(self, c):
        job_id = c.raw("JOB_ID")
        if not self.is_current(job_id):
            return self.other_job(job_id)
        if self.is_active():
            return "ALREADY"
        if self.job_state >= ENDED:
            return "ALREADY_FINISHED"
        if self.state != "Idle":
            return "WRONG_STATE"
        if self.job_state != PREPARED or c["TOKEN"] != self.token:
            return "TOKEN_EXPIRED" if c["TOKEN"] and c["TOKEN"] == self.old_token else "TOKEN_BAD"
        if c.raw("FILE_SHA256") != self.job.raw("FILE_SHA256"):
            return "HASH_MISMATCH"
        self.store["jobs"][job_id.hex()] = {"state": RUNNING, "result": 0, "starts": 1, "epoch": c["EPOCH"],
                                            "seq": c["CMD_SEQ"], "start": int(time.time() * 1000), "end": 0,
                                            "sha": self.sha.hex()}
        self.store["starts"] += 1
        self.save()  # before anything moves
        self.token, self.job_state = 0, RUNNING
        self.go("Starting")
        return "OK"

    def cancel(self, c):
        job_id = c.raw("JOB_ID")
        if not self.is_current(job_id):
            known = self.other_job(job_id)
            return {"CANCELLED": "ALREADY", "WRONG_JOB": "UNKNOWN_JOB"}.get(known, known)
        if self.job_state >= ENDED:
            return "ALREADY_FINISHED"
        if self.job_state > PREPARED:
            return "WRONG_STATE"
        self.store["jobs"][job_id.hex()] = {"state": CANCELLED_JOB, "result": 0, "starts": 0, "epoch": 0, "seq": 0,
                                            "start": 0, "end": 0, "sha": bytes(32).hex()}
        self.save()
        self.drop_job()
        return "OK"

    def clear_result(self, c):
        if not self.is_current(c.raw("JOB_ID")):
            is_known = self.other_job(c.raw("JOB_ID")) in ("CANCELLED", "ALREADY_FINISHED")
            return "ALREADY" if is_known else "UNKNOWN_JOB"
        if self.job_state < ENDED:
            return "WRONG_STATE"
        self.drop_job()
        return "OK"

    def fill_answer(self, c, job_id, known, grant_epoch):
        a = self.answer = Block(self.map.blocks["RESULT"])
        a["JOB_ID"] = job_id
        if known:
            a["JOB_STATE"], a["JOB_RESULT"], a["STARTS"] = known["state"], known["result"], known["starts"]
            a["START_EPOCH"], a["START_SEQ"] = known["epoch"], known["seq"]
            a["START_TIME"], a["END_TIME"] = known["start"], known["end"]
            a["FILE_SHA256"] = bytes.fromhex(known["sha"])
        if self.is_current(job_id):
            a["JOB_STATE"], a["JOB_RESULT"], a["FILE_SHA256"] = self.job_state, self.job_result, self.sha
        a["QUERY_SEQ"], a["QUERY_OWNER"], a["GRANT_EPOCH"] = c["CMD_SEQ"], c["OWNER"], grant_epoch
        a["CRC"] = a.crc("CRC")

    def query(self, c):
        job_id = c.raw("JOB_ID")
        grant_epoch = self.store["grants"].get(str(c["ARG0"]), 0)
        self.fill_answer(c, job_id, self.store["jobs"].get(job_id.hex()), grant_epoch)
        return "OK" if self.answer["JOB_STATE"] else "UNKNOWN_JOB"

    def query_file(self, c):
        if any(c.raw("JOB_ID")):
            return "WRONG_JOB"
        sha = c.raw("FILE_SHA256").hex()
        found = [(i, job) for i, job in self.store["jobs"].items() if job["starts"] and job["sha"] == sha]
        last = max(found, key=lambda one: (one[1]["epoch"], one[1]["seq"]), default=(bytes(16).hex(), None))
        self.fill_answer(c, bytes.fromhex(last[0]), last[1], 0)
        return ("OK" if found else "UNKNOWN_JOB"), len(found)

    def machine_command(self, c):
        what, job_id = c["CMD"], c.raw("JOB_ID")
        if what in (1, 9):
            if any(job_id):
                return "WRONG_JOB"
        elif what == 8:
            if job_id != b"\xff" * 16 and not self.is_current(job_id):
                return "WRONG_JOB"
        elif not self.is_active():
            return "WRONG_STATE"
        elif not self.is_current(job_id):
            return "WRONG_JOB"
        follows = self.map.machine[self.state][what]
        if follows in ("-", "(in place)"):
            return "WRONG_STATE" if follows == "-" else "ALREADY"
        self.go(follows)
        if what == 8:
            self.drop_token()
            if self.is_active():
                self.end_job(ABORTED_JOB, 3)
        return "OK"

    def execute(self, c):
        table = self.map.blocks["COMMAND"]
        for at in [table["CMD_FLAGS"][0], *range(table["reserved"][0], table["CRC"][0])]:
            if c.words[at]:
                return "UNKNOWN_CMD", at
        what = c["CMD"]
        if c["OWNER"] == 0:
            return "NOT_OWNER"
        if what not in self.map.machine["Idle"]:
            return "UNKNOWN_CMD"
        if what == 100:
            return self.claim(c)
        if what not in (3, 4, 8, 106, 110):
            if c["EPOCH"] < self.store["epoch"]:
                return "STALE_EPOCH", self.store["epoch"]
            if not self.lease or (c["EPOCH"], c["OWNER"]) != (self.store["epoch"], self.lease["owner"]):
                return "NOT_OWNER"
        commands = {2: self.start, 101: self.release, 102: self.store_job, 103: self.verify, 104: self.prepare,
                    105: self.cancel, 106: self.query, 107: self.clear_result, 110: self.query_file,
                    108: lambda c: self.why_unfit(c) or "WRONG_MODE",
                    109: lambda c: "ALREADY" if c["ARG0"] == 1 else "WRONG_MODE"}
        return commands.get(what, self.machine_command)(c)

    def bad(self, reason):
        self.bad_frames = (self.bad_frames + 1) & 0xFFFF
        self.bad_reason = self.result_of[reason]

    def on_command(self, words):
        c = Block(self.map.blocks["COMMAND"], words)
        if not any(words):
            return
        if c["MAGIC"] != 0x5143:
            return self.bad("BAD_MAGIC")
        if c["VERSION"] >> 8 != 1:
            return self.bad("BAD_VERSION")
        if c.crc("CRC") != c["CRC"]:
            return self.bad("BAD_CRC")
        last = self.acks.get(c["OWNER"])
        if c["CMD_SEQ"] == 0 or (last and (c["CMD_SEQ"] < last["seq"] or
                                           (c["CMD_SEQ"] == last["seq"] and c["CRC"] != last["crc"]))):
            return self.bad("STALE_SEQ")
        if last and c["CMD_SEQ"] == last["seq"]:
            self.ack = last
            return None
        answer = self.execute(c)
        result, detail = answer if isinstance(answer, tuple) else (answer, 0)
        self.ack = {"owner": c["OWNER"], "seq": c["CMD_SEQ"], "crc": c["CRC"], "command": c["CMD"],
                    "result": self.result_of[result], "detail": detail}
        self.acks[c["OWNER"]] = self.ack
        is_holder = self.lease and (c["EPOCH"], c["OWNER"]) == (self.store["epoch"], self.lease["owner"])
        if self.ack["result"] < 0x100 and is_holder:
            self.lease["until"] = time.monotonic() + 5
        return None

    def on_heartbeat(self, words):
        h, lease = Block(self.map.blocks["HEARTBEAT"], words), self.lease
        if not lease or (h["EPOCH"], h["OWNER"]) != (self.store["epoch"], lease["owner"]):
            return
        if h["COUNTER"] != lease["counter"]:
            now = time.monotonic()
            lease.update(counter=h["COUNTER"], until=now + 5, heard=now)

    def on_chunk(self, words):
        k = Block(self.map.blocks["CHUNK"], words)
        offset, length = k["OFFSET"], k["LEN"]
        if len(words) != 5 + (length + 1) // 2 or not 1 <= length <= 232:
            raise ValueError("LEN does not fit the number of registers")
        if self.job_state != STORED or self.transfer != 1 or not self.lease:
            self.transfer_result = self.result_of["WRONG_STATE"]
            return
        data = bytes_of(words[5:])[:length]
        fence = self.store["epoch"].to_bytes(4, "big") + self.lease["owner"].to_bytes(4, "big")
        name = "OK"
        if zlib.crc32(fence + self.job.raw("JOB_ID") + bytes_of(words[:3]) + data) != k["CRC"]:
            name = "CHUNK_CRC"
        elif offset > len(self.file):
            name = "WRONG_OFFSET"
        elif offset + length > self.job["FILE_SIZE"]:
            name = "FILE_SIZE"
        elif offset < len(self.file):
            name = "ALREADY" if self.file[offset : offset + length] == data else "WRONG_OFFSET"
        else:
            self.file += data
        self.transfer_result = self.result_of[name]

    # --- what it publishes ---

    def status(self):
        now, s = time.monotonic(), Block(self.map.blocks["STATUS"])
        self.snap = (self.snap + 1) & 0xFFFF
        s["MAGIC"], s["VERSION"], s["SNAP_BEGIN"], s["SNAP_END"] = 0x5143, 0x0101, self.snap, self.snap
        s["CELL_HB"] = int((now - self.boot) * 2) & 0xFFFF
        s["BOOT_COUNT"], s["EPOCH_HELD"], s["STARTS_TOTAL"] = (self.store[k] for k in ("boots", "epoch", "starts"))
        s["UNIT_MODE"], s["CELL_ID"] = 1, 0xFFFF
        s["STATE"], s["STATE_PREV"] = (self.map.machine[name]["number"] for name in (self.state, self.before))
        flags = {0: self.state == "Idle" and self.job_state == NONE, 1: self.job_state == PREPARED,
                 2: self.job_state == PREPARED, 3: self.is_active(), 4: self.job_state >= ENDED, 9: True,
                 10: bool(self.lease) and now >= self.lease["heard"] + 2.5, 11: bool(self.lease)}
        s["FLAGS"] = sum(1 << bit for bit, is_set in flags.items() if is_set)
        if self.lease:
            s["LEASE_LEFT"], s["OWNER_HELD"] = max(1, int(10 * (self.lease["until"] - now))), self.lease["owner"]
        if self.ack:
            s["ACK_SEQ"], s["ACK_CMD"], s["ACK_RESULT"] = (self.ack[k] for k in ("seq", "command", "result"))
            s["ACK_DETAIL"], s["ACK_OWNER"] = self.ack["detail"], self.ack["owner"]
        if self.job:
            s["JOB_ID"] = self.job.raw("JOB_ID")
        s["TOKEN"], s["JOB_STATE"], s["JOB_RESULT"] = self.token, self.job_state, self.job_result
        s["PROGRESS"], s["REMAINING"] = 10000 if self.job_state == ENDED else 0, 0xFFFFFFFF
        s["XFER_STATE"], s["XFER_NEXT"], s["XFER_RESULT"] = self.transfer, len(self.file), self.transfer_result
        s["STORE_FREE"], s["FILE_SHA256"], s["CELL_TIME"] = 1 << 20, self.sha, int(time.time() * 1000)
        s["BAD_FRAMES"], s["BAD_REASON"] = self.bad_frames, self.bad_reason
        s["STATUS_CRC"] = s.crc("STATUS_CRC")
        return s

    def identity(self):
        d = Block(self.map.blocks["IDENTITY"])
        d["MAGIC"], d["VERSION"], d["STORE_ID"] = 0x5143, 0x0101, bytes.fromhex(self.store["id"])
        d["BOOT_COUNT"], d["EPOCH_HELD"], d["STARTS_TOTAL"] = (self.store[k] for k in ("boots", "epoch", "starts"))
        d["STORE_CREATED"] = self.store["created"]
        d["CRC"] = d.crc("CRC")
        return d


class Registers(IModbusSlaveContext):
    """The cell as pymodbus sees it: a request is checked by validate() and then read or written."""

    def __init__(self, cell):
        self.cell = cell

    def block_at(self, is_input, address, count):
        for name, table in self.cell.map.blocks.items():
            if table["input"] == is_input and table["base"] <= address:
                if address + count <= table["base"] + table["count"]:
                    return name
        return None

    def validate(self, function, address, count=1):
        name = self.block_at(function == INPUT, address, count)
        if function in (HOLDING, INPUT):
            return name is not None
        if function != WRITE or name is None or address != self.cell.map.blocks[name]["base"]:
            return False
        return name == "CHUNK" or count == self.cell.map.blocks[name]["count"]

    def getValues(self, function, address, count=1):
        self.cell.pass_time()
        if function != INPUT:
            return [0] * count
        name = self.block_at(True, address, count)
        block = {"STATUS": self.cell.status, "RESULT": lambda: self.cell.answer, "IDENTITY": self.cell.identity}[name]()
        at = address - self.cell.map.blocks[name]["base"]
        return block.words[at : at + count]

    def setValues(self, function, address, values):
        self.cell.pass_time()
        name = self.block_at(False, address, len(values))
        if name == "TICKET":
            self.cell.ticket = Block(self.cell.map.blocks["TICKET"], values)
        take = {"COMMAND": self.cell.on_command, "HEARTBEAT": self.cell.on_heartbeat, "CHUNK": self.cell.on_chunk}
        if name in take:
            take[name](list(values))


async def serve(cell):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    registers = Registers(cell)
    context = ModbusServerContext(slaves={1: registers, 255: registers}, single=False)
    server = ModbusTcpServer(context, address=("127.0.0.1", port), allow_reuse_address=True)
    task = asyncio.ensure_future(server.serve_forever())
    await asyncio.sleep(0.2)
    print(f"listening 127.0.0.1:{port}", flush=True)
    ends = asyncio.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        asyncio.get_running_loop().add_signal_handler(number, ends.set)
    await ends.wait()
    task.cancel()


if __name__ == "__main__":
    asyncio.run(serve(Cell(Map(sys.argv[1]), sys.argv[2])))
