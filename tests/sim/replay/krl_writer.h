// Writes small KRL programs for tests of the reader and of the replay; it shares no code with cam/post.

#pragma once

#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/scene.h"

namespace qchopper {

struct WrittenMove {
    Vec3 tip;  // setup coordinates
    double feed = 100;
    bool is_rounded = false;
};

struct WrittenChunk {
    std::uint16_t tool = 1;  // its number
    std::size_t orientation = 0;
    double rpm = 15000;
    std::vector<WrittenMove> moves;  // the first is above the foam: a PTP leads there
    std::string operation = {};      // empty: no comment says it
};

struct WrittenJob {
    std::vector<SceneOrientation> orientations;
    std::vector<WrittenChunk> chunks;
    double rounding = 2;
    double acceleration = 2;  // m/s2
};

// qc_1.src, qc_1.dat, qc_1_001.src and so on. Throws std::runtime_error where the arm does not hold a first point.
std::vector<ProgramFile> written(const Cell& cell, const WrittenJob& job);

// What the job says of the chunks.
std::vector<SceneChunk> chunks_of(const WrittenJob& job);

// The pose of a setup on the middle of the cell's table, `height` above it, turned by `table_angle` with a rotary
// table.
Pose on_table(const Cell& cell, double height, double table_angle = 0);

}  // namespace qchopper
