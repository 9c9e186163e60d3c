// The toolpaths of pieces with glue faces that the saw has made, at sides and at the top, swept against these faces: as
// they should be, and with the block moved outwards and turned by what a block that is sawn and laid by hand may be
// off. The faces are small triangles, each with its distance from the rim of its cap; nothing is asked of a grid of
// foam.
//
// What keeps them whole are add_floor_band(), which leaves out the floor beyond a sawn face, and clear_of_sawn_faces(),
// without which contours of the skin go on along the face: up to 11.6 mm from its rim by the 12 mm ball.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "base/units.h"
#include "cam/toolpath/make_toolpath.h"
#include "segment/cut/cut.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"
#include "sim/replay/gouge.h"
#include "tests/cam/toolpath/toolpath_pieces.h"

namespace qchopper {
namespace {

constexpr double size = 64;
constexpr double spacing = 1;    // mm, between points of a glue face
constexpr double half = 0.25;    // mm, of the triangle about such a point
constexpr double extent = 0.36;  // mm, of it about the point
constexpr double touches = 0.01;

constexpr double margin = 8;

struct SawnPiece {
    TriangleMesh mesh;
    Setup setup;

    // Sets cap_of of the triangles whose corners all hold a condition, and lays the cap in a face of the block.
    template <class Holds>
    void saw(std::int32_t cut, BlockFace face, const Holds& holds) {
        double area = 0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::array<Vec3, 3> corners = corners_of(mesh, t);
            if (!std::all_of(corners.begin(), corners.end(), holds)) continue;
            mesh.cap_of[t] = cut;
            area += norm(area_vector(mesh, t));
        }
        if (cut > 0) setup.flush_caps.push_back({cut, face, area});
    }

    // A body with bumps on top of a flat base.
    explicit SawnPiece(TriangleMesh body) : mesh(std::move(body)) {
        setup = test_pieces::setup_of(mesh, margin, 40);
        setup.access.orientations.push_back({{-std::sin(0.7), 0, std::cos(0.7)}, 40, 0, 0});
        setup.base = 0;
        saw(0, BlockFace::top, [](Vec3 p) { return p.z == 0; });
    }
};

// Two sides are caps: at -x, and at +y.
SawnPiece sawn_at_sides() {
    SawnPiece piece(test_pieces::bumpy(size, 16, 46, 11));
    piece.saw(1, BlockFace::minus_x, [](Vec3 p) { return p.x == 0; });
    piece.saw(2, BlockFace::plus_y, [](Vec3 p) { return p.y == size; });
    Setup& setup = piece.setup;
    setup.block.size = setup.block.size - Vec3{margin, margin, 0};
    const Vec3 by{-0.5 * margin, 0.5 * margin, 0};
    setup.piece_in_setup.shift = setup.piece_in_setup.shift + by;
    setup.box = {setup.box.min + by, setup.box.max + by};
    return piece;
}

// Cut off through its bumps: the cap is the top, with valleys of skin in it.
SawnPiece sawn_at_top() {
    constexpr double high = 24.01;
    SawnPiece piece(cut(test_pieces::bumpy(size, 16, 46, 11), {{0, 0, 1}, high}, 1)->below.mesh);
    piece.saw(1, BlockFace::top, [](Vec3 p) { return std::abs(p.z - high) < 1e-9; });
    piece.setup.block.size.z -= margin;
    return piece;
}

double distance(Point2 p, Point2 a, Point2 b) {
    const Point2 along{b.x - a.x, b.y - a.y};
    const double square = along.x * along.x + along.y * along.y;
    const double t = std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / square, 0.0, 1.0);
    return std::hypot(a.x + t * along.x - p.x, a.y + t * along.y - p.y);
}

// Points of the flush caps, in setup coordinates.
struct GlueFaces {
    struct Point {
        Vec3 at;
        Vec3 outward;
        Vec3 u;        // in the face
        Vec3 in_face;  // from the middle of its face
        double from_rim = 0;
    };
    std::vector<Point> points;

    explicit GlueFaces(const SawnPiece& piece) {
        for (const FlushCap& cap : piece.setup.flush_caps) add(piece, cap.cut);
    }

    // As triangles, moved outwards and turned in their face's middle about its v.
    TriangleMesh triangles(double outwards, double turn) const {
        TriangleMesh mesh;
        for (const Point& point : points) {
            const Vec3 v = cross(point.outward, point.u);
            const Vec3 at = point.at + (outwards + turn * dot(point.u, point.in_face)) * point.outward;
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(at - half * point.u - half * v);
            mesh.points.push_back(at + half * point.u - half * v);
            mesh.points.push_back(at + half * v);
            mesh.triangles.push_back({first, first + 1, first + 2});
        }
        return mesh;
    }

 private:
    using Corners = std::array<Point2, 3>;

