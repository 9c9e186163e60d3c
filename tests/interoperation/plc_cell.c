/* A small cell on libmodbus, written from docs/user/cell-integration.md and the register map that it names, and from
 * nothing else: no source of QChopper is used. It runs as a programmable controller does, in cycles of 10 ms: the
 * requests that have come are taken at the beginning of a cycle, the sequence runs once, and the answers go out at its
 * end. It gives consent by itself, moves nothing, and carves a job in a tenth of a second.
 *
 *   plc_cell STORE     prints "listening 127.0.0.1:PORT"; STORE is the file of its lasting memory
 */
#include <errno.h>
#include <fcntl.h>
#include <modbus.h>
#include <openssl/sha.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <netinet/in.h>
#include <time.h>
#include <unistd.h>

typedef uint16_t u16;
typedef uint32_t u32;
typedef uint64_t u64;

enum { CYCLE_MS = 10, MAX_CLIENTS = 8, MAX_JOBS = 256, MAX_FILE = 4 << 20, MAX_OWNERS = 16 };
enum { OK = 1, ALREADY = 2, BAD_MAGIC = 0x101, BAD_VERSION, BAD_CRC, UNKNOWN_CMD, STALE_SEQ, NOT_OWNER, STALE_EPOCH,
       LEASE_BUSY, WRONG_OFFSET, CHUNK_CRC, EPOCH_JUMP, WRONG_STATE = 0x201, WRONG_MODE, BUSY_OTHER_JOB = 0x206,
       WRONG_JOB, NO_TICKET = 0x301, TICKET_CRC, TICKET_FIELD, HASH_MISMATCH = 0x306, FILE_MISSING, FILE_SIZE,
       STORE_FULL = 0x30B, REHEARSAL_REQUIRED = 0x30C, JOB_ID_REUSED = 0x30D, TOKEN_BAD = 0x401, ALREADY_FINISHED,
       UNKNOWN_JOB, CANCELLED, TOKEN_EXPIRED, STORE_IO = 0x502 };
enum { CLEARING = 1, STOPPED, STARTING, IDLE, SUSPENDED, EXECUTE, STOPPING, ABORTING, ABORTED, HOLDING, HELD, UNHOLDING,
       SUSPENDING, UNSUSPENDING, RESETTING, COMPLETING, COMPLETE };
enum { RESET = 1, START, STOP, HOLD, UNHOLD, SUSPEND, UNSUSPEND, ABORT, CLEAR, COMPLETE_NOW, CLAIM = 100, RELEASE, STORE,
       VERIFY, PREPARE, CANCEL, QUERY, CLEAR_RESULT, REHEARSE, SET_MODE, QUERY_FILE };
enum { NONE, STORED, PREPARED, RUNNING, INTERRUPTED, ENDED, JOB_ABORTED, JOB_CANCELLED };

