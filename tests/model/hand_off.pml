/* The hand-off of jobs to a cell, in Promela: which words a PC may say of a start while commands are lost, repeated and
 * overtaken, PCs are killed, a journal loses its last rows, the cell loses power or its store or gets an older copy of it
 * back, the operator cancels, another PC takes the cell over, and the key that signed the tickets is revoked.
 *
 * docs/developer/model.md says what is in it and what not, and holds the results of scripts/model. The rows MOVE are compared with
 * the simulated cell (tests/sim/cell/model_test.cpp). Every property is an assertion; no property is about time. */

#ifndef PCS
#define PCS 1        /* dispatchers */
#endif
#ifndef JOBS
#define JOBS 1       /* jobs of all dispatchers together; two of one dispatcher are a queue */
#endif
#ifndef KILLS
#define KILLS 1      /* kills of a dispatcher */
#endif
#ifndef CUTS
#define CUTS 1       /* power cuts */
#endif
#ifndef LOSSES
#define LOSSES 0     /* power cuts after which the store is empty */
#endif
#ifndef COPIES
#define COPIES 0     /* power cuts after which an older copy of the store is back */
#endif
#ifndef MARKS
#define MARKS 1      /* STORE_CHECK: 1, the store has marks in another memory */
#endif
#ifndef MARKS_BACK
#define MARKS_BACK 0 /* 1: the marks of the copy come back with it; then it is none from between a CLAIM and its START */
#endif
#ifndef BACKS
#define BACKS 0      /* kills after which the journal is an older copy; not together with LOSSES or COPIES */
#endif
#ifndef CANCELS
#define CANCELS 0
#endif
#ifndef REVOKES
#define REVOKES 0    /* 1: the cell takes signed tickets only, and the key of all of them may be revoked at any moment */
#endif
#ifndef EPOCHS
#define EPOCHS 3     /* a dispatcher that would claim a higher epoch gives up */
#endif

/* Job states of the cell and its commands, as in devices/wire/codes.h and devices/wire/packml.h. */
mtype:job = { none, stored, prepared, running, ended };
mtype:cmd = { no_cmd, claim, store, prepare, start, cancel, clear_result };
mtype:mem = { unknown_job, started, cancelled };
/* What the journal of a PC holds of a job; the last three are the words to the operator. */
mtype:word = { idle, preparing, starting, STARTED, NOT_STARTED, UNKNOWN };

/* Frames on their way, at most two. */
mtype:cmd f_c[2]; byte f_p[2]; byte f_e[2]; byte f_j[2]; byte f_t[2]; bit f_take[2];

/* The cell. These are in its store: */
byte epoch; mtype:mem memory[3] = unknown_job; byte store_id = 1;
#if COPIES
byte boots; byte grant_of[5]; byte start_epoch[3];     /* grant_of: the number of each epoch's CLAIM */
bit copied; byte c_epoch; mtype:mem c_memory[3] = unknown_job; byte c_boots; byte c_grant_of[5]; byte c_start_epoch[3];
byte copies;
byte grants;                                           /* drawn so far: a new one is never equal to an old one */
byte j_granted[3]; byte j_grant[3]; byte j_boots[3];   /* journals: last CLAIM that was granted, boots before START */
#endif
/* these are not: */
byte lease; byte job; mtype:job state = none; byte token;
byte tokens;               /* drawn so far: a new one is never equal to an old one */
bit connected[3];

/* The judge, outside of both. */
byte starts[3];

/* Journals; the index of a dispatcher and of a job begins with 1. */
byte j_epoch[3]; mtype:word j_word[3] = idle; byte j_store[3];
byte kills; byte cuts; byte losses; byte cancels; bit revoked;
#if BACKS
byte backs; bit jc_is[3]; byte jc_epoch[3]; mtype:word jc_word[3] = idle; byte jc_store[3];   /* the copies */
#endif

#define is_final(w) ((w) == STARTED || (w) == NOT_STARTED || (w) == UNKNOWN)

inline send(c, p, e, j, t, take) {
  atomic {
    if
    :: f_c[0] == no_cmd -> f_c[0] = c; f_p[0] = p; f_e[0] = e; f_j[0] = j; f_t[0] = t; f_take[0] = take
    :: f_c[0] != no_cmd && f_c[1] == no_cmd -> f_c[1] = c; f_p[1] = p; f_e[1] = e; f_j[1] = j; f_t[1] = t; f_take[1] = take
    :: else -> skip            /* lost */
    fi
  }
}

