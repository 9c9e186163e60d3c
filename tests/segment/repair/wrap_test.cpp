#include "segment/repair/wrap.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "segment/mesh/distance.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/self_intersections.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Of a wrap of whatever mesh: a solid that holds the mesh and does not run through itself.
TriangleMesh wrapped(const TriangleMesh& mesh, const WrapOptions& options) {
    const TriangleMesh skin = wrap(mesh, options);
    EXPECT_TRUE(edges(skin).faults.is_closed());
    EXPECT_GT(volume_mm3(skin), 0);
    EXPECT_TRUE(self_intersections(skin).is_free());
    const Box inner = bounds(mesh);
    const Box outer = bounds(skin);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(outer.min[axis], inner.min[axis]);
        EXPECT_GE(outer.max[axis], inner.max[axis]);
    }
    return skin;
}

TEST(Wrap, IsASolidNearTheScan) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    const TriangleMesh skin = wrapped(box, {2, 0.1});
    EXPECT_GT(volume_mm3(skin), 1000);
    EXPECT_LT(volume_mm3(skin), 1100);
    EXPECT_LT(deviation(box, skin).largest().at_most, 0.3);
}

TEST(Wrap, ClosesHolesNarrowerThanAlphaAndSoups) {
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

TEST(Wrap, IsTheSameEveryTime) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 6, 2, 12);
    EXPECT_EQ(wrap(torus, {2, 0.1}), wrap(torus, {2, 0.1}));
}

TEST(Wrap, RefusesWhatMakesNoSense) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const WrapOptions& options : {WrapOptions{-1, 0}, WrapOptions{1, -1}, WrapOptions{nan, 0}, WrapOptions{1, nan},
                                       WrapOptions{1e-3, 0}, WrapOptions{1, 1e-9}}) {
        EXPECT_THROW(wrap(box, options), InputError) << options.alpha_mm << " " << options.offset_mm;
    }
    EXPECT_THROW(wrap({}, {1, 0.1}), InputError);
    TriangleMesh point;
    point.points = {{1, 1, 1}};
    point.triangles = {{0, 0, 0}};
    EXPECT_THROW(wrap(point, {}), InputError);
    EXPECT_GT(filled_in({}, box).offset_mm, 0);
    EXPECT_NEAR(filled_in({}, box).alpha_mm, 0.1732, 0.001);
}

}  // namespace
}  // namespace qchopper
