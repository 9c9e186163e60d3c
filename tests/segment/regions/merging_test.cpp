#include "segment/regions/engines/merging.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// A join costs the area of both.
class AreaModel : public ClusterModel {
 public:
    explicit AreaModel(const FaceGraph& graph) : area_(graph.area) {}
    double cost(std::uint32_t a, std::uint32_t b, const SharedBorder& /*border*/) const override {
        return area_[a] + area_[b];
    }
    void join(std::uint32_t a, std::uint32_t b, const SharedBorder& border) override {
        area_[a] += area_[b];
        border_ += border.length;
    }
    double removed_border() const { return border_; }

 private:
    std::vector<double> area_;
    double border_ = 0;
};

TEST(Merging, EndsAtTheNumberOfRegions) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5);
    const FaceGraph graph = face_graph(ball);
    for (const std::size_t regions : {1, 2, 7}) {
        AreaModel model(graph);
        const Labels labels = merge_faces(graph, model, {1e9, regions, 4});
        EXPECT_EQ(labels.count, regions);
        EXPECT_EQ(connected(graph, labels), labels);
    }
}

TEST(Merging, RemovesBordersOnceEach) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5);
    const FaceGraph graph = face_graph(ball);
    AreaModel model(graph);
    const Labels labels = merge_faces(graph, model, {1e9, 4, 4});
    double inside = 0;
    for (const DualEdge& edge : graph.edges) {
        inside += labels.of[edge.face[0]] == labels.of[edge.face[1]] ? edge.length : 0;
    }
    // Edges that joined triangles of one cluster already were removed with the border at which it was joined.
    EXPECT_NEAR(model.removed_border(), inside, 1e-9 * inside);
}

TEST(Merging, JoinsNothingAboveTheCostOrOverASharpBorder) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {4, 4, 4}, 2);
    const FaceGraph graph = face_graph(box);
    AreaModel dear(graph);
    EXPECT_EQ(merge_faces(graph, dear, {0.1, 1, 4}).count, graph.size());
    AreaModel flat(graph);
    EXPECT_EQ(merge_faces(graph, flat, {1e9, 1, 0.5}).count, 6U);
}

}  // namespace
}  // namespace qchopper
