// The lattice is kept in blocks of 8 x 8 x 8 cells, those alone that some triangle comes near. A list of triangles per
// block is made first, so that each block is made by one thread, scan after scan. O(triangles * points of the lattice
// within reach of one).

#include "segment/fuse/distance_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/mesh/marching_tetrahedra.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr double reach_voxels = 2;
constexpr int block_cells = 8;
constexpr int block_shift = 4;  // of a coordinate in half cells
constexpr std::size_t block_points = 2 * block_cells * block_cells * block_cells;
constexpr std::size_t max_blocks = 200'000'000 / block_points;
constexpr float unseen = std::numeric_limits<float>::quiet_NaN();

using BlockKey = std::uint64_t;  // x, y, z with 20 bits each

BlockKey key_of(int x, int y, int z) {
    return static_cast<BlockKey>(x) << 40U | static_cast<BlockKey>(y) << 20U | static_cast<BlockKey>(z);
}

// The corner or the centre with these coordinates, within its block.
std::size_t index_in_block(LatticePoint p) {
    constexpr int mask = (1 << block_shift) - 1;
    const int cell = (((p.z & mask) >> 1) * block_cells + ((p.y & mask) >> 1)) * block_cells + ((p.x & mask) >> 1);
    const int index = 2 * cell + (p.x & 1);
    return static_cast<std::size_t>(index);
}

struct ScanCorner {
    Vec3 point;
    Vec3 normal;
    double weight = 0;
    bool is_border = false;
};

// Of one scan, in the common frame.
struct NearFace {
    std::array<ScanCorner, 3> corner;
    std::uint8_t open = 0;  // as ScanSurface::open
    Vec3 across;            // unit normal
    Vec3 centre;
    double radius = 0;  // of the ball about the centre that holds it
};

struct NearTriangle {
    BlockKey block = 0;
    std::uint32_t scan = 0;
    std::uint32_t triangle = 0;
    bool operator<(const NearTriangle& o) const {
        return std::tie(block, scan, triangle) < std::tie(o.block, o.scan, o.triangle);
    }
};

// Of one scan at the points of a block: the distance of the nearest triangle so far.
struct BlockDistances {
    std::array<double, block_points> size{};  // without sign
    std::array<double, block_points> signed_by_normal{};
    std::array<double, block_points> weight{};  // 0: at a border
    void clear() { size.fill(std::numeric_limits<double>::infinity()); }
};

class Lattice {
 public:
    Lattice(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, double voxel, const Context& context)
        : surfaces_(surfaces), half_(0.5 * voxel), reach_(reach_voxels * voxel), context_(context) {
        move(poses);
        list_blocks();
    }

    TriangleMesh surface() {
        make_blocks();
        MarchingTetrahedra marching;
        for (std::size_t b = 0; b < keys_.size(); ++b) {
            if ((b & 255U) == 0) context_.check_cancelled();
            march_block(b, marching);
        }
        return std::move(marching.mesh());
    }

    double value(LatticePoint p) const {
        const int neighbour =
            ((p.x >> block_shift) - at_.x) + 2 * ((p.y >> block_shift) - at_.y) + 4 * ((p.z >> block_shift) - at_.z);
        const std::vector<float>* values = around_[static_cast<std::size_t>(neighbour)];
        return values == nullptr || values->empty() ? unseen : (*values)[index_in_block(p)];
    }

    // As in segment/sample/isosurface.cpp: away from both ends, so that every triangle has an area.
    Vec3 crossing(LatticePoint a, LatticePoint b) const {
        constexpr double margin = 0.08;
        const double va = value(a);
        const double t = std::clamp(va / (va - value(b)), margin, 1 - margin);
        return place(a) + t * (place(b) - place(a));
    }

 private:
    Vec3 place(LatticePoint p) const { return origin_ + Vec3{half_ * p.x, half_ * p.y, half_ * p.z}; }

    void move(std::span<const Pose> poses) {
        Box box;
        bool is_first = true;
        for (std::size_t s = 0; s < surfaces_.size(); ++s) {
            const ScanSurface& surface = surfaces_[s];
            std::vector<ScanCorner> moved;
            for (std::size_t i = 0; i < surface.mesh.points.size(); ++i) {
                moved.push_back({apply(poses[s], surface.mesh.points[i]), rotate(poses[s], surface.normals[i]),
                                 surface.weights[i], surface.border[i] != 0});
                const Vec3 p = moved.back().point;
                if (is_first) box = {p, p};
                is_first = false;
                extend(box, p);
            }
            corners_.push_back(std::move(moved));
        }
        const double margin = reach_ + 4 * half_;
        origin_ = box.min - Vec3{margin, margin, margin};
        const Vec3 size = box.size();
        const double halves = (std::max({size.x, size.y, size.z}) + 2 * margin) / half_;
        if (halves > (1 << 19)) refuse();
    }

