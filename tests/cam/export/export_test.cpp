// Which files there are and where pieces stand in them; tests/app/cli/export_test.cpp reads the files themselves.

#include "cam/export/export.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Export, FormatsAreThoseOfTheirNames) {
    EXPECT_EQ(export_format_named("3mf"), ExportFormat::threemf);
    EXPECT_EQ(export_format_named("stl"), ExportFormat::stl);
    EXPECT_EQ(export_format_named("ply"), ExportFormat::ply);
    EXPECT_EQ(export_format_named("glb"), ExportFormat::glb);
    EXPECT_THROW(export_format_named("obj"), InputError);
    EXPECT_THROW(export_format_named("STL"), InputError);
    EXPECT_TRUE(holds_many(ExportFormat::threemf) && holds_many(ExportFormat::glb));
    EXPECT_FALSE(holds_many(ExportFormat::stl) || holds_many(ExportFormat::ply));
}

TEST(Export, PiecesStandInARowFromZeroOnWithAGapBetweenThem) {
    const auto mesh = std::make_shared<const TriangleMesh>(shapes::box({0, 0, 0}, {10, 4, 2}));
    const Pose turned{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}, {-500, 7, 3}};  // 4 mm along x
    std::vector<ExportPiece> pieces(3);
    for (ExportPiece& piece : pieces) piece.mesh = mesh;
    pieces[1].pose = turned;
    stand_in_a_row(pieces, 5);
    double begin = 0;
    for (const ExportPiece& piece : pieces) {
        const Box box = bounds(apply(piece.pose, *mesh));
        EXPECT_NEAR(box.min.x, begin, 1e-9);
        begin = box.max.x + 5;
    }
    EXPECT_NEAR(begin, 10 + 5 + 4 + 5 + 10 + 5, 1e-9);
    EXPECT_EQ(pieces[1].pose.shift.y, 7);
    EXPECT_EQ(pieces[1].pose.row, turned.row);
}

}  // namespace
}  // namespace qchopper
