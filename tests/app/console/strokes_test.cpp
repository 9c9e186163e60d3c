#include "app/console/worker/strokes.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "segment/io/read_painted.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Stroke stroke(StrokeSurface surface, double radius, Vec3 place, Vec3 normal) {
    return {surface, radius, {{place.x, place.y, place.z, normal.x, normal.y, normal.z}}};
}

// A plate of 40 x 40 x 1 whose both sides lie within one radius.
TriangleMesh plate() {
    return shapes::box({0, 0, 0}, {40, 40, 1});
}

TEST(Strokes, TakeTheSideThatWasSeen) {
    const TriangleMesh mesh = plate();
    const auto painted = painted_points(mesh, {stroke(StrokeSurface::ignore, 100, {20, 20, 1}, {0, 0, 1})});
    for (std::size_t i = 0; i < painted.size(); ++i) {
        EXPECT_EQ(painted[i] == StrokeSurface::ignore, mesh.points[i].z > 0.5) << i;
    }
}

TEST(Strokes, TheLastOneWinsAndReachesItsRadius) {
    const TriangleMesh mesh = plate();
    const auto painted = painted_points(mesh, {stroke(StrokeSurface::ignore, 100, {20, 20, 1}, {0, 0, 1}),
                                               stroke(StrokeSurface::no_cut, 5, {0, 0, 1}, {0, 0, 1}),
                                               stroke(StrokeSurface::clear, 5, {40, 40, 1}, {0, 0, 1})});
    for (std::size_t i = 0; i < painted.size(); ++i) {
        const Vec3 p = mesh.points[i];
        const StrokeSurface expected = p.z < 0.5              ? StrokeSurface::clear
                                       : p == Vec3{0, 0, 1}   ? StrokeSurface::no_cut
                                       : p == Vec3{40, 40, 1} ? StrokeSurface::clear
                                                              : StrokeSurface::ignore;
        EXPECT_EQ(painted[i], expected) << i;
    }
}

TEST(Strokes, TheFileIsReadAsWhatWasPainted) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const TriangleMesh& mesh = shape.mesh;
        std::vector<StrokeSurface> painted(mesh.points.size(), StrokeSurface::clear);
        for (std::size_t i = 0; i < painted.size(); i += 2) painted[i] = StrokeSurface::ignore;
        EXPECT_TRUE(masked_ply(mesh, painted, StrokeSurface::no_cut).empty()) << shape.name;
        const TriangleMesh read = parse_painted_ply(masked_ply(mesh, painted, StrokeSurface::ignore), "it");
        ASSERT_EQ(read.triangles.size(), mesh.triangles.size()) << shape.name;
        EXPECT_EQ(read.points, mesh.points) << shape.name;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            int marked = 0;
            for (const auto corner : mesh.triangles[t]) marked += corner % 2 == 0 ? 1 : 0;
            EXPECT_EQ(read.ignored[t] != 0, marked >= 2) << shape.name << t;
        }
    }
}

TEST(Strokes, AreReadAsTheyAreWritten) {
    const std::vector<Stroke> strokes{stroke(StrokeSurface::no_cut, 2.5, {1, 2, 3}, {0, 0, 1})};
    EXPECT_EQ(read_strokes(to_json(strokes)), strokes);
    for (const char* wrong : {"", "{}", "[1]", R"([{"surface":"ignore","radius_mm":1,"points":[]}])",
                              R"([{"surface":"ignore","radius_mm":0,"points":[[0,0,0,0,0,1]]}])",
                              R"([{"surface":"all","radius_mm":1,"points":[[0,0,0,0,0,1]]}])",
                              R"([{"surface":"ignore","radius_mm":1,"points":[[0,0,0,0,1]]}])"}) {
        EXPECT_THROW(read_strokes(wrong), InputError) << wrong;
    }
}

}  // namespace
}  // namespace qchopper