inline forget(i) { f_c[i] = no_cmd; f_p[i] = 0; f_e[i] = 0; f_j[i] = 0; f_t[i] = 0; f_take[i] = 0 }

/* A command that takes the cell from one job state to another. Rows are read by a test: keep their form. */
#define MOVE(c, from, to, also) (f_c[i] == c && state == from && (also)) -> state = to
#define same (f_j[i] == job)

#if defined(MUTANT_NO_FENCE_NO_TOKEN) || defined(MUTANT_NO_FENCE_KEEPS)
#define fence_holds 1
#else
#define fence_holds (f_e[i] == epoch)
#endif
#ifdef MUTANT_NO_OWNER
#define owner_holds 1
#else
#define owner_holds (f_p[i] == lease)
#endif
#if defined(MUTANT_NO_FENCE_NO_TOKEN) || defined(MUTANT_NO_MEMORY_NO_TOKEN)
#define token_holds 1
#else
#define token_holds (f_t[i] == token && token != 0)
#endif
#if defined(MUTANT_NO_MEMORY_NO_TOKEN)
#define is_new(j) 1
#else
#define is_new(j) (memory[j] == unknown_job)
#endif

#if defined(MUTANT_KEY_AT_STORE)
#define key_holds_at_start 1
#else
#define key_holds_at_start (!revoked)
#endif

inline grant() {
  epoch = f_e[i]; lease = f_p[i];
#if COPIES
  grants++; grant_of[epoch] = grants;
#endif
#ifndef MUTANT_NO_FENCE_KEEPS
  if :: MOVE(claim, prepared, stored, 1); token = 0 :: else -> skip fi
#endif
}

inline move_the_arm() {
  starts[job]++;
  assert(starts[job] <= 1);                           /* a job starts once */
  assert(j_word[job] != NOT_STARTED);                 /* NOT STARTED is for ever */
  assert(lease == 0 || PCS == 1 || f_p[i] == lease);  /* nobody starts but the owner */
  assert(!revoked);                                   /* no job of a revoked key starts */
#ifndef MUTANT_NO_MEMORY_NO_TOKEN
  token = 0;
#endif
  memory[job] = started
#if COPIES
  ; start_epoch[job] = epoch
#endif
}

inline obey() {
  if
  :: MOVE(store, none, stored, is_new(f_j[i]) && !revoked); job = f_j[i]; token = 0
  :: MOVE(prepare, stored, prepared, same); tokens++; token = tokens
  :: MOVE(start, prepared, running, same && token_holds && is_new(job) && key_holds_at_start); move_the_arm()
#ifdef MUTANT_NO_MEMORY_NO_TOKEN
  :: (f_c[i] == start && state == ended && same) -> state = running; move_the_arm()
#endif
  :: MOVE(cancel, stored, none, same); memory[job] = cancelled; job = 0; token = 0
  :: MOVE(cancel, prepared, none, same); memory[job] = cancelled; job = 0; token = 0
  :: MOVE(clear_result, ended, none, same); job = 0
  :: else -> skip
  fi
}

inline deliver() {
  if
  :: (f_c[i] == claim && f_e[i] > epoch && (lease == 0 || lease == f_p[i] || f_take[i])) -> grant()
  :: (f_c[i] != claim && fence_holds && owner_holds) -> obey()
  :: else -> skip
  fi
}

/* Without power only the store stays. */
inline cut_power() {
  lease = 0; job = 0; state = none; token = 0; connected[1] = 0; connected[2] = 0
#if COPIES
  ; boots++
#endif
#ifdef MUTANT_FORGETS
  ; epoch = 0; memory[1] = unknown_job; memory[2] = unknown_job
#endif
}

inline lose_store() {
  epoch = 0; memory[1] = unknown_job; memory[2] = unknown_job; store_id++
}

#if COPIES
inline copy_store() {
  copied = 1; c_epoch = epoch; c_memory[1] = memory[1]; c_memory[2] = memory[2]; c_boots = boots;
  c_grant_of[1] = grant_of[1]; c_grant_of[2] = grant_of[2]; c_grant_of[3] = grant_of[3];
  c_start_epoch[1] = start_epoch[1]; c_start_epoch[2] = start_epoch[2]
}
inline bring_copy_back() {
  epoch = c_epoch; memory[1] = c_memory[1]; memory[2] = c_memory[2]; boots = c_boots + 1;
  grant_of[1] = c_grant_of[1]; grant_of[2] = c_grant_of[2]; grant_of[3] = c_grant_of[3];
  start_epoch[1] = c_start_epoch[1]; start_epoch[2] = c_start_epoch[2]
#if MARKS && !MARKS_BACK
  ; store_id++                                         /* the cell finds it */
#endif
}
#define outside(j) (memory[j] != started || c_memory[j] == started || start_epoch[j] > c_epoch)
#if MARKS && MARKS_BACK && !defined(MUTANT_ANY_COPY)
#define fits (outside(1) && outside(2))
#else
#define fits 1
#endif
#endif

