// The plan: the cuts of a project as a small text file, to be made again on another version of the same specimen.
//
// Lengths are millimetres in the scan's own frame: the coordinates of its file, times unit and scale, not moved to any
// centre. Written and read again a plan is the same plan (tests/app/project/plan_test.cpp). docs/plan-file.md is the
// grammar.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/project/project.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// On which side of an earlier cut a piece lies.
struct PathSide {
    std::int32_t cut = 0;
    bool above = true;
    bool operator==(const PathSide&) const = default;
};

// By what a piece is found again.
struct PlanPiece {
    std::string piece;           // its name where the plan was made
    std::vector<PathSide> path;  // where it lies in the BSP
    Vec3 inside;                 // a point deep in it
    double volume_mm3 = 0;
    bool operator==(const PlanPiece&) const = default;
};

// The piece is that before the cut.
struct PlanCut : PlanPiece {
    std::int32_t number = 0;
    Plane plane;                    // in the scan's own frame
    double from_centre = 0;         // the same offset counted from PlanScan::centre, exact to the last bit
    std::vector<double> makes_mm3;  // volumes of the pieces that the cut made, largest first
    bool operator==(const PlanCut&) const = default;
};

// A piece that is discarded.
struct PlanDiscard : PlanPiece {
    std::int32_t after = 0;  // the number of the cut that it follows; 0: before all
    bool operator==(const PlanDiscard&) const = default;
};

// The scan that the plan was made on.
struct PlanScan {
    std::string name;
    std::string sha256;
    Unit unit = Unit::mm;
    double scale = 1;
    Vec3 centre;
    std::size_t faces = 0;
    double volume_mm3 = 0;
    Box box;
    bool operator==(const PlanScan&) const = default;
};

struct Plan {
    PlanScan scan;
    Weights weights;  // that stood when it was written
    std::vector<PlanCut> cuts;
    std::vector<PlanDiscard> discards;  // in their order
    bool operator==(const Plan&) const = default;
};

// The cuts that stand, and what is discarded. Throws InputError (mesh) if a piece has no inside.
Plan make_plan(const Project& project, const TriangleMesh& scan);

std::string to_text(const Plan& plan);

// Throws InputError (config) naming file, line, key and why.
Plan plan_from_text(std::string_view text, const std::string& file);

// Does a file begin as a plan does?
bool looks_like_a_plan(std::string_view text);

}  // namespace qchopper