/* The table of the machine, rows 1..17, columns commands 1..10: the state that follows, 0 refused, -1 in place. */
static const signed char machine[18][11] = {
    {0},
    [CLEARING] = {[ABORT] = ABORTING, [CLEAR] = -1},
    [STOPPED] = {[RESET] = RESETTING, [ABORT] = ABORTING, [CLEAR] = -1},
    [STARTING] = {[START] = -1, [STOP] = STOPPING, [HOLD] = HOLDING, [ABORT] = ABORTING},
    [IDLE] = {[RESET] = -1, [START] = STARTING, [ABORT] = ABORTING},
    [SUSPENDED] = {[START] = -1, [STOP] = STOPPING, [HOLD] = HOLDING, [SUSPEND] = -1, [UNSUSPEND] = UNSUSPENDING,
                   [ABORT] = ABORTING},
    [EXECUTE] = {[START] = -1, [STOP] = STOPPING, [HOLD] = HOLDING, [SUSPEND] = SUSPENDING, [ABORT] = ABORTING,
                 [COMPLETE_NOW] = COMPLETING},
    [STOPPING] = {[START] = -1, [STOP] = -1, [ABORT] = ABORTING},
    [ABORTING] = {[ABORT] = -1},
    [ABORTED] = {[ABORT] = -1, [CLEAR] = CLEARING},
    [HOLDING] = {[START] = -1, [STOP] = STOPPING, [HOLD] = -1, [ABORT] = ABORTING},
    [HELD] = {[START] = -1, [STOP] = STOPPING, [HOLD] = -1, [UNHOLD] = UNHOLDING, [ABORT] = ABORTING},
    [UNHOLDING] = {[START] = -1, [STOP] = STOPPING, [HOLD] = HOLDING, [UNHOLD] = -1, [ABORT] = ABORTING},
    [SUSPENDING] = {[START] = -1, [STOP] = STOPPING, [HOLD] = HOLDING, [SUSPEND] = -1, [ABORT] = ABORTING},
    [UNSUSPENDING] = {[START] = -1, [STOP] = STOPPING, [HOLD] = HOLDING, [UNSUSPEND] = -1, [ABORT] = ABORTING},
    [RESETTING] = {[RESET] = -1, [ABORT] = ABORTING},
    [COMPLETING] = {[START] = -1, [STOP] = STOPPING, [ABORT] = ABORTING, [COMPLETE_NOW] = -1},
    [COMPLETE] = {[RESET] = RESETTING, [ABORT] = ABORTING},
};
static const signed char after_done[18] = {[CLEARING] = STOPPED, [STARTING] = EXECUTE, [EXECUTE] = COMPLETING,
    [STOPPING] = STOPPED, [ABORTING] = ABORTED, [HOLDING] = HELD, [UNHOLDING] = EXECUTE, [SUSPENDING] = SUSPENDED,
    [UNSUSPENDING] = EXECUTE, [RESETTING] = IDLE, [COMPLETING] = COMPLETE};

struct job_record {
    u16 id[8], state, result, sha[16];
    u32 starts, epoch, seq;
    u64 start_ms, end_ms;
};
struct grant { u32 number, epoch; };
/* What outlives a loss of power. */
static struct {
    u16 store_id[8];
    u64 created_ms;
    u32 boots, epoch_held, starts_total, jobs, grants;
    struct job_record job[MAX_JOBS];
    struct grant grant[MAX_JOBS];
} store;
static const char *store_path;

static struct { u32 owner, seq, crc, detail; u16 command, result; } acks[MAX_OWNERS], ack;
static struct { bool held; u32 owner, secret; u64 until, heard; bool has_counter; u16 counter; } lease;
static u16 ticket[100], job_ticket[100], job_state, job_result, xfer_state, xfer_result, file_sha[16];
static u32 token, old_token, xfer_next;
static u64 token_until;
static unsigned char file[MAX_FILE];
static u16 state = STOPPED, state_before = STOPPED, bad_frames, bad_reason, snap;
static u64 state_since, now, boot_ms;
static bool watchdog;
static u16 in_status[100], in_result[60], in_identity[24];

static u64 clock_ms(clockid_t which) {
    struct timespec t;
    clock_gettime(which, &t);
    return (u64)t.tv_sec * 1000 + (u64)t.tv_nsec / 1000000;
}
static u32 get32(const u16 *r) { return (u32)r[0] << 16 | r[1]; }
static void put32(u16 *r, u32 v) { r[0] = (u16)(v >> 16); r[1] = (u16)v; }
static void put64(u16 *r, u64 v) { put32(r, (u32)(v >> 32)); put32(r + 2, (u32)v); }
static bool is_zero(const u16 *r, int n) {
    for (int i = 0; i < n; ++i) if (r[i]) return false;
    return true;
}
static u32 crc_add(u32 crc, unsigned char byte) {
    crc ^= byte;
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    return crc;
}
static u32 crc_registers(u32 crc, const u16 *r, int n) {
    for (int i = 0; i < n; ++i) crc = crc_add(crc_add(crc, (unsigned char)(r[i] >> 8)), (unsigned char)r[i]);
    return crc;
}
static u32 crc_of(const u16 *r, int n) { return ~crc_registers(~0u, r, n); }
static u32 random32(void) {
    u32 v = 0;
    while (v == 0) if (getrandom(&v, sizeof v, 0) != sizeof v) v = 0;
    return v;
}