    [[noreturn]] static void refuse() {
        throw InputError(InputFault::use, "the lattice would have more than 200 million points",
                         Sentence::with_key("larger_voxel", {}, "give a larger voxel"));
    }

    std::array<Vec3, 3> points_of(std::size_t scan, std::size_t triangle) const {
        const Triangle& t = surfaces_[scan].mesh.triangles[triangle];
        return {corners_[scan][t[0]].point, corners_[scan][t[1]].point, corners_[scan][t[2]].point};
    }

    // The coordinates in half cells within reach of a triangle along one axis.
    std::pair<int, int> range_of(const std::array<Vec3, 3>& points, int axis) const {
        const auto [low, high] = std::minmax({points[0][axis], points[1][axis], points[2][axis]});
        return {static_cast<int>(std::ceil((low - reach_ - origin_[axis]) / half_)),
                static_cast<int>(std::floor((high + reach_ - origin_[axis]) / half_))};
    }

    void list_blocks() {
        // A triangle of the size of a cell is in reach of about four blocks.
        std::size_t most = 40 * max_blocks;
        for (const ScanSurface& surface : surfaces_) most += 8 * surface.mesh.triangles.size();
        for (std::size_t s = 0; s < surfaces_.size(); ++s) {
            context_.check_cancelled();
            for (std::size_t t = 0; t < surfaces_[s].mesh.triangles.size(); ++t) {
                const std::array<Vec3, 3> points = points_of(s, t);
                const auto x = range_of(points, 0);
                const auto y = range_of(points, 1);
                const auto z = range_of(points, 2);
                for (int k = z.first >> block_shift; k <= z.second >> block_shift; ++k) {
                    for (int j = y.first >> block_shift; j <= y.second >> block_shift; ++j) {
                        for (int i = x.first >> block_shift; i <= x.second >> block_shift; ++i) {
                            near_.push_back(
                                {key_of(i, j, k), static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(t)});
                        }
                    }
                }
                if (near_.size() > most) refuse();
            }
        }
        std::sort(near_.begin(), near_.end());
        for (std::size_t i = 0; i < near_.size(); ++i) {
            if (i > 0 && near_[i].block == near_[i - 1].block) continue;
            keys_.push_back(near_[i].block);
            first_.push_back(i);
        }
        first_.push_back(near_.size());
        if (keys_.size() > max_blocks) refuse();
        for (std::size_t b = 0; b < keys_.size(); ++b) number_of_.emplace(keys_[b], b);
    }

    static LatticePoint origin_of(BlockKey key) {
        constexpr BlockKey mask = (1U << 20U) - 1;
        return {static_cast<int>(key >> 40U), static_cast<int>(key >> 20U & mask), static_cast<int>(key & mask)};
    }

    void make_blocks() {
        values_.resize(keys_.size());
        constexpr std::size_t grain = 16;
        parallel_ranges(0, keys_.size(), grain, [&](std::size_t first, std::size_t end) {
            context_.check_cancelled();
            for (std::size_t b = first; b < end; ++b) make_block(b);
        });
    }

    void make_block(std::size_t b) {
        std::array<double, block_points> sum{};
        std::array<double, block_points> weight{};
        BlockDistances own;
        bool is_any_seen = false;
        for (std::size_t i = first_[b]; i < first_[b + 1];) {
            const std::uint32_t scan = near_[i].scan;
            own.clear();
            for (; i < first_[b + 1] && near_[i].scan == scan; ++i) add_triangle(keys_[b], near_[i], own);
            for (std::size_t p = 0; p < block_points; ++p) {
                if (!(own.size[p] <= reach_) || own.weight[p] <= 0) continue;
                sum[p] += own.weight[p] * own.signed_by_normal[p];
                weight[p] += own.weight[p];
                is_any_seen = true;
            }
        }
        if (!is_any_seen) return;
        values_[b].resize(block_points);
        for (std::size_t p = 0; p < block_points; ++p) {
            values_[b][p] = weight[p] > 0 ? static_cast<float>(sum[p] / weight[p]) : unseen;
        }
    }

    NearFace face_of(const NearTriangle& near) const {
        const ScanSurface& surface = surfaces_[near.scan];
        const Triangle& t = surface.mesh.triangles[near.triangle];
        const std::vector<ScanCorner>& corners = corners_[near.scan];
        NearFace face{{corners[t[0]], corners[t[1]], corners[t[2]]}, surface.open[near.triangle], {}, {}, 0};
        const auto& [a, b, c] = face.corner;
        face.across = normalized(cross(b.point - a.point, c.point - a.point));
        face.centre = (1.0 / 3) * (a.point + b.point + c.point);
        for (const ScanCorner& corner : face.corner)
            face.radius = std::max(face.radius, norm(corner.point - face.centre));
        return face;
    }

