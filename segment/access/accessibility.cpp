// Rays are cast sample by sample, so that consecutive rays begin in the same place of the tree; a cut copies the rows
// of the samples and turns the distances beyond its plane infinite. About half of samples x directions are rays, of
// O(log triangles) each; a cut takes O(samples * directions), and new rays only where it parts solids on one side.

#include "segment/access/accessibility.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr float open = std::numeric_limits<float>::infinity();
constexpr float blocked_at_once = 0;
constexpr double off_the_surface = 1e-6;  // of the diagonal: where rays begin
constexpr double flush = 4e-6;            // of the diagonal
constexpr std::size_t samples_at_once = 16;
constexpr std::uint32_t no_label = std::numeric_limits<std::uint32_t>::max();

// A piece as rays see it.
struct PieceRegion {
    std::uint32_t solid = 0;
    std::span<const HalfSpace> half_spaces;
    RayFilter own;  // the triangles of the piece; no label: all of the solid
};

Vec3 ray_origin(const SampledScan& scan, const SurfaceSample& sample) {
    return sample.point + (off_the_surface * scan.diagonal_mm) * sample.normal;
}

bool is_inside(const HalfSpace& half_space, Vec3 point) {
    return (height(half_space.plane.normal, point) >= half_space.plane.offset) == half_space.above;
}

// Whether a point of a triangle lies in the half-space; where all corners are on one side, as the cut decides it.
bool is_inside(const HalfSpace& half_space, const std::array<Vec3, 3>& corners, Vec3 point) {
    const auto holds = [&](Vec3 corner) { return is_inside(half_space, corner); };
    const auto inside = std::count_if(corners.begin(), corners.end(), holds);
    return inside == 3 || (inside > 0 && is_inside(half_space, point));
}

float cast(const SampledScan& scan, const PieceRegion& region, const SurfaceSample& sample, Vec3 direction) {
    if (dot(sample.normal, direction) < min_facing) return blocked_at_once;
    const TriangleMesh& mesh = *scan.solid[region.solid];
    const Vec3 origin = ray_origin(scan, sample);
    std::optional<RayHit> hit = scan.rays.first_hit(region.solid, origin, direction);
    if (!hit) return open;
    if (dot(area_vector(mesh, hit->triangle), direction) > 0) return blocked_at_once;
    const bool is_own = region.own.label.empty() || region.own.label[hit->triangle] == region.own.wanted;
    const auto lies_beyond = [&](const HalfSpace& half_space) {
        return !is_inside(half_space, corners_of(mesh, hit->triangle), origin + hit->distance * direction);
    };
    const auto is_beyond_a_plane = [&] {
        return std::any_of(region.half_spaces.begin(), region.half_spaces.end(), lies_beyond);
    };
    if (is_beyond_a_plane()) return open;
    if (!is_own) {  // another piece between the same planes is nearer
        hit = scan.rays.first_hit(region.solid, origin, direction, region.own);
        if (!hit || is_beyond_a_plane()) return open;
    }
    return static_cast<float>(hit->distance);
}

// Labels of the uncut solid's triangles: the index of the made piece on this side that has a part of it. Between the
// planes of the pieces a triangle is convex, so that it belongs to one of them.
std::vector<std::uint32_t> labels_of_side(const SampledScan& scan, std::span<const PieceAccessibility> made,
                                          bool above) {
    assert(!made.empty());
    std::vector<std::uint32_t> label(scan.solid[made.front().solid]->triangles.size(), no_label);
    for (std::size_t k = 0; k < made.size(); ++k) {
        if (made[k].half_spaces.back().above != above) continue;
        for (const std::uint32_t t : made[k].scan_triangle) {
            if (t != no_parent) label[t] = static_cast<std::uint32_t>(k);
        }
    }
    return label;
}

// A made piece, still without samples.
PieceAccessibility without_samples(const PieceAccessibility& parent, const Piece& made,
                                   std::span<const std::uint32_t> parent_triangle) {
    PieceAccessibility result;
    result.solid = parent.solid;
    result.half_spaces = made.half_spaces;
    result.scan_triangle.reserve(parent_triangle.size());
    for (const std::uint32_t t : parent_triangle) {
        result.scan_triangle.push_back(t == no_parent ? no_parent : parent.scan_triangle[t]);
    }
    return result;
}