/* Aside, synced, renamed: an acknowledgement that needs the store is given only after this. */
static bool save(void) {
    char aside[4096];
    snprintf(aside, sizeof aside, "%s.new", store_path);
    int fd = open(aside, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (fd < 0) return false;
    bool ok = write(fd, &store, sizeof store) == (ssize_t)sizeof store && fsync(fd) == 0;
    close(fd);
    return ok && rename(aside, store_path) == 0;
}
static void power_up(void) {
    int fd = open(store_path, O_RDONLY);
    if (fd < 0 || read(fd, &store, sizeof store) != (ssize_t)sizeof store) {
        memset(&store, 0, sizeof store);
        for (int i = 0; i < 8; ++i) store.store_id[i] = (u16)random32();
        store.created_ms = clock_ms(CLOCK_REALTIME);
    }
    if (fd >= 0) close(fd);
    ++store.boots;
    for (u32 i = 0; i < store.jobs; ++i) {
        struct job_record *j = &store.job[i];
        if (j->state != RUNNING && j->state != INTERRUPTED) continue;
        j->state = JOB_ABORTED;  /* it never goes on by itself */
        j->result = 4;
        state = state_before = ABORTED;
    }
    if (!save()) exit(1);
}
static struct job_record *record_of(const u16 *id) {
    for (u32 i = 0; i < store.jobs; ++i) if (!memcmp(store.job[i].id, id, 16)) return &store.job[i];
    return NULL;
}

static void go(u16 next) { state_before = state; state = next; state_since = now; }
static bool is_active(void) { return job_state == RUNNING || job_state == INTERRUPTED; }
static void end_job(u16 how, u16 result) {
    struct job_record *j = record_of(job_ticket + 1);
    job_state = j->state = how;
    job_result = j->result = result;
    j->end_ms = clock_ms(CLOCK_REALTIME);
    save();
}
static void drop_token(void) {
    if (job_state == PREPARED) { job_state = STORED; old_token = token; }
    token = 0;
}
static void drop_job(void) {
    drop_token();
    job_state = job_result = xfer_state = xfer_result = 0;
    xfer_next = 0;
    memset(job_ticket, 0, sizeof job_ticket);
    memset(file_sha, 0, sizeof file_sha);
}

/* --- commands: each returns the result, and sets detail --- */

static u16 claim(const u16 *c, u32 *detail) {
    u32 epoch = get32(c + 2), owner = get32(c + 38), secret = get32(c + 20);
    *detail = store.epoch_held;
    if (epoch <= store.epoch_held) return STALE_EPOCH;
    if (epoch - store.epoch_held > 1u << 20) return EPOCH_JUMP;
    *detail = lease.owner;
    if (lease.held && !(lease.owner == owner && lease.secret == secret)) return LEASE_BUSY;
    if (store.grants == MAX_JOBS) return STORE_FULL;
    *detail = random32();
    u32 before = store.epoch_held;
    store.grant[store.grants++] = (struct grant){*detail, epoch};
    store.epoch_held = epoch;
    if (!save()) { store.epoch_held = before; --store.grants; return STORE_IO; }
    drop_token();
    memset(&lease, 0, sizeof lease);
    lease.held = true;
    lease.owner = owner;
    lease.secret = secret;
    lease.heard = now;
    watchdog = false;
    return OK;
}
static u16 check_ticket(const u16 *c, u32 *detail) {
    if (is_zero(ticket, 100)) return NO_TICKET;
    if (crc_of(ticket, 98) != get32(ticket + 98)) return TICKET_CRC;
    *detail = 101;
    if (is_zero(ticket + 1, 8) || memcmp(ticket + 1, c + 8, 16)) return TICKET_FIELD;
    const struct job_record *known = record_of(ticket + 1);
    if (known) return known->state == JOB_CANCELLED ? CANCELLED : JOB_ID_REUSED;
    if (job_state != NONE && !memcmp(ticket + 1, job_ticket + 1, 16))
        return memcmp(ticket, job_ticket, sizeof ticket) ? JOB_ID_REUSED : ALREADY;
    if (job_state != NONE) return BUSY_OTHER_JOB;
    if (state != IDLE) return WRONG_STATE;
    const struct { int address; bool wrong; } fields[] = {
        {100, ticket[0] != 1}, {125, get32(ticket + 25) == 0}, {127, ticket[27] != 2}, {128, !(ticket[28] >> 8)},
        {144, ticket[44] != 1}, {163, ticket[63] > 4}, {165, get32(ticket + 65) == 0},
        {173, ticket[73] < 1 || ticket[73] > ticket[74]}, {187, ticket[87] > 1}, {188, ticket[88] > 1},
        {191, ticket[91] || ticket[92]}, {193, ticket[93] != 0xFFFF}, {194, ticket[94] != 1}, {197, ticket[97] != 0}};
    for (unsigned i = 0; i < sizeof fields / sizeof *fields; ++i) {
        *detail = (u32)fields[i].address;
        if (fields[i].wrong) return TICKET_FIELD;
    }
    *detail = 125;
    if (get32(ticket + 25) > MAX_FILE) return STORE_FULL;
    *detail = 0;
    return memcmp(ticket + 9, c + 22, 32) ? HASH_MISMATCH : OK;
}
static u16 store_job(const u16 *c, u32 *detail) {
    u16 result = check_ticket(c, detail);
    if (result != OK) return result;
    memcpy(job_ticket, ticket, sizeof ticket);
    job_state = STORED;
    job_result = 0;
    xfer_state = 1;
    xfer_next = xfer_result = 0;
    memset(file_sha, 0, sizeof file_sha);
    return OK;
}
static bool is_current(const u16 *id) { return job_state != NONE && !memcmp(id, job_ticket + 1, 16); }
static u16 other_job(const u16 *id) {
    const struct job_record *known = record_of(id);
    if (!known) return job_state == NONE ? UNKNOWN_JOB : WRONG_JOB;
    return known->state == JOB_CANCELLED ? CANCELLED : ALREADY_FINISHED;
}
static u16 fit(const u16 *c) {
    if (!is_current(c + 8)) return other_job(c + 8);
    if (job_state >= ENDED) return ALREADY_FINISHED;
    if (job_state == PREPARED) return ALREADY;
    if (state != IDLE || job_state != STORED) return WRONG_STATE;
    return memcmp(c + 22, job_ticket + 9, 32) ? HASH_MISMATCH : OK;
}
static u16 verify(const u16 *c) {
    u16 result = fit(c);
    if (result != OK) return result;
    u32 size = get32(job_ticket + 25);
    if (xfer_next < size) return FILE_MISSING;
    unsigned char digest[32];
    SHA256(file, size, digest);
    for (int i = 0; i < 16; ++i) file_sha[i] = (u16)(digest[2 * i] << 8 | digest[2 * i + 1]);
    if (memcmp(file_sha, job_ticket + 9, 32)) { xfer_state = 1; xfer_next = 0; return HASH_MISMATCH; }
    xfer_state = 2;
    return OK;
}
static u16 prepare(const u16 *c) {
    u16 result = fit(c);
    if (result != OK) return result;
    if (xfer_state != 2) return FILE_MISSING;
    if (job_ticket[88] || get32(c + 18)) return REHEARSAL_REQUIRED;
    token = random32();  /* here the operator would be asked: PENDING until then */
    token_until = now + 120000;
    job_state = PREPARED;
    return OK;
}
static u16 start(const u16 *c) {
    if (!is_current(c + 8)) return other_job(c + 8);
    if (is_active()) return ALREADY;
    if (job_state >= ENDED) return ALREADY_FINISHED;
    if (machine[state][START] <= 0) return WRONG_STATE;
    if (job_state != PREPARED || get32(c + 16) != token)
        return get32(c + 16) && get32(c + 16) == old_token ? TOKEN_EXPIRED : TOKEN_BAD;
    if (memcmp(c + 22, job_ticket + 9, 32)) return HASH_MISMATCH;
    if (store.jobs == MAX_JOBS) return STORE_FULL;
    struct job_record *j = &store.job[store.jobs++];
    memset(j, 0, sizeof *j);
    memcpy(j->id, c + 8, 16);
    memcpy(j->sha, file_sha, 32);
    j->state = RUNNING;
    j->starts = 1;
    j->epoch = get32(c + 2);
    j->seq = get32(c + 4);
    j->start_ms = clock_ms(CLOCK_REALTIME);
    ++store.starts_total;
    if (!save()) { --store.jobs; --store.starts_total; return STORE_IO; }  /* before anything moves */
    token = 0;
    job_state = RUNNING;
    go(STARTING);
    return OK;
}
static u16 cancel(const u16 *c) {
    if (!is_current(c + 8)) {
        u16 known = other_job(c + 8);
        return known == CANCELLED ? ALREADY : known == WRONG_JOB ? UNKNOWN_JOB : known;
    }
    if (job_state >= ENDED) return ALREADY_FINISHED;
    if (job_state > PREPARED) return WRONG_STATE;
    if (store.jobs == MAX_JOBS) return STORE_FULL;
    struct job_record *j = &store.job[store.jobs++];
    memset(j, 0, sizeof *j);
    memcpy(j->id, c + 8, 16);
    j->state = JOB_CANCELLED;
    if (!save()) { --store.jobs; return STORE_IO; }
    drop_job();
    return OK;
}
static u16 clear_result(const u16 *c) {
    if (!is_current(c + 8)) {
        u16 known = other_job(c + 8);
        return known == ALREADY_FINISHED || known == CANCELLED ? ALREADY : UNKNOWN_JOB;
    }
    if (job_state < ENDED) return WRONG_STATE;
    drop_job();
    return OK;
}
static void fill_result(const u16 *id, const struct job_record *j, const u16 *c, u32 grant_epoch) {
    memset(in_result, 0, sizeof in_result);
    memcpy(in_result, id, 16);
    if (j) {
        in_result[8] = j->state;
        in_result[9] = j->result;
        put32(in_result + 10, j->starts);
        put32(in_result + 12, j->epoch);
        put32(in_result + 14, j->seq);
        put64(in_result + 16, j->start_ms);
        put64(in_result + 20, j->end_ms);
        memcpy(in_result + 24, j->sha, 32);
    }
    if (is_current(id)) {
        in_result[8] = job_state;
        in_result[9] = job_result;
        memcpy(in_result + 24, file_sha, 32);
    }
    put32(in_result + 42, get32(c + 4));
    put32(in_result + 44, get32(c + 38));
    put32(in_result + 46, grant_epoch);
    put32(in_result + 58, crc_of(in_result, 58));
}
static u16 query(const u16 *c) {
    u32 epoch = 0;
    for (u32 i = 0; i < store.grants; ++i) if (store.grant[i].number == get32(c + 18)) epoch = store.grant[i].epoch;
    fill_result(c + 8, record_of(c + 8), c, epoch);
    return in_result[8] ? OK : UNKNOWN_JOB;
}
static u16 query_file(const u16 *c, u32 *detail) {
    static const u16 nobody[8];
    const struct job_record *last = NULL;
    if (!is_zero(c + 8, 8)) return WRONG_JOB;
    for (u32 i = 0; i < store.jobs; ++i) {
        if (!store.job[i].starts || memcmp(store.job[i].sha, c + 22, 32)) continue;
        last = &store.job[i];
        ++*detail;
    }
    fill_result(last ? last->id : nobody, last, c, 0);
    return last ? OK : UNKNOWN_JOB;
}
static u16 machine_command(const u16 *c) {
    static const u16 any[8] = {0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF};
    u16 what = c[6];
    if (what == RESET || what == CLEAR) {
        if (!is_zero(c + 8, 8)) return WRONG_JOB;
    } else if (what == ABORT) {
        if (memcmp(c + 8, any, 16) && !is_current(c + 8)) return WRONG_JOB;
    } else {
        if (!is_active()) return WRONG_STATE;
        if (!is_current(c + 8)) return WRONG_JOB;
    }
    int next = machine[state][what];
    if (next == 0) return WRONG_STATE;
    if (next < 0) return ALREADY;
    go((u16)next);
    if (what == ABORT) {
        drop_token();
        if (is_active()) end_job(JOB_ABORTED, 3);
    }
    return OK;
}
static bool needs_lease(u16 what) {
    return what != STOP && what != HOLD && what != ABORT && what != QUERY && what != QUERY_FILE;
}
static u16 execute(const u16 *c, u32 *detail) {
    u16 what = c[6];
    bool is_known = (what >= RESET && what <= COMPLETE_NOW) || (what >= CLAIM && what <= QUERY_FILE);
    *detail = 7;
    if (c[7]) return UNKNOWN_CMD;
    for (int i = 40; i < 58; ++i) {
        *detail = (u32)i;
        if (c[i]) return UNKNOWN_CMD;
    }
    *detail = 0;
    if (get32(c + 38) == 0) return NOT_OWNER;
    if (!is_known) return UNKNOWN_CMD;
    if (what == CLAIM) return claim(c, detail);
    if (needs_lease(what)) {
        *detail = store.epoch_held;
        if (get32(c + 2) < store.epoch_held) return STALE_EPOCH;
        *detail = 0;
        if (!lease.held || lease.owner != get32(c + 38) || get32(c + 2) != store.epoch_held) return NOT_OWNER;
    }
    switch (what) {
        case RELEASE: drop_token(); lease.held = false; watchdog = false; return OK;
        case STORE: return store_job(c, detail);
        case VERIFY: return verify(c);
        case PREPARE: return prepare(c);
        case CANCEL: return cancel(c);
        case QUERY: return query(c);
        case QUERY_FILE: return query_file(c, detail);
        case CLEAR_RESULT: return clear_result(c);
        case REHEARSE: return fit(c) == OK ? WRONG_MODE : fit(c);
        case SET_MODE: return get32(c + 18) == 1 ? ALREADY : WRONG_MODE;
        case START: return start(c);
        default: return machine_command(c);
    }
}
static void bad(u16 reason) { ++bad_frames; bad_reason = reason; }
static void on_command(const u16 *c) {
    if (is_zero(c, 60)) return;
    if (c[0] != 0x5143) { bad(BAD_MAGIC); return; }
    if (c[1] >> 8 != 1) { bad(BAD_VERSION); return; }
    u32 crc = get32(c + 58), owner = get32(c + 38), seq = get32(c + 4), detail = 0;
    if (crc_of(c, 58) != crc) { bad(BAD_CRC); return; }
    if (seq == 0) { bad(STALE_SEQ); return; }
    int place = -1, oldest = 0;
    for (int i = 0; i < MAX_OWNERS; ++i) {
        if (acks[i].owner == owner && acks[i].seq) place = i;
        if (!acks[i].seq) oldest = i;
    }
    if (place >= 0 && seq <= acks[place].seq) {
        if (seq < acks[place].seq || crc != acks[place].crc) bad(STALE_SEQ);
        else ack = acks[place];
        return;
    }
    u16 result = execute(c, &detail);
    if (place < 0) place = oldest;
    acks[place].owner = owner;
    acks[place].seq = seq;
    acks[place].crc = crc;
    acks[place].command = c[6];
    acks[place].result = result;
    acks[place].detail = detail;
    ack = acks[place];
    if (result < 0x100 && lease.held && lease.owner == owner && get32(c + 2) == store.epoch_held)
        lease.until = now + 5000;
}
static void on_heartbeat(const u16 *h) {
    if (!lease.held || get32(h) != store.epoch_held || get32(h + 2) != lease.owner) return;
    if (lease.has_counter && lease.counter == h[4]) return;
    lease.has_counter = true;
    lease.counter = h[4];
    lease.until = now + 5000;
    lease.heard = now;
    watchdog = false;
}
static void on_chunk(const u16 *k) {
    u32 offset = get32(k), size = get32(job_ticket + 25), crc = ~0u;
    int length = k[2];
    u16 fence[2];
    if (job_state != STORED || xfer_state != 1 || !lease.held) { xfer_result = WRONG_STATE; return; }
    put32(fence, store.epoch_held);
    crc = crc_registers(crc, fence, 2);
    put32(fence, lease.owner);
    crc = crc_registers(crc, fence, 2);
    crc = crc_registers(crc, job_ticket + 1, 8);
    crc = crc_registers(crc, k, 3);
    unsigned char data[232];
    for (int i = 0; i < length; ++i) data[i] = (unsigned char)(i % 2 ? k[5 + i / 2] : k[5 + i / 2] >> 8);
    for (int i = 0; i < length; ++i) crc = crc_add(crc, data[i]);
    if (~crc != get32(k + 3)) { xfer_result = CHUNK_CRC; return; }
    if (offset > xfer_next) { xfer_result = WRONG_OFFSET; return; }
    if (offset + (u32)length > size) { xfer_result = FILE_SIZE; return; }
    if (offset < xfer_next) {
        bool same = offset + (u32)length <= xfer_next && !memcmp(file + offset, data, (size_t)length);
        xfer_result = same ? ALREADY : WRONG_OFFSET;
        return;
    }
    memcpy(file + offset, data, (size_t)length);
    xfer_next += (u32)length;
    xfer_result = OK;
}

/* --- the sequence, once a cycle --- */

static void run_sequence(void) {
    u64 in_state = now - state_since;
    if (after_done[state] && in_state >= 100) {
        u16 next = (u16)after_done[state];
        go(next);
        if (next == COMPLETE && is_active()) end_job(ENDED, 1);
        if (next == STOPPED && is_active()) end_job(JOB_ABORTED, 2);
    }
    if (lease.held && now >= lease.until) { lease.held = false; watchdog = false; drop_token(); }
    if (lease.held && now >= lease.heard + 2500) watchdog = true;
    if (token && now >= token_until) drop_token();
}
static void publish(void) {
    u16 *s = in_status;
    memset(s, 0, sizeof in_status);
    ++snap;
    s[0] = 0x5143;
    s[1] = 0x0101;
    s[2] = s[99] = snap;
    s[3] = (u16)((now - boot_ms) / 500);
    put32(s + 4, store.boots);
    s[6] = 1;
    s[7] = state;
    s[8] = state_before;
    s[9] = (u16)(1u << 9 | (state == IDLE && job_state == NONE ? 1u : 0) | (job_state == PREPARED ? 6u : 0) |
                 (is_active() ? 1u << 3 : 0) | (job_state >= ENDED ? 1u << 4 : 0) | (watchdog ? 1u << 10 : 0) |
                 (lease.held ? 1u << 11 : 0));
    put32(s + 10, store.epoch_held);
    s[12] = lease.held ? (u16)((lease.until - now + 99) / 100) : 0;
    s[13] = 0xFFFF;
    put32(s + 14, ack.seq);
    s[16] = ack.command;
    s[17] = ack.result;
    put32(s + 18, ack.detail);
    memcpy(s + 20, job_ticket + 1, 16);
    put32(s + 28, token);
    s[30] = job_state;
    s[31] = job_result;
    s[32] = job_state == ENDED ? 10000 : 0;
    put32(s + 35, 0xFFFFFFFF);
    s[61] = xfer_state;
    put32(s + 62, xfer_next);
    s[64] = xfer_result;
    put32(s + 65, MAX_FILE / 1024);
    memcpy(s + 69, file_sha, 32);
    put32(s + 85, store.starts_total);
    put64(s + 87, clock_ms(CLOCK_REALTIME));
    put32(s + 91, lease.held ? lease.owner : 0);
    put32(s + 93, ack.owner);
    s[95] = bad_frames;
    put32(s + 96, crc_of(s, 96));
    s[98] = bad_reason;
    u16 *d = in_identity;
    d[0] = 0x5143;
    d[1] = 0x0101;
    memcpy(d + 2, store.store_id, 16);
    put32(d + 10, store.boots);
    put32(d + 12, store.epoch_held);
    put32(d + 14, store.starts_total);
    put64(d + 16, store.created_ms);
    put32(d + 22, crc_of(d, 22));
}

/* --- Modbus: requests at the beginning of a cycle, answers at its end --- */

struct request { int socket, length; uint8_t bytes[MODBUS_TCP_MAX_ADU_LENGTH]; };

static bool is_inside(int address, int count, int base, int size) {
    return address >= base && address + count <= base + size;
}
/* 0, or the exception; what is written acts at once, in the order of arrival. */
static int take(const struct request *q) {
    const uint8_t *b = q->bytes;
    int function = b[7], address = b[8] << 8 | b[9], count = b[10] << 8 | b[11];
    u16 r[123];
    if (b[6] != 1 && b[6] != 255) return MODBUS_EXCEPTION_GATEWAY_TARGET;
    if (function != 3 && function != 4 && function != 16) return MODBUS_EXCEPTION_ILLEGAL_FUNCTION;
    if (function != 16) {
        if (q->length != 12 || count < 1 || count > 125) return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
        bool ok = function == 4 ? is_inside(address, count, 0, 100) || is_inside(address, count, 200, 60) ||
                                      is_inside(address, count, 300, 24)
                                : is_inside(address, count, 0, 60) || is_inside(address, count, 100, 100) ||
                                      is_inside(address, count, 200, 32) || is_inside(address, count, 300, 121) ||
                                      is_inside(address, count, 500, 5);
        return ok ? 0 : MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS;
    }
    if (count < 1 || count > 123 || b[12] != 2 * count || q->length != 13 + 2 * count)
        return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
    for (int i = 0; i < count; ++i) r[i] = (u16)(b[13 + 2 * i] << 8 | b[14 + 2 * i]);
    if (address == 0 && count == 60) on_command(r);
    else if (address == 100 && count == 100) memcpy(ticket, r, sizeof ticket);
    else if (address == 200 && count == 32) return 0;  /* signatures are not looked at here */
    else if (address == 500 && count == 5) on_heartbeat(r);
    else if (address == 300 && count > 5 && count <= 121) {
        if (r[2] < 1 || r[2] > 232 || count != 5 + (r[2] + 1) / 2) return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
        on_chunk(r);
    } else return MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS;
    return 0;
}

static volatile sig_atomic_t ends;
static void on_signal(int number) { (void)number; ends = 1; }

int main(int argc, char **argv) {
    if (argc != 2) return 64;
    store_path = argv[1];
    signal(SIGTERM, on_signal);
    signal(SIGINT, on_signal);
    signal(SIGPIPE, SIG_IGN);
    now = boot_ms = clock_ms(CLOCK_MONOTONIC);
    power_up();
    modbus_t *context = modbus_new_tcp("127.0.0.1", 0);
    modbus_mapping_t *map = modbus_mapping_new(0, 0, 505, 324);
    int listener = modbus_tcp_listen(context, MAX_CLIENTS);
    struct sockaddr_in where;
    socklen_t size = sizeof where;
    if (!map || listener < 0 || getsockname(listener, (struct sockaddr *)&where, &size)) return 1;
    printf("listening 127.0.0.1:%d\n", ntohs(where.sin_port));
    fflush(stdout);
    struct pollfd sockets[MAX_CLIENTS + 1] = {{listener, POLLIN, 0}};
    int clients = 0;
    publish();
    while (!ends) {
        struct request requests[MAX_CLIENTS];
        int exceptions[MAX_CLIENTS], taken = 0;
        /* the beginning of the cycle */
        poll(sockets, (nfds_t)clients + 1, 0);
        for (int i = clients; i > 0; --i) {
            if (!(sockets[i].revents & (POLLIN | POLLHUP | POLLERR))) continue;
            struct request *q = &requests[taken];
            memset(q, 0, sizeof *q);
            modbus_set_socket(context, sockets[i].fd);
            q->socket = sockets[i].fd;
            q->length = modbus_receive(context, q->bytes);
            if (q->length > 8) { ++taken; continue; }
            close(sockets[i].fd);
            sockets[i] = sockets[clients--];
        }
        if (sockets[0].revents & POLLIN) {
            int fd = accept(listener, NULL, NULL);
            if (clients == MAX_CLIENTS) close(fd);
            else if (fd >= 0) sockets[++clients] = (struct pollfd){fd, POLLIN, 0};
        }
        now = clock_ms(CLOCK_MONOTONIC);
        for (int i = 0; i < taken; ++i) exceptions[i] = take(&requests[i]);
        run_sequence();
        publish();
        /* the end of the cycle */
        memcpy(map->tab_input_registers, in_status, sizeof in_status);
        memcpy(map->tab_input_registers + 200, in_result, sizeof in_result);
        memcpy(map->tab_input_registers + 300, in_identity, sizeof in_identity);
        for (int i = 0; i < taken; ++i) {
            modbus_set_socket(context, requests[i].socket);
            if (exceptions[i]) modbus_reply_exception(context, requests[i].bytes, (unsigned)exceptions[i]);
            else modbus_reply(context, requests[i].bytes, requests[i].length, map);
            memset(map->tab_registers, 0, 505 * sizeof(u16));  /* holding registers read as zero */
        }
        u64 spent = clock_ms(CLOCK_MONOTONIC) - now;
        if (spent < CYCLE_MS) usleep((useconds_t)(1000 * (CYCLE_MS - spent)));
    }
    modbus_mapping_free(map);
    close(listener);
    modbus_free(context);
    return 0;
}
