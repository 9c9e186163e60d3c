// Takes in a scan: the whole way from a file to a closed solid in millimetres about its own centre.
//
// The mesh that comes out is closed, its outer shells face outwards, and mesh point + centre is the file's point times
// mm_per_unit and scale (tests/segment/intake/intake_test.cpp). Nothing is moved but by that shift.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "segment/context.h"
#include "segment/files/sha256.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

enum class Unit { mm, cm, m, in };

double mm_per(Unit unit);
std::string name_of(Unit unit);

// "mm", "cm", "m" or "in". Throws InputError (use) for anything else.
Unit unit_named(std::string_view name);

struct IntakeOptions {
    double mm_per_unit = 1;  // what one unit of the file is; mm_per(unit_named(...))
    double scale = 1;        // the operator's enlargement; other than 1 it is reported as a warning
};

struct IntakeReport {
    std::size_t faces_in = 0;              // triangles, after polygons are split
    std::size_t points_in = 0;             // as the file has them
    std::size_t welded = 0;                // points that became one with another
    std::size_t collapsed_dropped = 0;     // triangles with two corners in one point
    std::size_t unreferenced_dropped = 0;  // points in no triangle
    std::size_t pinched_split = 0;         // copies made of points where surfaces only touch
    std::size_t shells = 0;
    std::size_t cavities = 0;       // shells that face inwards, kept so
    std::size_t shells_turned = 0;  // outer shells that were inside out
    std::size_t holes_filled = 0;
    std::size_t triangles_added = 0;
    std::vector<std::string> warnings;  // whole sentences for the operator
};

struct Intake {
    TriangleMesh mesh;  // mm, about its own centre
    Vec3 centre;        // mm: what was subtracted, the middle of the scan's box
    Sha256 sha256{};    // of the file's bytes
    IntakeReport report;
};

// Throws InputError: (missing) no such file, (mesh) a scan that is wrong or cannot be closed, (use) impossible options.
Intake take_in(const std::filesystem::path& path, const IntakeOptions& options, const Context& context = {});

}  // namespace qchopper
