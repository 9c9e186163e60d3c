// The methods that divide a surface into regions, each in a source of its own under methods/.
//
// mm. What a method takes from its paper, what from the thesis and what is ours, is in docs/developer/regions.md. No
// method uses chance: seeds follow from the shape, so that another order of triangles or another position gives the
// same regions but for ties. The result does not depend on the number of threads
// (tests/segment/regions/parts_test.cpp, charts_test.cpp beside it). Precondition of all: the mesh has a triangle.

#pragma once

#include <cstddef>

#include "base/units.h"
#include "segment/regions/labels.h"

namespace qchopper {

struct RegionOptions {
    std::size_t regions = 0;  // as many as this, where the method takes a number; 0: it finds one
    double tolerance = 0;     // mm: of the surface from the shape of its region, where that is bounded; 0: a hundredth
                              // of the diagonal of the mesh
};

// Charts do not go over borders that turn by more than this.
constexpr double max_chart_turn = 40 * degree;

inline double tolerance_of(const FaceGraph& graph, const RegionOptions& options) {
    return options.tolerance > 0 ? options.tolerance : 0.01 * graph.diagonal;
}

// Charts: surface near a plane, or near one of a few simple shapes.
Labels superfaces(const FaceGraph& graph, const RegionOptions& options);
Labels garland_clusters(const FaceGraph& graph, const RegionOptions& options);
Labels attene_primitives(const FaceGraph& graph, const RegionOptions& options);
Labels sander_charts(const FaceGraph& graph, const RegionOptions& options);
Labels eck_tiles(const FaceGraph& graph, const RegionOptions& options);

// Parts: what an observer calls a limb or a bulge.
Labels shlafman_parts(const FaceGraph& graph, const RegionOptions& options);
Labels zhou_huang_parts(const FaceGraph& graph, const RegionOptions& options);
Labels katz_tal_parts(const FaceGraph& graph, const RegionOptions& options);
Labels liu_zhang_parts(const FaceGraph& graph, const RegionOptions& options);
Labels shuffler_parts(const FaceGraph& graph, const RegionOptions& options);

// Yardsticks, which are CGAL's.
Labels shape_diameter_parts(const FaceGraph& graph, const RegionOptions& options);
Labels variational_charts(const FaceGraph& graph, const RegionOptions& options);

// The conditions of eck_tiles: how often each is broken.
struct TileFaults {
    std::size_t no_discs = 0;        // tiles that are not homeomorphic to a disc
    std::size_t split_borders = 0;   // pairs of tiles whose common border is in several parts
    std::size_t crowded_points = 0;  // points that touch four tiles or more
    bool operator==(const TileFaults&) const = default;
};
TileFaults tile_faults(const FaceGraph& graph, const Labels& labels);

}  // namespace qchopper
