// What outputs, inputs and calls of a program do to spindle and extraction.
//
// Kept twice: as executed, and as if the chunk had been started alone, with everything off before it: a chunk may be
// started alone, so that what it cuts needs its own switching on. O(1) per step
// (tests/sim/replay/stated_values_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/finding.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// Programs of the cell file that a program may call (read_program.h).
std::vector<std::string> called_programs(const Cell& cell);

class SignalWalk {
 public:
    // Both outlive this object.
    SignalWalk(const CellMachine& machine, FindingLog& log) : machine_(machine), log_(log) {}

    void enter_chunk() { alone_ = {}; }
    // An output, an input, a call or a word of its language; `name` is the number or the name of the signal, or the
    // name of the program, in lower case.
    void take(const ProgramStep& step, const std::string& name);
    // Of the chunk started alone.
    const SignalState& in_chunk() const { return alone_; }
    // Finds it if spindle or extraction is on, and says which line was expected; `when` completes "is still on ".
    void check_off(FindingKind kind, SourcePlace place, const std::string& when) const;

 private:
    void take_output(const ProgramStep& step, const std::string& name);
    void take_speed(double rpm);
    void take_call(const ProgramStep& step, const std::string& called);
    void switch_spindle(bool is_on);
    void switch_extraction(bool is_on);
    void reach_speed();
    void refuse(const ProgramStep& step, const std::string& what, const std::string& name) const;

    const CellMachine& machine_;
    FindingLog& log_;
    SignalState now_;
    SignalState alone_;
};

}  // namespace qchopper
