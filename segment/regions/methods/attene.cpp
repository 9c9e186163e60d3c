// M. Attene, B. Falcidieno and M. Spagnuolo, "Hierarchical mesh segmentation based on fitting primitives" (2006):
// neighbouring clusters are joined by the error of the plane, sphere or cylinder that fits both best.
//
// Of the paper: the order of the joins, the three shapes and the least of their errors. Ours: a sphere or cylinder of
// radius r about c is fitted to centroids p and normals n together, by least squares of p - c - r n (across the axis of
// a cylinder, which is the direction to which the normals are most nearly perpendicular), so that sums of products are
// enough; and no border that turns by more than 40 degrees is joined over, because a few triangles on both sides of a
// sharp edge fit some sphere. O(n log n) for n triangles (engines/merging.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "segment/regions/engines/merging.h"
#include "segment/regions/engines/moments.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

// Sums over triangles, weighted by area.
struct CurvedCluster {
    PointMoments surface;  // whole triangles
    PointMoments centroids;
    PointMoments normals;
    std::array<Vec3, 3> mixed;  // rows: the components of centroids, times the normals
};

CurvedCluster joined(const CurvedCluster& a, const CurvedCluster& b) {
    CurvedCluster sum = a;
    sum.surface.add(b.surface);
    sum.centroids.add(b.centroids);
    sum.normals.add(b.normals);
    for (std::size_t i = 0; i < 3; ++i) sum.mixed[i] = sum.mixed[i] + b.mixed[i];
    return sum;
}

// Trace of the mean products of centroids and normals about their centres; across an axis if it is not zero.
double mixed_trace(const CurvedCluster& c, Vec3 axis) {
    const double w = c.normals.weight;
    const Vec3 p = c.centroids.centre();
    const Vec3 n = c.normals.centre();
    double trace_of_all = 0;
    double along = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3 row = (1 / w) * c.mixed[static_cast<std::size_t>(i)] - p[i] * n;
        trace_of_all += row[i];
        along += axis[i] * dot(row, axis);
    }
    return trace_of_all - along;
}

// Mean squared distance of centroids from c + r n, across the axis; along it the normals count, times r.
double round_error(const CurvedCluster& c, Vec3 axis) {
    const Symmetric3 points = c.centroids.covariance();
    const Symmetric3 normals = c.normals.covariance();
    const double spread = trace(normals) - quadratic(normals, axis);
    const double all = trace(points) - quadratic(points, axis);
    if (!(spread > 1e-9)) return all;  // the normals are parallel
    const double mixed = mixed_trace(c, axis);
    const double radius = mixed / spread;
    const double tilt = quadratic(c.normals.products, axis) / c.normals.weight;
    return std::max(0.0, all - mixed * mixed / spread) + radius * radius * tilt;
}

double least_error(const CurvedCluster& c) {
    if (!(c.surface.weight > 0)) return 0;
    const double plane = principal_axes(c.surface.covariance()).square[0];
    const Vec3 axis = principal_axes(c.normals.products).direction[0];
    return std::min({plane, round_error(c, {}), round_error(c, axis)});
}

class PrimitiveModel : public ClusterModel {
 public:
    explicit PrimitiveModel(const FaceGraph& graph) {
        clusters_.resize(graph.size());
        for (std::size_t f = 0; f < graph.size(); ++f) {
            CurvedCluster& c = clusters_[f];
            const Vec3 p = graph.centroid[f];
            c.surface.add_triangle(corners_of(*graph.mesh, f), graph.area[f]);
            c.centroids.add(p, graph.area[f]);
            c.normals.add(graph.normal[f], graph.area[f]);
            for (int i = 0; i < 3; ++i) c.mixed[static_cast<std::size_t>(i)] = graph.area[f] * p[i] * graph.normal[f];
        }
    }
    double cost(std::uint32_t a, std::uint32_t b, const SharedBorder& /*border*/) const override {
        return least_error(joined(clusters_[a], clusters_[b]));
    }
    void join(std::uint32_t a, std::uint32_t b, const SharedBorder& /*border*/) override {
        clusters_[a] = joined(clusters_[a], clusters_[b]);
    }

 private:
    std::vector<CurvedCluster> clusters_;
};

}  // namespace

Labels attene_primitives(const FaceGraph& graph, const RegionOptions& options) {
    const double tolerance = tolerance_of(graph, options);
    PrimitiveModel model(graph);
    return merge_faces(graph, model,
                       {tolerance * tolerance, std::max<std::size_t>(options.regions, 1), max_chart_turn});
}

}  // namespace qchopper
