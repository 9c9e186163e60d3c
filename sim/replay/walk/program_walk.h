// What the walks of all machines have in common: chunks, tools, questions, signals, and where the machine must be at
// home.
//
// A walk derives from it and moves the machine. O(1) a step but for that.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/context.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"
#include "sim/replay/signal_walk.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

class ProgramWalk {
 public:
    // All outlive this object.
    ProgramWalk(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log)
        : program_(program), scene_(scene), machine_(*scene.cell->machine), log_(log), signals_(machine_, log) {}
    virtual ~ProgramWalk() = default;

    ToolPath run(const Context& context);

 protected:
    virtual void take_rapid(const ProgramStep& step) = 0;
    virtual void take_line(const ProgramStep& step) = 0;
    virtual void take_tool_change(const ProgramStep& /*step*/) {}
    virtual bool is_home(bool with_table) const = 0;

    void check_stop(SourcePlace place);
    const CuttingTool& tool() const { return machine_.tools[tool_]; }

    // NOLINTBEGIN(readability-identifier-naming): named as private members are
    const ParsedProgram& program_;
    const ReplayScene& scene_;
    const CellMachine& machine_;
    FindingLog& log_;
    SignalWalk signals_;
    std::uint32_t chunk_ = 0;      // index in ReplayScene::chunks
    std::uint32_t direction_ = 0;  // index in ReplayScene::orientations
    std::uint32_t tool_ = 0;       // index in CellMachine::tools
    std::uint32_t use_ = 0;        // index in ToolPath::uses
    bool is_in_chunk_ = false;
    bool has_moved_ = false;
    SourcePlace free_from_home_;  // of the comment, until the first move of its chunk; line 0: there is none
    bool follows_line_ = false;
    ToolPath path_;
    // NOLINTEND(readability-identifier-naming)

 private:
    void enter(const ProgramChunk& chunk);
    void take_tool(std::uint16_t number, SourcePlace place);
    void check_asked(const CuttingTool& tool, SourcePlace place);
    void take(const ProgramStep& step);
    void take_halt(const ProgramStep& step);
    void take_call(const ProgramStep& step);
    void check_end(SourcePlace place);
    void check_retract();
    void use_tool(const std::string& operation);

    bool is_changed_ = false;                  // the tool, and no chunk is entered since
    std::optional<std::uint16_t> asked_tool_;  // by a call with its number
    std::string asked_;                        // by the last question, in lower case
    SourcePlace asked_place_;                  // of that question
    bool has_tool_ = false;
};

}  // namespace qchopper