bool contains(const Box& box, Vec3 p) {
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && p.z >= box.min.z &&
           p.z <= box.max.z;
}

// Where other solids of the same side lie: a ray that met the surface elsewhere met its own solid, and still does.
class OtherSolids {
 public:
    OtherSolids(const SampledScan& scan, std::span<const PieceAccessibility> made, const CutPieces& pieces,
                std::size_t own) {
        const double margin = flush * scan.diagonal_mm;
        for (std::size_t k = 0; k < made.size(); ++k) {
            if (k == own || made[k].half_spaces.back().above != made[own].half_spaces.back().above) continue;
            Box box = bounds(*pieces.pieces[k].mesh);
            box.min = box.min - Vec3{margin, margin, margin};
            box.max = box.max + Vec3{margin, margin, margin};
            boxes_.push_back(box);
        }
    }
    bool may_hold(Vec3 point) const {
        return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) { return contains(box, point); });
    }

 private:
    std::vector<Box> boxes_;
};

// The distances of a row after a cut by the last half-space of the region.
void update_row(const SampledScan& scan, const PieceRegion& region, const SurfaceSample& sample,
                const OtherSolids& others, std::span<float> row) {
    const HalfSpace& cut = region.half_spaces.back();
    const Vec3 outward = -cut.up();
    const Vec3 origin = ray_origin(scan, sample);
    const double above = height(cut.plane.normal, origin) - cut.plane.offset;
    const double depth = cut.above ? above : -above;  // of the origin under the plane, along the outward normal
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (row[k] == open || row[k] == blocked_at_once) continue;
        const double along = dot(outward, scan.directions[k]);
        const double left = depth - static_cast<double>(row[k]) * along;  // the same of the hit
        const bool is_flush = std::abs(left) < flush * scan.diagonal_mm;
        if (!is_flush && along > 0 && left < 0)
            row[k] = open;
        else if (is_flush || others.may_hold(origin + static_cast<double>(row[k]) * scan.directions[k]))
            row[k] = cast(scan, region, sample, scan.directions[k]);
    }
}

}  // namespace

SampledScan sampled_scan(std::span<const Piece> uncut, std::vector<Vec3> directions,
                         const SampledScanOptions& options) {
    assert(options.is_left_out.empty() || options.is_left_out.size() == uncut.size());
    std::vector<std::shared_ptr<const TriangleMesh>> solid;
    std::vector<const TriangleMesh*> meshes;
    std::vector<SampledSurface> surfaces;
    std::optional<Box> box;
    for (std::size_t i = 0; i < uncut.size(); ++i) {
        assert(uncut[i].mesh && uncut[i].half_spaces.empty());
        solid.push_back(uncut[i].mesh);
        meshes.push_back(uncut[i].mesh.get());
        surfaces.push_back({meshes.back(), options.is_left_out.empty() ? std::vector<bool>{} : options.is_left_out[i]});
        const Box of_solid = bounds(*meshes.back());
        if (!box) box = of_solid;
        extend(*box, of_solid.min);
        extend(*box, of_solid.max);
    }
    return {std::move(solid), surface_samples(surfaces, options.samples), std::move(directions),
            PreciseRays(meshes, options.instructions), box ? norm(box->size()) : 0};
}

std::vector<PieceAccessibility> unasked_accessibility(const SampledScan& scan) {
    std::vector<PieceAccessibility> pieces(scan.solid.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        pieces[i].solid = i;
        pieces[i].scan_triangle.resize(scan.solid[i]->triangles.size());
        for (std::uint32_t t = 0; t < pieces[i].scan_triangle.size(); ++t) pieces[i].scan_triangle[t] = t;
    }
    for (std::uint32_t i = 0; i < scan.samples.sample.size(); ++i) {
        pieces[scan.samples.sample[i].mesh].sample.push_back(i);
    }
    return pieces;
}

