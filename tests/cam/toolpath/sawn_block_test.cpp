// The toolpath of a piece with glue faces that the saw has made, swept against these faces: as they should be, and with
// the block moved outwards and turned by what a block that is sawn and laid by hand may be off. The faces are small
// triangles, each with its distance from the rim of its cap; nothing is asked of a grid of foam.
//
// What keeps them whole are add_floor_band(), which leaves out the floor beyond a sawn face, and clear_of_sawn_faces(),
// without which contours of the skin go on along the face: up to 11.6 mm from its rim by the 12 mm ball.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>

#include "cam/toolpath/make_toolpath.h"
#include "segment/mesh/measure.h"
#include "sim/replay/gouge.h"
#include "tests/cam/toolpath/toolpath_pieces.h"

namespace qchopper {
namespace {

constexpr double size = 64;
constexpr double spacing = 1;    // mm, between points of a glue face
constexpr double half = 0.25;    // mm, of the triangle about such a point
constexpr double extent = 0.36;  // mm, of it about the point
constexpr double touches = 0.01;

// A body with bumps on top of a flat base, with two sides that are caps: at -x, and at +y.
struct SawnPiece {
    TriangleMesh mesh = test_pieces::bumpy(size, 16, 46, 11);
    Setup setup;

    SawnPiece() {
        std::array<double, 2> area{};
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::array<Vec3, 3> corners = corners_of(mesh, t);
            const auto are_all = [&](const auto& is) { return std::all_of(corners.begin(), corners.end(), is); };
            if (are_all([](Vec3 p) { return p.z == 0; })) mesh.cap_of[t] = 0;
            if (are_all([](Vec3 p) { return p.x == 0; })) mesh.cap_of[t] = 1;
            if (are_all([](Vec3 p) { return p.y == size; })) mesh.cap_of[t] = 2;
            if (mesh.cap_of[t] > 0) area[static_cast<std::size_t>(mesh.cap_of[t] - 1)] += norm(area_vector(mesh, t));
        }
        constexpr double margin = 8;
        setup = test_pieces::setup_of(mesh, margin, 40);
        setup.access.orientations.push_back({{-std::sin(0.7), 0, std::cos(0.7)}, 40, 0, 0});
        setup.base = 0;
        setup.flush_caps = {{1, BlockFace::minus_x, area[0]}, {2, BlockFace::plus_y, area[1]}};
        setup.block.size = setup.block.size - Vec3{margin, margin, 0};
        const Vec3 by{-0.5 * margin, 0.5 * margin, 0};
        setup.piece_in_setup.shift = setup.piece_in_setup.shift + by;
        setup.box = {setup.box.min + by, setup.box.max + by};
    }
};

// Points of the two caps, in setup coordinates.
struct GlueFaces {
    struct Point {
        Vec3 at;
        Vec3 outward;
        Vec3 middle;  // of its face
        double from_rim = 0;
    };
    std::vector<Point> points;

    explicit GlueFaces(const SawnPiece& piece) {
        add(piece, 1, {-1, 0, 0}, {0, 1, 0});
        add(piece, 2, {0, 1, 0}, {1, 0, 0});
    }

    // As triangles, moved outwards and turned about the vertical through the middle of their face.
    TriangleMesh triangles(double outwards, double turn) const {
        TriangleMesh mesh;
        for (const Point& point : points) {
            const Vec3 along = cross({0, 0, 1}, point.outward);
            const Vec3 at = point.at + (outwards + turn * dot(along, point.at - point.middle)) * point.outward;
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(at - half * along - Vec3{0, 0, half});
            mesh.points.push_back(at + half * along - Vec3{0, 0, half});
            mesh.points.push_back(at + Vec3{0, 0, half});
            mesh.triangles.push_back({first, first + 1, first + 2});
        }
        return mesh;
    }

 private:
    // A cap that stands on the base, along a horizontal direction: under the upper edge of its outline.
    void add(const SawnPiece& piece, std::int32_t cut, Vec3 outward, Vec3 along) {
        std::map<double, double> height;  // by the place along
        Vec3 corner;
        for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
            if (piece.mesh.cap_of[t] != cut) continue;
            for (const Vec3& in_piece : corners_of(piece.mesh, t)) {
                corner = apply(piece.setup.piece_in_setup, in_piece);
                double& z = height[dot(along, corner)];
                z = std::max(z, corner.z);
            }
        }
        const Vec3 origin = dot(outward, corner) * outward;
        const double low = height.begin()->first;
        const double high = height.rbegin()->first;
        const auto height_at = [&](double u) {
            const auto next = height.lower_bound(u);
            if (next == height.begin()) return next->second;
            const auto before = std::prev(next);
            const double share = (u - before->first) / (next->first - before->first);
            return before->second + share * (next->second - before->second);
        };
        std::vector<std::array<double, 2>> rim;
        constexpr double rim_step = 0.1;
        for (double u = low; u <= high; u += rim_step) {
            rim.push_back({u, 0});
            rim.push_back({u, height_at(u)});
        }
        for (const double u : {low, high}) {
            for (double z = 0; z <= height_at(u); z += rim_step) rim.push_back({u, z});
        }
        const Vec3 middle = origin + 0.5 * (low + high) * along;
        for (double u = low + 0.5 * spacing; u < high; u += spacing) {
            for (double z = 0.5 * spacing; z < height_at(u); z += spacing) {
                double nearest = 1e9;
                for (const auto& [v, w] : rim) nearest = std::min(nearest, std::hypot(u - v, z - w));
                points.push_back({origin + u * along + Vec3{0, 0, z}, outward, middle, nearest});
            }
        }
    }
};

