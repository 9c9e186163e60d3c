// Holds what the lines of a program state against the cell file and the job: frames, load data, speeds.
//
// A state is held once for each chunk, where its first move stands. O(states)
// (tests/sim/replay/stated_values_test.cpp).

#pragma once

#include <cstdint>
#include <optional>

#include "base/pose.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"

namespace qchopper {

// Where a move stands, and with what.
struct MoveContext {
    std::uint32_t chunk = 0;            // index in ReplayScene::chunks
    std::uint32_t orientation = 0;      // index in ReplayScene::orientations
    const CuttingTool* tool = nullptr;  // nullptr: outside of chunks, where the load of any tool may be stated
    std::uint32_t state = 0;            // index in ParsedProgram::states
    SourcePlace place;
};

class StateCheck {
 public:
    // All outlive this object. `setup_in_table`: of a rotary table.
    StateCheck(const ReplayScene& scene, const Pose& setup_in_table, FindingLog& log);

    void take_line(const ModalState& state, const MoveContext& move);
    void take_joint_move(const ModalState& state, const MoveContext& move);

 private:
    struct Last {
        std::uint32_t chunk = ~0U;
        std::uint32_t state = ~0U;
        bool is_new(const MoveContext& move);
    };
    void check_tool_frame(const ModalState& state, const MoveContext& move);
    void check_base_frame(const ModalState& state, const MoveContext& move);
    void check_load(const ModalState& state, const MoveContext& move);
    void check_limit(const std::string& name, double stated, double most, const char* unit, SourcePlace place);

    const ReplayScene& scene_;
    const CellMachine& machine_;
    const Pose& setup_in_table_;
    FindingLog& log_;
    Last line_;
    Last joint_move_;
};

}  // namespace qchopper
