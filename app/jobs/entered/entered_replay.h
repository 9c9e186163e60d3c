// Puts the values that a person enters at the controller into what is replayed: the cell, the program as it was read,
// and the scene. The program states them as if they had been entered; block, piece and tools are where they say.
//
// mm. Precondition of all: difference_from_plan() took the values for this job and this cell
// (tests/app/jobs/entered_values_test.cpp). Throws nothing.

#pragma once

#include "app/jobs/entered/entered_values.h"

namespace qchopper {

struct ParsedProgram;
struct ProofInput;
struct ReplayScene;

// The cell in which the tools have their entered lengths: the tip is moved against the holder.
Cell cell_with(const EnteredValues& values, const Cell& cell);

// Bases that are the planned one become the entered one; in the chunks of a tool its frame is moved along the tool axis
// where it is the planned one. Others stay, and are findings of the replay. O(steps).
void enter_in_program(const EnteredValues& values, const ProofInput& planned, ParsedProgram& program);

// The block stands where the entered base says, and joint moves stay where they were planned. `entered` is cell_with()
// and must outlive the scene.
void enter_in_scene(const EnteredValues& values, const ProofInput& planned, const Cell& entered, ReplayScene& scene);

}  // namespace qchopper