active proctype Cell() {
  byte i;
end:
  do
  :: atomic { f_c[0] != no_cmd -> i = 0; deliver(); if :: forget(0) :: skip fi; i = 0 }   /* or once more later */
  :: atomic { f_c[1] != no_cmd -> i = 1; deliver(); if :: forget(1) :: skip fi; i = 0 }
  :: atomic { f_c[0] != no_cmd -> forget(0) }
  :: atomic { f_c[1] != no_cmd -> forget(1) }
  :: atomic { state == running -> state = ended }
  :: atomic { lease != 0 -> lease = 0; if :: state == prepared -> state = stored; token = 0 :: else -> skip fi }
  :: atomic { cuts < CUTS -> cuts++; cut_power() }
#if REVOKES
  :: atomic { !revoked -> revoked = 1 }
#endif
#if LOSSES
  :: atomic { losses < LOSSES -> losses++; cut_power(); lose_store() }
#endif
#if COPIES
  :: atomic { !copied -> copy_store() }
  :: atomic { (copied && copies < COPIES && fits) -> copies++; cut_power(); bring_copy_back() }
#endif
  od
}

#ifdef MUTANT_NO_OWNER
#define owns (connected[p] && epoch == j_epoch[p])
#else
#define owns (connected[p] && epoch == j_epoch[p] && lease == p)
#endif

/* The journal survives, all else is forgotten. */
#define killed kills++; cancelling = 0; connected[p] = 0; knows = 0
#if BACKS
inline copy_journal() {
  atomic { jc_is[p] = 1; jc_epoch[p] = j_epoch[p]; jc_word[j] = j_word[j]; jc_store[p] = j_store[p] }
}
#define COPY_JOURNAL if :: !jc_is[p] -> copy_journal() :: skip fi
#define MAY_BE_KILLED \
  :: kills < KILLS -> killed; goto boot \
  :: backs < BACKS && jc_is[p] -> \
     atomic { backs++; killed; j_epoch[p] = jc_epoch[p]; j_word[j] = jc_word[j]; j_store[p] = jc_store[p]; goto boot }
#else
#define COPY_JOURNAL skip
#define MAY_BE_KILLED :: kills < KILLS -> killed; goto boot
#endif
/* START may have been sent: this process has written that it would, or it has taken the job up and not asked yet. */
#ifdef MUTANT_TRUSTS_JOURNAL
#define may_have_sent (j_word[j] == starting)
#else
#define may_have_sent (j_word[j] == starting || !knows)
#endif
#define MAY_BE_CANCELLED :: cancels < CANCELS && !cancelling -> cancels++; cancelling = 1; goto withdraw
#define MAY_LOSE_LINK :: !connected[p] -> goto boot

/* The word is said; it must be true. */
inline say(w) {
  atomic {
    assert(!is_final(j_word[j]));
    j_word[j] = w;
    assert(w != STARTED || starts[j] == 1);
    assert(w != NOT_STARTED || starts[j] == 0)
  }
}

