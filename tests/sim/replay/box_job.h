// A small job that mills a box out of a block with a flat tool, in two chunks: its top and its sides.

#pragma once

#include "tests/sim/replay/krl_writer.h"

namespace qchopper {

struct BoxJob {
    Cell cell;
    TriangleMesh target;
    std::vector<bool> is_unmilled;
    WrittenJob job;
    Box block;
    std::vector<SceneCap> caps;
    ReplayScene scene() const;
    std::vector<ProgramFile> files() const { return written(cell, job); }
};

// In a ready cell, "kr60-ha" or "kr120-r2500-pro-rotary".
BoxJob box_job(const std::string& cell_name);

// The same piece, whose sides in x are caps: the block ends at that of cut 1, in +x, and has a margin at that of cut 2.
BoxJob sawn_box_job(const std::string& cell_name);

// The program of these files, read with the calls of the cell.
ParsedProgram read_back(const BoxJob& job, const std::vector<ProgramFile>& files);

}  // namespace qchopper
