#include "segment/repair/alpha_wrap.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/distance.h"
#include "segment/mesh/measure.h"
#include "segment/repair/intersections/self_intersections.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The wrap of any mesh is a solid that encloses the mesh and does not intersect itself.
TriangleMesh wrapped(const TriangleMesh& mesh, const AlphaWrapOptions& options) {
    const TriangleMesh wrap = alpha_wrap(mesh, options);
    EXPECT_TRUE(edges(wrap).faults.is_closed());
    EXPECT_GT(volume_mm3(wrap), 0);
    EXPECT_TRUE(self_intersections(wrap).is_free());
    const Box inner = bounds(mesh);
    const Box outer = bounds(wrap);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(outer.min[axis], inner.min[axis]);
        EXPECT_GE(outer.max[axis], inner.max[axis]);
    }
    return wrap;
}

TEST(AlphaWrap, IsASolidNearTheScan) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    const TriangleMesh wrap = wrapped(box, {2, 0.1});
    EXPECT_GT(volume_mm3(wrap), 1000);
    EXPECT_LT(volume_mm3(wrap), 1100);
    EXPECT_LT(deviation(box, wrap).largest().at_most, 0.3);
}

TEST(AlphaWrap, ClosesHolesNarrowerThanAlphaAndSoups) {
    TriangleMesh open = shapes::ball({0, 0, 0}, 10, 16);
    open.triangles.erase(open.triangles.begin() + 40, open.triangles.begin() + 44);
    EXPECT_GT(volume_mm3(wrapped(open, {5, 0.2})), 3500);
    TriangleMesh soup;
    for (const Triangle& t : shapes::box({0, 0, 0}, {10, 10, 10}, 3).triangles) {
        for (const std::uint32_t corner : t)
            soup.points.push_back(shapes::box({0, 0, 0}, {10, 10, 10}, 3).points[corner]);
        const auto n = static_cast<std::uint32_t>(soup.points.size());
        soup.triangles.push_back(n % 2 == 0 ? Triangle{n - 3, n - 2, n - 1} : Triangle{n - 1, n - 2, n - 3});
    }
    EXPECT_NEAR(volume_mm3(wrapped(soup, {3, 0.1})), 1050, 60);
}

TEST(AlphaWrap, IsTheSameEveryTime) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 6, 2, 12);
    EXPECT_EQ(alpha_wrap(torus, {2, 0.1}), alpha_wrap(torus, {2, 0.1}));
}

TEST(AlphaWrap, RefusesWhatMakesNoSense) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const AlphaWrapOptions& options :
         {AlphaWrapOptions{-1, 0}, AlphaWrapOptions{1, -1}, AlphaWrapOptions{nan, 0}, AlphaWrapOptions{1, nan},
          AlphaWrapOptions{1e-3, 0}, AlphaWrapOptions{1, 1e-9}}) {
        EXPECT_THROW(alpha_wrap(box, options), InputError) << options.alpha_mm << " " << options.offset_mm;
    }
    EXPECT_THROW(alpha_wrap({}, {1, 0.1}), InputError);
    TriangleMesh point;
    point.points = {{1, 1, 1}};
    point.triangles = {{0, 0, 0}};
    EXPECT_THROW(alpha_wrap(point, {}), InputError);
    EXPECT_GT(filled_in({}, box).offset_mm, 0);
    EXPECT_NEAR(filled_in({}, box).alpha_mm, 0.1732, 0.001);
}

}  // namespace
}  // namespace qchopper