    // Most points of the lattice are nearer to another triangle of the scan already: two bounds leave them out.
    void add_triangle(BlockKey key, const NearTriangle& near, BlockDistances& own) const {
        const NearFace face = face_of(near);
        const std::array<Vec3, 3> points{face.corner[0].point, face.corner[1].point, face.corner[2].point};
        const LatticePoint block = origin_of(key);
        const auto within = [&](int axis, int low) {
            const auto [first, last] = range_of(points, axis);
            return std::pair{std::max(first, low << block_shift), std::min(last, ((low + 1) << block_shift) - 1)};
        };
        const auto x = within(0, block.x);
        const auto y = within(1, block.y);
        const auto z = within(2, block.z);
        const double ball = reach_ + face.radius;
        for (int k = z.first; k <= z.second; ++k) {
            for (int j = y.first + ((y.first ^ k) & 1); j <= y.second; j += 2) {
                const Vec3 row = place({0, j, k}) - face.centre;
                const double chord = ball * ball - row.y * row.y - row.z * row.z;
                if (chord <= 0) continue;
                const auto [first, last] = within_chord(x, row.x, std::sqrt(chord));
                for (int i = first + ((first ^ k) & 1); i <= last; i += 2) {
                    const Vec3 from{row.x + half_ * i, row.y, row.z};
                    const std::size_t index = index_in_block({i, j, k});
                    const double enough = std::min(own.size[index], reach_);
                    if (std::abs(dot(face.across, from)) >= enough) continue;
                    const double radius = enough + face.radius;
                    if (dot(from, from) < radius * radius) add_distance(face, place({i, j, k}), index, own);
                }
            }
        }
    }

    // The coordinates of a range that are within half a chord of 0, if coordinate 0 is at x.
    std::pair<int, int> within_chord(const std::pair<int, int>& range, double x, double half_chord) const {
        return {std::max(range.first, static_cast<int>(std::ceil((-half_chord - x) / half_))),
                std::min(range.second, static_cast<int>(std::floor((half_chord - x) / half_)))};
    }

    // Whether the point with these shares of the corners is at a border of the scan.
    static bool is_at_border(const NearFace& face, const std::array<double, 3>& share) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (share[k] == 1 && face.corner[k].is_border) return true;
            if (share[(k + 2) % 3] == 0 && (face.open >> k & 1U) != 0) return true;
        }
        return false;
    }

    static void add_distance(const NearFace& face, Vec3 p, std::size_t index, BlockDistances& own) {
        const auto& [a, b, c] = face.corner;
        const auto [point, share] = nearest_of_triangle(p, {a.point, b.point, c.point});
        const Vec3 apart = p - point;
        const double size = norm(apart);
        if (!(size < own.size[index])) return;
        const Vec3 normal = share[0] * a.normal + share[1] * b.normal + share[2] * c.normal;
        own.size[index] = size;
        own.signed_by_normal[index] = dot(apart, normal) < 0 ? -size : size;
        const double weight = share[0] * a.weight + share[1] * b.weight + share[2] * c.weight;
        own.weight[index] = is_at_border(face, share) ? 0 : weight;
    }

    void march_block(std::size_t b, MarchingTetrahedra& marching) {
        if (values_[b].empty()) return;
        at_ = origin_of(keys_[b]);
        for (int n = 0; n < 8; ++n) {
            const auto found = number_of_.find(key_of(at_.x + (n & 1), at_.y + (n >> 1 & 1), at_.z + (n >> 2)));
            around_[static_cast<std::size_t>(n)] = found == number_of_.end() ? nullptr : &values_[found->second];
        }
        for (int k = 0; k < block_cells; ++k) {
            for (int j = 0; j < block_cells; ++j) {
                for (int i = 0; i < block_cells; ++i) {
                    marching.march_cell(*this, {(at_.x << block_shift) + 2 * i, (at_.y << block_shift) + 2 * j,
                                                (at_.z << block_shift) + 2 * k});
                }
            }
        }
    }

    std::span<const ScanSurface> surfaces_;
    double half_;
    double reach_;
    const Context& context_;
    Vec3 origin_;
    std::vector<std::vector<ScanCorner>> corners_;  // of each scan, in the common frame
    std::vector<NearTriangle> near_;                // by block
    std::vector<BlockKey> keys_;
    std::vector<std::size_t> first_;  // of each block in near_
    std::unordered_map<BlockKey, std::size_t> number_of_;
    std::vector<std::vector<float>> values_;  // of each block; empty: no point has been seen
    LatticePoint at_;                         // the block that is marched, in blocks
    std::array<const std::vector<float>*, 8> around_{};
};

}  // namespace

TriangleMesh merge_scans(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, double voxel,
                         const Context& context) {
    return Lattice(surfaces, poses, voxel, context).surface();
}

}  // namespace qchopper
