// Surface that a person has painted on a scan in the page: as strokes, and as the files that --ignore-surface and
// --no-cut read.
//
// Lengths in mm in the coordinates of the scan's file (tests/app/console/strokes_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "base/enum_names.h"
#include "base/files/file.h"
#include "base/json_fields.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

enum class StrokeSurface { ignore, no_cut, clear };

struct Stroke {
    StrokeSurface surface = StrokeSurface::clear;
    double radius_mm = 0;
    std::vector<std::vector<double>> points;  // six numbers each: a place, and the normal of the side that was seen
    bool operator==(const Stroke&) const = default;
};

constexpr auto names_of(StrokeSurface) {
    return EnumNames<StrokeSurface, 3>{
        {{StrokeSurface::ignore, "ignore"}, {StrokeSurface::no_cut, "no_cut"}, {StrokeSurface::clear, "clear"}}};
}
// Rules of its table: why a value is refused, or nullptr.
const char* is_stroke_radius(double radius);
const char* are_stroke_points(const std::vector<std::vector<double>>& points);

template <class V, Of<Stroke> T>
void fields(V& v, T& stroke) {
    v("surface", stroke.surface);
    v("radius_mm", stroke.radius_mm, is_stroke_radius);
    v("points", stroke.points, are_stroke_points);
}

// Throws InputError (use) for what is no list of strokes as the page sends them.
std::vector<Stroke> read_strokes(const std::string& json);
std::string to_json(const std::vector<Stroke>& strokes);

// Per point of the mesh what the last stroke makes of it that comes within its radius on the side of the point's
// normal; clear where none does.
std::vector<StrokeSurface> painted_points(const TriangleMesh& mesh, const std::vector<Stroke>& strokes);

// A binary PLY of the mesh whose vertices of that surface have the property mask; empty if there is none.
Bytes masked_ply(const TriangleMesh& mesh, const std::vector<StrokeSurface>& painted, StrokeSurface surface);

}  // namespace qchopper