std::vector<PieceAccessibility> uncut_accessibility(const SampledScan& scan) {
    const std::size_t directions = scan.directions.size();
    std::vector<PieceAccessibility> pieces = unasked_accessibility(scan);
    for (PieceAccessibility& piece : pieces) {
        piece.distance.resize(piece.sample.size() * directions);
        parallel_ranges(0, piece.sample.size(), samples_at_once, [&](std::size_t first, std::size_t end) {
            for (std::size_t row = first; row < end; ++row) {
                const SurfaceSample& sample = scan.samples.sample[piece.sample[row]];
                for (std::size_t k = 0; k < directions; ++k) {
                    piece.distance[row * directions + k] =
                        cast(scan, {piece.solid, {}, {}}, sample, scan.directions[k]);
                }
            }
        });
    }
    return pieces;
}

std::vector<PieceAccessibility> cut_accessibility(const SampledScan& scan, const PieceAccessibility& piece,
                                                  const CutPieces& made) {
    assert(made.pieces.size() >= 2 && made.parent.size() == made.pieces.size());
    const std::size_t directions = scan.directions.size();
    std::vector<PieceAccessibility> result;
    for (std::size_t k = 0; k < made.pieces.size(); ++k) {
        result.push_back(without_samples(piece, made.pieces[k], made.parent[k]));
    }
    const std::array<std::vector<std::uint32_t>, 2> label{labels_of_side(scan, result, false),
                                                          labels_of_side(scan, result, true)};
    const Plane plane = made.pieces.front().half_spaces.back().plane;
    const HalfSpace above{0, plane, true};
    std::vector<std::vector<std::size_t>> parent_row(result.size());
    for (std::size_t row = 0; row < piece.sample.size(); ++row) {
        const SurfaceSample& sample = scan.samples.sample[piece.sample[row]];
        const bool is_above = is_inside(above, corners_of(*scan.solid[piece.solid], sample.triangle), sample.point);
        // By rounding a sample may lie beyond all parts of its triangle in the piece.
        const std::uint32_t here = label[is_above ? 1 : 0][sample.triangle];
        const std::uint32_t k = here != no_label ? here : label[is_above ? 0 : 1][sample.triangle];
        assert(k != no_label);
        result[k].sample.push_back(piece.sample[row]);
        parent_row[k].push_back(row);
    }
    for (std::uint32_t k = 0; k < result.size(); ++k) {
        PieceAccessibility& child = result[k];
        const OtherSolids others(scan, result, made, k);
        const PieceRegion region{child.solid, child.half_spaces, {label[child.half_spaces.back().above ? 1 : 0], k}};
        child.distance.resize(child.sample.size() * directions);
        parallel_ranges(0, child.sample.size(), samples_at_once, [&](std::size_t first, std::size_t end) {
            for (std::size_t row = first; row < end; ++row) {
                const std::span<float> distances(child.distance.data() + row * directions, directions);
                const std::span<const float> old = piece.distances(parent_row[k][row]);
                std::copy(old.begin(), old.end(), distances.begin());
                update_row(scan, region, scan.samples.sample[child.sample[row]], others, distances);
            }
        });
    }
    return result;
}

PieceRays::PieceRays(const SampledScan& scan, const PieceAccessibility& piece) : scan_(scan), piece_(piece) {
    if (piece.half_spaces.empty()) return;
    label_.assign(scan.solid[piece.solid]->triangles.size(), no_label);
    for (const std::uint32_t t : piece.scan_triangle) {
        if (t != no_parent) label_[t] = 0;
    }
}

float PieceRays::distance(std::size_t row, Vec3 direction) const {
    assert(row < piece_.sample.size());
    return cast(scan_, {piece_.solid, piece_.half_spaces, {label_, 0}}, scan_.samples.sample[piece_.sample[row]],
                direction);
}

std::vector<float> PieceRays::distances(Vec3 direction) const {
    std::vector<float> result(piece_.sample.size());
    parallel_ranges(0, result.size(), samples_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t row = first; row < end; ++row) result[row] = distance(row, direction);
    });
    return result;
}

}  // namespace qchopper