    // Whether a triangle, counter-clockwise, holds a point.
    static bool holds(const Corners& corners, Point2 p) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Point2 a = corners[k];
            const Point2 b = corners[(k + 1) % 3];
            if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0) return false;
        }
        return true;
    }

    void add(const SawnPiece& piece, std::int32_t cut) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<Point2, 2>> rim;  // edges without a neighbour
        std::vector<Corners> triangles;
        Rectangle2 box;
        Vec3 origin;
        Vec3 outward;
        PlaneFrame frame;
        for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
            if (piece.mesh.cap_of[t] != cut) continue;
            if (triangles.empty()) {
                outward = normalized(rotate(piece.setup.piece_in_setup, area_vector(piece.mesh, t)));
                frame = frame_across(outward);
                const Vec3 at = apply(piece.setup.piece_in_setup, corners_of(piece.mesh, t)[0]);
                origin = dot(outward, at) * outward;
            }
            Corners corners;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 at = apply(piece.setup.piece_in_setup, corners_of(piece.mesh, t)[k]);
                corners[k] = {dot(frame.u, at), dot(frame.v, at)};
                box.include(corners[k]);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = piece.mesh.triangles[t][k];
                const std::uint32_t to = piece.mesh.triangles[t][(k + 1) % 3];
                if (rim.erase({to, from}) == 0) rim[{from, to}] = {corners[k], corners[(k + 1) % 3]};
            }
            triangles.push_back(corners);
        }
        const Point2 middle{0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y)};
        for (double x = box.min.x + 0.5 * spacing; x < box.max.x; x += spacing) {
            for (double y = box.min.y + 0.5 * spacing; y < box.max.y; y += spacing) {
                const Point2 p{x, y};
                if (std::none_of(triangles.begin(), triangles.end(), [&](const Corners& c) { return holds(c, p); })) {
                    continue;
                }
                double nearest = 1e9;
                for (const auto& [edge, ends] : rim) nearest = std::min(nearest, distance(p, ends[0], ends[1]));
                points.push_back({origin + x * frame.u + y * frame.v, outward, frame.u,
                                  (x - middle.x) * frame.u + (y - middle.y) * frame.v, nearest});
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

const Cell& cell() {
    static const Cell read = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    return read;
}

Toolpath made(const Setup& setup, const SawnPiece& piece) {
    ToolpathSettings settings;
    settings.cell = 0.5;
    return make_toolpath(setup, piece.mesh, cell(), settings);
}

// A piece with its toolpath.
struct Sawn {
    SawnPiece piece;
    GlueFaces faces{piece};
    Toolpath path = made(piece.setup, piece);
};

const Sawn& at_sides() {
    static const Sawn made_once{sawn_at_sides()};
    return made_once;
}

const Sawn& at_top() {
    static const Sawn made_once{sawn_at_top()};
    return made_once;
}

double radius(std::size_t tool) {
    return 0.5 * cell().machine->tools[tool].diameter;
}

std::string name(std::size_t tool) {
    return "tool " + std::to_string(cell().machine->tools[tool].number);
}

// The most by which a tool goes farther in than a radius and 2 mm, where the block is off.
double too_far_in(const Toolpath& path, const Sawn& of) {
    double most = -1e9;
    for (std::size_t tool = 0; tool < cell().machine->tools.size(); ++tool) {
        for (const double degrees : {0.0, 0.05, -0.05}) {
            const Taken off = taken(path, tool, of.faces, of.piece, cell(), 0.5, radians(degrees));
            if (off.deepest == 0) continue;
            std::printf("%s, turned by %.2f degrees: %.2f mm, up to %.1f mm from the rim\n", name(tool).c_str(),
                        degrees, off.deepest, off.farthest_in);
            most = std::max(most, off.farthest_in - radius(tool) - 2);
        }
    }
    return most;
}

// At two sides, and at the top.
struct SawnBlock : ::testing::TestWithParam<bool> {
    const Sawn& block = GetParam() ? at_top() : at_sides();
};

TEST_P(SawnBlock, HasPointsFarFromTheRims) {
    double farthest = 0;
    for (const GlueFaces::Point& point : block.faces.points) farthest = std::max(farthest, point.from_rim);
    EXPECT_GT(farthest, GetParam() ? 8 : 13) << "more than the radius of a tool and 2 mm";
}

TEST_P(SawnBlock, NoToolCutsIntoAGlueFace) {
    for (std::size_t tool = 0; tool < cell().machine->tools.size(); ++tool) {
        const Taken as_planned = taken(block.path, tool, block.faces, block.piece, cell(), 0, 0);
        EXPECT_LE(as_planned.deepest, 0.25) << name(tool);
        EXPECT_EQ(as_planned.deepest_inside, 0) << name(tool) << ": more than 0.01 mm";
    }
}

TEST_P(SawnBlock, OffByHalfAMillimetreItKeepsItsGlueFacesButForTheirRims) {
    EXPECT_LE(too_far_in(block.path, block), 0);
}

INSTANTIATE_TEST_SUITE_P(Faces, SawnBlock, ::testing::Bool(),
                         [](const auto& is_at_top) { return is_at_top.param ? "Top" : "Sides"; });

// The caps are said to lie in the top of the block: then they are no surface to mill either, and neither of the two
// knows of them, so that band and contours go along them as along any wall.
TEST(SawnBlockWithBand, AndContoursAlongThemTheFacesAreMilled) {
    const Sawn& block = at_sides();
    auto setup = block.piece.setup;
    for (FlushCap& cap : setup.flush_caps) cap.face = BlockFace::top;
    EXPECT_GT(too_far_in(made(setup, block.piece), block), too_far_in(block.path, block) + 3);
}

// The cap at the top is said to be none of a face: passes go over it as over any surface.
TEST(SawnBlockWithPasses, OverItTheTopIsMilled) {
    const Sawn& block = at_top();
    auto setup = block.piece.setup;
    setup.flush_caps.clear();
    EXPECT_GT(too_far_in(made(setup, block.piece), block), 0);
}

}  // namespace
}  // namespace qchopper
