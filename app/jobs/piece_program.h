// Makes the robot program of a piece and proves it: toolpath, program, text, and the replay of the text.
//
// The toolpath depends on the piece and its setup alone, and whether the arm follows it is known long before the
// program is proven; so these steps can be taken one by one, and what the first one gives can be kept
// (kept_toolpaths.h). The proof is the one that verify makes (job_proof.h), of the same texts and of the mesh as it
// stands in the job file.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/jobs/job_proof.h"
#include "app/jobs/setups.h"
#include "base/context.h"
#include "cam/job/job.h"
#include "cam/job/job_cap.h"
#include "cam/job/job_program.h"
#include "cam/post/post.h"
#include "cam/stock/in_process_stock.h"
#include "cam/toolpath/toolpath.h"
#include "cam/toolpath/toolpath_settings.h"
#include "segment/cut/piece.h"

namespace qchopper {

struct ProvenProgram {
    ProgramInput input;  // JobPart::before is not known yet
    JobProof proof;
};

// A toolpath that the arm follows, or why there is none.
struct FollowedToolpath {
    Toolpath toolpath;
    std::vector<RemovedFoam> removed;          // by it, on cells of a mm or more: by this holes are drilled
    std::optional<BlockPlacement> place = {};  // where the block has to stand, if not where the setup has it
    std::string none_because = {};             // for people, without a full stop; empty: there is one
    bool is_machine_refusing = false;          // there is none because the arm does not follow it
};

struct PiecePrograms {
    std::vector<ProvenProgram> parts;  // in their order; empty: no program
    std::string none_because;          // for people, without a full stop
    std::vector<DrawnCap> caps;        // of the piece, with who drills each hole (decide_holes())
    // Where the block has to stand for them, if that is not where the setup has it.
    std::optional<BlockPlacement> place = {};
    bool is_machine_refusing = false;  // there is none because the arm does not follow the toolpath (ProgramRefused)
};

// How the files of a job's program are named: by the first six digits of the project's id and the piece's number.
ProgramName program_name(const JobInput& job);

// Numbers of the tools that remove foam too fast (FindingKind::removal_rate) in programs that their proofs refuse for
// nothing else; else none.
std::set<std::uint16_t> too_fast_tools(const std::vector<ProvenProgram>& parts);

// Empty for a cell for whose jobs programs can be made, else why not: no machine, or a dialect that cannot be written.
std::string no_programs_for(const Cell& cell);

// The first step: the toolpath, and where the block has to stand so that the arm follows it. Where the machine cannot
// follow the toolpath the block is placed again, so that it holds the poses of the toolpath too; where that does not
// help there is none. `feed_shares` as in ToolpathSettings. Preconditions: the known setup is that of the piece and
// fits, the cell has the tools of its setup and others, no_programs_for(cell) is empty. Throws Cancelled.
FollowedToolpath follow_toolpath(const Piece& piece, const PlacedSetup& known, const Cell& cell, const Context& context,
                                 FineTools fine = FineTools::worthwhile,
                                 const std::map<std::uint16_t, double>& feed_shares = {});

// All steps, or those after the first if its result is given. The caps are those of the piece (caps_of()): of their
// holes those that the robot can drill are drilled after finishing. Where a program cannot be made with a hole, this
// hole is left to the hand. Preconditions: those of follow_toolpath(), of which `followed` is the result for the same
// arguments, and the number of the piece is at least 1. Where there is no program, none_because says why. Where the
// proof finds only that tools remove foam too fast, the programs are made again with less feed of these, which is told
// as a message. Throws Cancelled.
PiecePrograms make_programs(const Piece& piece, const PlacedSetup& known, const ProgramName& name, const Cell& cell,
                            const std::vector<DrawnCap>& caps, const Context& context,
                            FineTools fine = FineTools::worthwhile, std::optional<FollowedToolpath> followed = {});

// Caps of a piece that gets no program.
std::vector<DrawnCap> caps_by_hand(std::vector<DrawnCap> caps, const std::string& none_because);

}  // namespace qchopper
