// Bars are boxes, arrows and points are bodies of revolution of 16 sides. Drawn without ambient light, because rays of
// single precision follow the processor's instruction set and the job must not. O(triangles + samples) a picture: 0.24
// s of processor time for both at 100,000 faces, 0.43 s at 1.9 million.

#include "cam/job/sheet/setup_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "cam/job/glue_faces.h"
#include "cam/job/sheet/solid_shapes.h"
#include "cam/job/sheet/touch_points.h"
#include "segment/picture/picture.h"

namespace qchopper {
namespace {

constexpr std::array states{SurfaceState::reached, SurfaceState::too_narrow, SurfaceState::steep,
                            SurfaceState::holder,  SurfaceState::hidden,     SurfaceState::ignored};
constexpr std::uint8_t base_index = states.size();  // in the palette, after the states

constexpr Rgb bar_colour{105, 110, 120};
constexpr Rgb arrow_colour{70, 75, 85};
constexpr Rgb touch_colour{25, 27, 30};

TriangleMesh bars_of(const Setup& setup, double width) {
    TriangleMesh bars;
    Box box = setup.block_box();
    for (const Box& edge : edges_of(box)) add_bar(bars, edge, width / 2);
    if (setup.spoil <= 0) return bars;
    box.max.z = 0;  // where the piece is parted from the spoil layer
    for (const Box& edge : edges_of(box)) {
        if (edge.min.z == 0 && edge.max.z == 0) add_bar(bars, edge, width / 2 / 2);
    }
    return bars;
}

// From outside towards the middle of the piece, its tip just outside of the block.
TriangleMesh arrow(const Setup& setup, Vec3 tool_axis, double diagonal) {
    const Box block = setup.block_box();
    const Vec3 middle = setup.box.centre();
    double inside = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(tool_axis[axis]) < 1e-9) continue;
        const double side = tool_axis[axis] > 0 ? block.max[axis] : block.min[axis];
        inside = std::min(inside, std::max(0.0, (side - middle[axis]) / tool_axis[axis]));
    }
    const double length = 0.24 * diagonal;
    const double head = 0.09 * diagonal;
    const Vec3 tail = middle + (inside + 0.015 * diagonal + length) * tool_axis;
    const double shaft = 0.010 * diagonal;
    return turned_profile(tail, -tool_axis,
                          {{0, 0}, {0, shaft}, {length - head, shaft}, {length - head, 0.03 * diagonal}, {length, 0}});
}

std::vector<std::uint8_t> colours_of(const JobInput& input, const TriangleMesh& lying) {
    assert(input.states.empty() || input.states.size() == lying.triangles.size());
    std::vector<std::uint8_t> colours(lying.triangles.size());
    for (std::size_t t = 0; t < colours.size(); ++t) {
        if (!input.states.empty()) colours[t] = static_cast<std::uint8_t>(input.states[t]);
        if (input.setup.base && cap_of(lying, t) == *input.setup.base) colours[t] = base_index;
    }
    return colours;
}

// The piece apart from the caps in glue faces, and those of each such face with the names of its neighbours.
struct PartedSurface {
    TriangleMesh rest;
    std::vector<std::uint8_t> colours;  // per triangle of the rest
    std::vector<TriangleMesh> caps;     // by `faces`
    std::vector<GlueFace> faces;
};

PartedSurface parted(const JobInput& input, const TriangleMesh& lying, const std::vector<std::uint8_t>& colours) {
    PartedSurface surface;
    std::vector<JobCap> joined;
    for (const DrawnCap& drawn : input.caps) joined.push_back(drawn.cap);
    surface.faces = glue_faces(input.setup, joined);
    surface.caps.resize(surface.faces.size());
    surface.rest.points = lying.points;
    for (TriangleMesh& cap : surface.caps) cap.points = lying.points;
    for (std::size_t t = 0; t < lying.triangles.size(); ++t) {
        const auto holds = [&](const GlueFace& face) {
            return std::binary_search(face.cuts.begin(), face.cuts.end(), cap_of(lying, t));
        };
        const auto face = std::find_if(surface.faces.begin(), surface.faces.end(), holds);
        if (face != surface.faces.end()) {
            surface.caps[static_cast<std::size_t>(face - surface.faces.begin())].triangles.push_back(
                lying.triangles[t]);
            continue;
        }
        surface.rest.triangles.push_back(lying.triangles[t]);
        surface.rest.cap_of.push_back(cap_of(lying, t));
        surface.colours.push_back(colours[t]);
    }
    return surface;
}

}  // namespace

