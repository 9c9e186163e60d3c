// M. Garland, A. Willmott and P. Heckbert, "Hierarchical face clustering on polygonal surfaces" (2001): neighbouring
// clusters are joined by the cost of planarity, orientation and shape, each kept as sums (dual quadrics).
//
// Of the paper: planarity is the mean squared distance to the least squares plane, orientation the mean of (1 - n.m)^2
// over its normal n and the triangles' normals m, shape the growth of perimeter^2 / (4 pi area). Ours: planarity and
// orientation are measured in their bounds, which no cluster exceeds, and planarity is of the whole triangles, where
// the paper takes their points. O(n log n) for n triangles (engines/merging.h).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "segment/regions/engines/merging.h"
#include "segment/regions/engines/moments.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr double shape_weight = 0.1;

struct FlatCluster {
    PointMoments points;
    Vec3 normals;  // sum, weighted by area
    Symmetric3 normal_products{};
    double perimeter = 0;
};

double irregularity(double perimeter, double area) {
    return area > 0 ? perimeter * perimeter / (4 * std::numbers::pi * area) : 0;
}

FlatCluster joined(const FlatCluster& a, const FlatCluster& b, double border) {
    FlatCluster sum = a;
    sum.points.add(b.points);
    sum.normals = sum.normals + b.normals;
    for (std::size_t i = 0; i < 6; ++i) sum.normal_products[i] += b.normal_products[i];
    sum.perimeter = std::max(0.0, a.perimeter + b.perimeter - 2 * border);
    return sum;
}

class FlatModel : public ClusterModel {
 public:
    FlatModel(const FaceGraph& graph, double tolerance)
        : distance_(tolerance * tolerance), turn_(std::pow(1 - std::cos(max_chart_turn / 2), 2)) {
        clusters_.resize(graph.size());
        for (std::size_t f = 0; f < graph.size(); ++f) {
            FlatCluster& c = clusters_[f];
            const auto corner = corners_of(*graph.mesh, f);
            c.points.add_triangle(corner, graph.area[f]);
            c.normals = graph.area[f] * graph.normal[f];
            add_product(c.normal_products, graph.normal[f], graph.area[f]);
            for (std::size_t k = 0; k < 3; ++k) c.perimeter += norm(corner[(k + 1) % 3] - corner[k]);
        }
    }

    double cost(std::uint32_t a, std::uint32_t b, const SharedBorder& border) const override {
        const FlatCluster both = joined(clusters_[a], clusters_[b], border.length);
        const double area = both.points.weight;
        if (!(area > 0)) return 0;
        const PrincipalAxes axes = principal_axes(both.points.covariance());
        const Vec3 normal = dot(axes.direction[0], both.normals) < 0 ? -axes.direction[0] : axes.direction[0];
        const double planarity = axes.square[0] / distance_;
        const double orientation =
            (1 + (quadratic(both.normal_products, normal) - 2 * dot(normal, both.normals)) / area) / turn_;
        if (planarity > 1 || orientation > 1) return std::numeric_limits<double>::infinity();
        const double shape = irregularity(both.perimeter, area);
        const double before = std::max(irregularity(clusters_[a].perimeter, clusters_[a].points.weight),
                                       irregularity(clusters_[b].perimeter, clusters_[b].points.weight));
        return planarity + orientation + (shape > 0 ? shape_weight * (shape - before) / shape : 0);
    }

    void join(std::uint32_t a, std::uint32_t b, const SharedBorder& border) override {
        clusters_[a] = joined(clusters_[a], clusters_[b], border.length);
    }

 private:
    double distance_;  // mm2
    double turn_;
    std::vector<FlatCluster> clusters_;
};

}  // namespace

Labels garland_clusters(const FaceGraph& graph, const RegionOptions& options) {
    FlatModel model(graph, tolerance_of(graph, options));
    return merge_faces(graph, model, {3, std::max<std::size_t>(options.regions, 1), max_chart_turn});
}

}  // namespace qchopper