proctype Dispatcher(byte p; byte first; byte last) {
  byte j = first; byte t; bit cancelling; bit take; bit knows = 1;
boot:
  if :: is_final(j_word[j]) -> goto done :: else -> skip fi;
  COPY_JOURNAL;
  atomic {
    connected[p] = 1;
    if
    :: j_store[p] == 0 -> j_store[p] = store_id
#ifndef MUTANT_NO_STORE_ID
    :: (j_store[p] != 0 && j_store[p] != store_id) -> goto store_lost
#endif
    :: else -> skip
    fi;
    if :: epoch >= j_epoch[p] -> j_epoch[p] = epoch + 1 :: else -> j_epoch[p]++ fi
  }
  if :: j_epoch[p] > EPOCHS -> goto give_up :: else -> skip fi;
  take = (p == 2);                                            /* the second one has the code of the panel */
  send(claim, p, j_epoch[p], 0, 0, take);
  do
  :: owns -> break
  :: connected[p] && !owns -> send(claim, p, j_epoch[p], 0, 0, take)
  :: connected[p] && epoch >= j_epoch[p] && lease != p -> goto give_up      /* LEASE_BUSY, STALE_EPOCH */
  MAY_LOSE_LINK
  MAY_BE_KILLED
  od;
  /* QUERY, after the fence */
  atomic {
    if :: !connected[p] -> goto boot :: else -> skip fi;
#if COPIES && !defined(MUTANT_NO_GRANT)
    if :: (j_granted[p] != 0 && grant_of[j_granted[p]] != j_grant[p]) -> goto store_lost :: else -> skip fi;
    if :: owns -> j_granted[p] = epoch; j_grant[p] = grant_of[epoch] :: else -> skip fi;
#endif
#if COPIES && !MARKS && !defined(MUTANT_RESTART_IS_NOTHING)
    if :: (memory[j] == unknown_job && j_word[j] == starting && boots != j_boots[p]) -> goto give_up :: else -> skip fi;
#endif
    if
    :: memory[j] == started -> goto is_started
    :: memory[j] == cancelled -> goto is_not_started
    :: memory[j] == unknown_job && may_have_sent -> if :: goto is_not_started :: skip fi    /* or again */
    :: else -> skip
    fi;
    if :: owns -> knows = 1 :: else -> skip fi;
    if :: cancelling -> goto withdraw :: else -> skip fi;
    j_word[j] = preparing
  }
  COPY_JOURNAL;
  do
  :: owns && state == ended && job != j -> send(clear_result, p, j_epoch[p], job, 0, 0)
  :: owns && (state == stored || state == prepared) && job != j -> send(cancel, p, j_epoch[p], job, 0, 0)
  :: owns && state == none -> send(store, p, j_epoch[p], j, 0, 0)
  :: owns && state == stored && job == j -> send(prepare, p, j_epoch[p], j, 0, 0)
  :: atomic { owns && state == prepared && job == j -> t = token }; break
  :: connected[p] && !owns -> goto boot
  MAY_LOSE_LINK
  MAY_BE_KILLED
  MAY_BE_CANCELLED
  od;
  atomic {                                                    /* written before START is sent */
    j_word[j] = starting
#if COPIES
    ; j_boots[p] = boots
#endif
  }
  if MAY_BE_KILLED MAY_BE_CANCELLED :: skip fi;
  send(start, p, j_epoch[p], j, t, 0);
  if MAY_BE_KILLED MAY_BE_CANCELLED :: skip fi;
  do
  :: connected[p] && memory[j] == started -> goto is_started
#ifdef MUTANT_NAIVE
  :: connected[p] && memory[j] != started -> goto is_not_started
#else
  :: connected[p] && memory[j] != started -> goto boot        /* no answer in time: fence, then ask */
#endif
  MAY_LOSE_LINK
  MAY_BE_KILLED
  MAY_BE_CANCELLED
  od;
withdraw:
#ifndef MUTANT_CANCEL_UNCONFIRMED
  if :: may_have_sent && !owns -> goto boot :: else -> skip fi;            /* fence, then ask */
  do
  :: owns && job == j && (state == stored || state == prepared) -> send(cancel, p, j_epoch[p], j, 0, 0)
  :: atomic { connected[p] && memory[j] == cancelled -> goto is_not_started }
  :: atomic { connected[p] && memory[j] == started -> goto is_started }
  :: atomic { owns && job != j && memory[j] == unknown_job && !may_have_sent -> goto is_not_started }
  :: !may_have_sent -> goto is_not_started                    /* START was never sent */
  :: may_have_sent -> goto boot
  MAY_BE_KILLED
  od;
#else
  goto is_not_started;
#endif
store_lost:
give_up:
  if :: may_have_sent -> say(UNKNOWN) :: else -> say(NOT_STARTED) fi;
  goto done;
is_not_started:
  say(NOT_STARTED);
  goto done;
is_started:
  say(STARTED);
done:
#ifdef NEVER_STARTED
  assert(j_word[j] != STARTED);
#endif
#ifdef NEVER_NOT_STARTED
  assert(j_word[j] != NOT_STARTED);
#endif
#ifdef NEVER_UNKNOWN
  assert(j_word[j] != UNKNOWN);
#endif
  cancelling = 0; knows = 1;
  if :: j < last -> j++; goto boot :: else -> skip fi
}

init {
  atomic {
    if
    :: PCS == 1 -> run Dispatcher(1, 1, JOBS)
    :: else -> run Dispatcher(1, 1, 1); run Dispatcher(2, 2, 2)
    fi
  }
}