Rgb surface_colour(SurfaceState state, bool narrow_counts) {
    switch (state) {
        case SurfaceState::reached:
            return bone_colour;
        case SurfaceState::too_narrow:
            return narrow_counts ? Rgb{20, 105, 215} : Rgb{165, 200, 235};
        case SurfaceState::steep:
            return {250, 195, 0};
        case SurfaceState::holder:
            return {105, 25, 115};
        case SurfaceState::hidden:
            return {205, 50, 15};
        case SurfaceState::ignored:
            return {150, 155, 160};
    }
    return bone_colour;
}

Rgb glue_colour(BlockFace face) {
    switch (face) {
        case BlockFace::minus_x:
            return {0, 0, 35};
        case BlockFace::plus_x:
            return {140, 255, 100};
        case BlockFace::minus_y:
            return {45, 90, 165};
        case BlockFace::plus_y:
            return {190, 120, 200};
        case BlockFace::top:
            return {0, 215, 80};
    }
    return base_colour;
}

SetupPictures setup_pictures(const JobInput& input, const TriangleMesh& lying) {
    const Setup& setup = input.setup;
    const double diagonal = norm(setup.block.size);
    std::array<Rgb, states.size() + 1> palette;
    for (const SurfaceState state : states) {
        palette[static_cast<std::size_t>(state)] = surface_colour(state, setup.access.narrow_counts);
    }
    palette[base_index] = base_colour;
    const std::vector<std::uint8_t> colours = colours_of(input, lying);
    std::vector<std::pair<TriangleMesh, std::string>> named;  // with what is written on each
    for (const ToolOrientation& orientation : setup.access.orientations) {
        const Vec3 tool_axis = setup.tool_axis(orientation);
        named.emplace_back(arrow(setup, tool_axis, diagonal), std::to_string(named.size() + 1));
    }
    const std::size_t arrows = named.size();
    for (const TouchPoint& point : touch_points(setup))
        named.emplace_back(ball_mesh(point.at, 0.016 * diagonal), point.name);
    const TriangleMesh bars = bars_of(setup, 0.0045 * diagonal);

    std::vector<ColouredMesh> meshes;
    PartedSurface surface;
    if (!setup.flush_caps.empty()) surface = parted(input, lying, colours);
    ColouredMesh piece{surface.faces.empty() ? &lying : &surface.rest, bone_colour, {}};
    piece.palette = palette;
    piece.colour_of = surface.faces.empty() ? colours : surface.colours;
    meshes.push_back(piece);
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const GlueFace& face = surface.faces[f];
        meshes.push_back({&surface.caps[f], glue_colour(face.face), {}, list_of_pieces(face.neighbours)});
    }
    meshes.push_back({&bars, bar_colour, {}});
    for (std::size_t i = 0; i < named.size(); ++i) {
        meshes.push_back({&named[i].first, i < arrows ? arrow_colour : touch_colour, {}, named[i].second});
    }
    const Scene scene(meshes, false);
    PictureOptions options;
    options.width = setup_picture_width;
    options.height = setup_picture_height;
    options.background = {255, 255, 255};
    options.ambient_rays = 0;
    options.outline = 0;
    options.frame = 0.03;
    options.letters = 0.034;  // printed side by side on A4 they are 2 mm high
    SetupPictures pictures;
    options.view = {0.5, 0.8, -0.42};
    pictures.front = render_png(scene, options);
    options.view = {-0.5, -0.8, 0.3};
    pictures.back = render_png(scene, options);
    return pictures;
}

}  // namespace qchopper
