// The module of one chunk of a RAPID program: its data, settings, moves of some runs of an operation.

#pragma once

#include <cstddef>
#include <string>

#include "cam/cell/cell.h"
#include "cam/post/dialect_post.h"
#include "cam/post/rapid_text.h"
#include "cam/program/program.h"

namespace qchopper {

// Names that the main module declares and all modules use.
struct RapidNames {
    std::string piece;  // "qc_7"
    std::string tool(std::uint16_t number) const { return piece + "_t" + std::to_string(number); }
    std::string work_object() const { return piece + "_w"; }
    std::string interrupt() const { return piece + "_i"; }
    std::string trap() const { return piece + "_fell"; }
};

// The procedure of a chunk's module.
inline std::string rapid_procedure(const std::string& module) {
    return module + "_run";
}

class RapidChunks {
 public:
    // `program` and `cell` outlive this object.
    RapidChunks(const Program& program, const Cell& cell, std::string piece)
        : program_(program), machine_(*cell.machine), names_{std::move(piece)} {}

    RapidText chunk(const RunRange& range, const std::string& name, std::size_t order, std::size_t total) const;

    // What is stated until another line changes it: mm/s and mm; 0: not stated.
    struct Stated {
        double speed = 0;
        double rounding = 0;
    };
    RapidText run(const ProgramOperation& operation, const ProgramRun& run, Stated& stated) const;

    const RapidNames& names() const { return names_; }
    // Speed and acceleration of joint moves: shares of the largest.
    void add_joint_speeds(RapidText& text) const;
    // A joint move; angle of the table in radians.
    void add_joint_move(std::size_t tool, const Joints& joints, double table_angle, RapidText& text) const;

 private:
    void add_data(const ProgramOperation& operation, const ProgramRun& first, RapidText& text) const;
    void add_watch(RapidText& text) const;
    void add_line(const ProgramOperation& operation, const std::string& position, bool is_rounded,
                  RapidText& text) const;
    void add_end(const RunRange& range, Stated& stated, RapidText& text) const;

    const Program& program_;
    const CellMachine& machine_;
    RapidNames names_;
};

}  // namespace qchopper
