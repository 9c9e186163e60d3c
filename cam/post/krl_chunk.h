// The lines of one chunk of a KRL program: header, settings, moves of some runs of an operation.

#pragma once

#include <cstddef>
#include <string>

#include "cam/cell/cell.h"
#include "cam/post/dialect_post.h"
#include "cam/post/krl_config.h"
#include "cam/post/krl_text.h"
#include "cam/program/program.h"

namespace qchopper {

class KrlChunks {
 public:
    // Both outlive this object. Precondition: check_signals() holds.
    KrlChunks(const Program& program, const Cell& cell, const std::string& piece)
        : program_(program), machine_(*cell.machine), names_{piece} {}

    const KrlNames& names() const { return names_; }

    // The whole text of a chunk. `order` counts from 0 over all parts; `total` is their number.
    KrlText chunk(const RunRange& range, const std::string& name, std::size_t order, std::size_t total) const;

    // What is stated until another line changes it: mm/s and mm; 0: not stated.
    struct Stated {
        double speed = 0;
        double rounding = 0;
    };
    // The moves of one run, from its start. `stated` is what holds before it, and then after it.
    KrlText run(const ProgramOperation& operation, const ProgramRun& run, bool is_first, Stated& stated) const;

    // Load and tool of an operation.
    void add_tool(std::size_t tool, KrlText& text) const;
    // A joint move; angle of the table in radians.
    void add_joint_move(const Joints& joints, double table_angle, KrlText& text) const;
    // Speeds and accelerations of the axes, that of the table included.
    void add_axis_speeds(KrlText& text) const;

 private:
    void add_base(KrlText& text) const;
    void add_settings(const ProgramOperation& operation, KrlText& text) const;
    std::string full_pose(const ProgramOperation& operation, Vec3 tip) const;

    const Program& program_;
    const CellMachine& machine_;
    KrlNames names_;
};

}  // namespace qchopper
