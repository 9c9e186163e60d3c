// A viewer's file of a job: where the program leads the tool, and the piece as the replay left it, as GLB.
//
// The path as lines, a colour for each orientation; the surface of the piece, coloured by its deviation
// (deviation_colours.h). At most carved_view_faces triangles and carved_view_points points of lines, so that the file
// stays below 12 MB: a finer mesh is clustered, a longer path loses points within a tolerance that is doubled until it
// is short enough. Same input, same bytes (tests/app/pictures/carved_view_test.cpp).

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::size_t carved_view_faces = 200'000;
constexpr std::size_t carved_view_points = 200'000;

// Lines of the tip in one orientation, mm in the frame of the mesh.
struct OrientationPath {
    std::size_t orientation = 0;
    std::vector<std::vector<Vec3>> lines;  // each of at least two points
};

struct CarvedScene {
    std::string generator;
    const TriangleMesh* mesh = nullptr;  // not null, with a triangle; owned by the caller
    std::span<const float> deviation;    // mm, per triangle
    std::vector<bool> is_given_up;       // per triangle, or empty
    std::vector<OrientationPath> paths;
};

struct CarvedView {
    Bytes glb;
    std::size_t faces = 0;
    std::size_t points = 0;     // of the lines
    double path_tolerance = 0;  // mm by which a line may be off the path; 0: none is
    double mesh_shift = 0;      // mm by which a point of the surface is moved, at most; 0: none is
};

CarvedView carved_view(const CarvedScene& scene, const Context& context = {});

// The line without points that lie within `tolerance` (mm) of it: Ramer 1972, Douglas and Peucker 1973. The ends stay.
std::vector<Vec3> thinned(const std::vector<Vec3>& line, double tolerance);

}  // namespace qchopper
