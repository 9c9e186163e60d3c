// Rays of each sample in turn until one leaves the solid: outside the first few do, inside all that face the sample are
// cast. Triangles without samples are labelled breadth first from those that have some.

#include "segment/access/inside.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "segment/access/accessibility.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/solids.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

constexpr std::size_t samples_at_once = 16;
constexpr std::size_t samples_between_reports = 4096;
constexpr std::uint8_t not_known = 2;

// Per sample of the scan 1 if it is open along no direction.
std::vector<std::uint8_t> closed_samples(const SampledScan& scan, const Context& context) {
    std::vector<std::uint8_t> is_closed(scan.samples.sample.size());
    std::size_t done = 0;
    for (const PieceAccessibility& solid : unasked_accessibility(scan)) {
        const PieceRays rays(scan, solid);
        const auto is_open = [&](std::size_t row) {
            return std::any_of(scan.directions.begin(), scan.directions.end(),
                               [&](Vec3 d) { return std::isinf(rays.distance(row, d)); });
        };
        for (std::size_t from = 0; from < solid.sample.size(); from += samples_between_reports) {
            context.check_cancelled();
            context.progress("samples asked", done + from, is_closed.size());
            const std::size_t to = std::min(solid.sample.size(), from + samples_between_reports);
            parallel_ranges(from, to, samples_at_once, [&](std::size_t first, std::size_t end) {
                for (std::size_t row = first; row < end; ++row) is_closed[solid.sample[row]] = is_open(row) ? 0 : 1;
            });
        }
        done += solid.sample.size();
    }
    return is_closed;
}

// Gives triangles that are not known the label of the neighbour from which they are reached first; 0 if there is none.
void spread(const TriangleMesh& mesh, std::vector<std::uint8_t>& label) {
    const Edges pairs = edges(mesh);
    std::vector<std::uint32_t> queue;
    queue.reserve(label.size());
    for (std::uint32_t t = 0; t < label.size(); ++t) {
        if (label[t] != not_known) queue.push_back(t);
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const std::uint32_t t = queue[next];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t twin = pairs.twin[3 * t + k];
            if (twin == no_twin || label[twin / 3] != not_known) continue;
            label[twin / 3] = label[t];
            queue.push_back(twin / 3);
        }
    }
    std::replace(label.begin(), label.end(), not_known, std::uint8_t{0});
}

// Per solid and triangle, from the samples on it; not_known without one.
std::vector<std::vector<std::uint8_t>> by_majority(const SampledScan& scan,
                                                   const std::vector<std::uint8_t>& is_closed) {
    std::vector<std::vector<std::uint8_t>> label;
    std::vector<std::vector<std::int32_t>> surplus;  // of closed samples over open ones
    for (const auto& solid : scan.solid) {
        label.emplace_back(solid->triangles.size(), not_known);
        surplus.emplace_back(solid->triangles.size());
    }
    for (std::size_t i = 0; i < is_closed.size(); ++i) {
        const SurfaceSample& sample = scan.samples.sample[i];
        std::int32_t& votes = surplus[sample.mesh][sample.triangle];
        votes += is_closed[i] != 0 ? 1 : -1;
        label[sample.mesh][sample.triangle] = votes > 0 ? 1 : 0;
    }
    return label;
}

}  // namespace

std::vector<std::uint8_t> inside_surface(const TriangleMesh& scan, const Context& context, std::size_t samples) {
    assert(samples > 0);
    std::vector<std::uint8_t> inside(scan.triangles.size());
    if (inside.empty()) return inside;
    const auto axes = oriented_box(scan.points).axis;
    const Shells found = shells(scan);
    const Solids grouped = solids(scan, found, axes[0]);
    std::vector<Piece> pieces;
    for (TriangleMesh& solid : split_solids(scan, found, grouped)) {
        pieces.push_back({{}, std::make_shared<const TriangleMesh>(std::move(solid)), {}});
    }
    SampledScanOptions options;
    options.samples = samples;
    const SampledScan sampled = sampled_scan(pieces, tool_directions(axes), options);
    std::vector<std::vector<std::uint8_t>> label = by_majority(sampled, closed_samples(sampled, context));
    for (std::size_t i = 0; i < label.size(); ++i) spread(*sampled.solid[i], label[i]);
    // A solid's triangles stand in the order of the scan.
    const std::vector<std::uint32_t> solid_of = solid_of_triangle(found, grouped);
    std::vector<std::size_t> next(label.size());
    for (std::size_t t = 0; t < inside.size(); ++t) inside[t] = label[solid_of[t]][next[solid_of[t]]++];
    return inside;
}

}  // namespace qchopper