ToolPath lines_of(const Toolpath& path, std::size_t tool) {
    ToolPath lines;
    for (const Operation& operation : path.operations) {
        if (operation.tool != tool) continue;
        for (const PathRun& run : operation.runs) {
            Vec3 at = run.start;
            for (std::size_t i = 0; i < run.moves.size(); ++i) {
                TipLine line;
                line.from = at;
                line.to = at = run.moves[i].tip;
                line.tool = static_cast<std::uint32_t>(tool);
                line.orientation = static_cast<std::uint32_t>(operation.orientation);
                line.rounding = run.moves[i].rounding;
                line.follows_line = i > 0;
                lines.lines.push_back(line);
            }
        }
    }
    return lines;
}

// What a tool takes off the glue faces.
struct Taken {
    double deepest = 0;         // mm
    double deepest_inside = 0;  // of it farther than 2 mm from the rim
    double farthest_in = 0;     // mm from the rim
};

Taken taken(const Toolpath& path, std::size_t tool, const GlueFaces& faces, const SawnPiece& piece, const Cell& cell,
            double outwards, double turn) {
    const TriangleMesh target = faces.triangles(outwards, turn);
    ReplayScene scene;
    scene.cell = &cell;
    scene.target = &target;
    for (std::size_t d = 0; d < piece.setup.access.orientations.size(); ++d) {
        scene.orientations.push_back({normalized(piece.setup.tool_axis(d)), 0, {}});
    }
    const GougeFigures gouges = find_gouges(lines_of(path, tool), scene, touches, {});
    Taken result;
    for (std::size_t t = 0; t < faces.points.size(); ++t) {
        const double from_rim = faces.points[t].from_rim - extent;
        const auto depth = static_cast<double>(gouges.depth[t]);
        if (depth <= 0) continue;
        result.deepest = std::max(result.deepest, depth);
        if (from_rim > 2) result.deepest_inside = std::max(result.deepest_inside, depth);
        result.farthest_in = std::max(result.farthest_in, from_rim);
    }
    return result;
}

struct SawnBlock : ::testing::Test {
    static inline const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    static inline const SawnPiece piece;
    static inline const GlueFaces faces{piece};

    static Toolpath made(const qchopper::Setup& setup) {
        ToolpathSettings settings;
        settings.cell = 0.5;
        return make_toolpath(setup, piece.mesh, cell, settings);
    }
    static const Toolpath& path() {
        static const Toolpath toolpath = made(piece.setup);
        return toolpath;
    }
    static double radius(std::size_t tool) { return 0.5 * cell.machine->tools[tool].diameter; }
    static std::string name(std::size_t tool) { return "tool " + std::to_string(cell.machine->tools[tool].number); }

    // The most by which a tool goes farther in than a radius and 2 mm, where the block is off.
    static double too_far_in(const Toolpath& toolpath) {
        double most = -1e9;
        for (std::size_t tool = 0; tool < cell.machine->tools.size(); ++tool) {
            for (const double degrees : {0.0, 0.05, -0.05}) {
                const Taken off = taken(toolpath, tool, faces, piece, cell, 0.5, degrees * std::numbers::pi / 180);
                if (off.deepest == 0) continue;
                std::printf("%s, turned by %.2f degrees: %.2f mm, up to %.1f mm from the rim\n", name(tool).c_str(),
                            degrees, off.deepest, off.farthest_in);
                most = std::max(most, off.farthest_in - radius(tool) - 2);
            }
        }
        return most;
    }
};

TEST_F(SawnBlock, HasPointsFarFromTheRims) {
    double farthest = 0;
    for (const GlueFaces::Point& point : faces.points) farthest = std::max(farthest, point.from_rim);
    EXPECT_GT(farthest, 13) << "more than the radius of the widest tool and 2 mm";
}

TEST_F(SawnBlock, NoToolCutsIntoAGlueFace) {
    for (std::size_t tool = 0; tool < cell.machine->tools.size(); ++tool) {
        const Taken as_planned = taken(path(), tool, faces, piece, cell, 0, 0);
        EXPECT_LE(as_planned.deepest, 0.25) << name(tool);
        EXPECT_EQ(as_planned.deepest_inside, 0) << name(tool) << ": more than 0.01 mm";
    }
}

TEST_F(SawnBlock, OffByHalfAMillimetreItKeepsItsGlueFacesButForTheirRims) {
    EXPECT_LE(too_far_in(path()), 0);
}

// The caps are said to lie in the top of the block: then they are no surface to mill either, and neither of the two
// knows of them, so that band and contours go along them as along any wall.
TEST_F(SawnBlock, WithBandAndContoursAlongThemTheFacesAreMilled) {
    qchopper::Setup setup = piece.setup;
    for (FlushCap& cap : setup.flush_caps) cap.face = BlockFace::top;
    EXPECT_GT(too_far_in(made(setup)), 2);
}

}  // namespace
}  // namespace qchopper
