// The plan: the cuts of a project as a small text file, to be made again on another version of the same specimen.
//
// Lengths are millimetres in the scan's own frame: the coordinates of its file times unit and scale, not shifted. A
// plan that is written and read again is the same plan (tests/app/store/plan_test.cpp). docs/user/plan-file.md is the
// grammar.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/store/project.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// On which side of an earlier cut a piece lies.
struct PathSide {
    std::int32_t cut = 0;
    bool above = true;
    bool operator==(const PathSide&) const = default;
};

// What identifies a piece on another version of the scan.
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
    Weights weights;  // in force when it was written
    std::vector<PlanCut> cuts;
    std::vector<PlanDiscard> discards;  // in their order
    bool operator==(const Plan&) const = default;
};

// The cuts and discards in force. `scan` is the imported scan of the project. Throws InputError (mesh) if a piece has
// no interior point.
Plan make_plan(const Project& project, const TriangleMesh& scan);

// Control characters of texts are replaced by "?".
std::string to_text(const Plan& plan);

// `file` is the name in messages. Throws InputError (config) naming file, line, key and why.
Plan plan_from_text(std::string_view text, const std::string& file);

// Throws what read_file and plan_from_text throw.
Plan read_plan(const std::filesystem::path& file);

// Whether a text begins with the first line that to_text writes.
bool has_plan_header(std::string_view text);

}  // namespace qchopper
