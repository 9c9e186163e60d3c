#include "segment/io/write_3mf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"
#include "segment/repair/weld.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TriangleMesh read_back(const Bytes& bytes) {
    const RawMesh read = parse_mesh(bytes, "a.3mf");
    EXPECT_EQ(read.mm_per_unit, 1.0);
    return read.mesh;
}

// A quarter turn about z and a shift: exact in double.
Pose turned() {
    Pose pose;
    pose.row = {Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}};
    pose.shift = {100, -20, 3.25};
    return pose;
}

TEST(Write3mf, ReadingItBackGivesTheSameBits) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const std::vector<Solid3mf> solids{{shape.name, &shape.mesh, {}}};
        const TriangleMesh back = read_back(to_3mf(solids, {}));
        EXPECT_EQ(back.points, shape.mesh.points) << shape.name;
        EXPECT_EQ(back.triangles, shape.mesh.triangles) << shape.name;
    }
}

TEST(Write3mf, NumbersThatTakeAllDigitsAndTheLargestComeBack) {
    TriangleMesh mesh = shapes::pyramid({0.1, 1e-17, -1.0 / 3}, std::numbers::pi, 1e7 / 3);
    mesh.points[0] = {5e-324, -0.0, 123456.789012345678};
    const std::vector<Solid3mf> solids{{"A", &mesh, {}}};
    const TriangleMesh back = read_back(to_3mf(solids, {}));
    EXPECT_EQ(back.points, mesh.points);
}

TEST(Write3mf, APoseIsWhereTheReaderPutsTheSolid) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 20, 30});
    const std::vector<Solid3mf> solids{{"A", &box, turned()}};
    const TriangleMesh back = read_back(to_3mf(solids, {}));
    EXPECT_EQ(back.points, apply(turned(), box).points);
}

TEST(Write3mf, EverySolidIsAnObjectOfItsOwn) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 20, 30});
    const TriangleMesh ball = shapes::ball({50, 0, 0}, 5);
    const std::vector<Solid3mf> solids{{"A", &box, {}}, {"B", &ball, {}}};
    const TriangleMesh back = read_back(to_3mf(solids, {{"Title", "both"}}));
    EXPECT_EQ(back.triangles.size(), box.triangles.size() + ball.triangles.size());
    EXPECT_NEAR(volume_mm3(back), volume_mm3(box) + volume_mm3(ball), 1e-6);
}

TEST(Write3mf, NamesThatXmlCouldTakeForItselfDoNoHarm) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 20, 30});
    const std::vector<Solid3mf> solids{{"<\"A\" & 'B'>\n\x01", &box, {}}};
    const Bytes bytes = to_3mf(solids, {{"Title", "]]> </metadata> & \x02"}});
    EXPECT_EQ(read_back(bytes).triangles.size(), box.triangles.size());
}

TEST(Write3mf, SameSolidsSameBytes) {
    const TriangleMesh ball = shapes::ball({1, 2, 3}, 5, 60);
    const std::vector<Solid3mf> solids{{"A", &ball, turned()}};
    EXPECT_EQ(to_3mf(solids, {{"Title", "a"}}), to_3mf(solids, {{"Title", "a"}}));
}

// The slicer that many people use; what it says is its own judgement.
TEST(Write3mf, PrusaSlicerReadsItWithoutComplaint) {
    if (std::system("command -v prusa-slicer >/dev/null 2>&1") != 0) GTEST_SKIP() << "prusa-slicer is not installed";
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 20, 30}, 4);
    const TriangleMesh ball = shapes::ball({50, 0, 0}, 5);
    const std::vector<Solid3mf> solids{{"A", &box, {}}, {"B", &ball, turned()}};
    const auto file = std::filesystem::temp_directory_path() / ("write_3mf_" + std::to_string(::getpid()) + ".3mf");
    write_file(file, to_3mf(solids, {{"Title", "two"}}));
    FILE* pipe = ::popen(("prusa-slicer --info '" + file.string() + "' 2>&1").c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string said;
    char line[256];
    while (std::fgets(line, sizeof line, pipe) != nullptr) said += line;
    EXPECT_EQ(::pclose(pipe), 0) << said;
    std::filesystem::remove(file);
    EXPECT_NE(said.find("number_of_facets"), std::string::npos) << said;
    EXPECT_EQ(said.find("manifold = no"), std::string::npos) << said;
    for (const char* complaint : {"error", "Error", "repair", "warning"}) {
        EXPECT_EQ(said.find(complaint), std::string::npos) << said;
    }
}

}  // namespace
}  // namespace qchopper
