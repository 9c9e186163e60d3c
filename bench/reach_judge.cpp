// Samples at equal steps of area along the order of the triangles; directions on a Fibonacci spiral around each base's
// up (Gonzalez 2010); per sample one direction after the other until one is free.

#include "bench/reach_judge.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "base/parallel.h"
#include "bench/embree_rays.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/raster/projected_area.h"

namespace qchopper::bench {
namespace {

constexpr double min_cosine = 0.05;            // surface that faces a direction less is not open along it
constexpr double away = -1e-9;                 // a cap that faces away has a cosine below this with every direction
constexpr double min_base = 0.1;               // of the projected area
constexpr double steep_counts_from = 15;       // degrees of tilt
constexpr double lift = 1e-6;                  // of the piece's diagonal: how far above the surface rays begin
constexpr std::uint64_t seed = 0x9a3c5e71;     // not that of the search
constexpr std::size_t stride = 381;            // so far apart are two directions that are asked in a row
constexpr std::size_t samples_at_once = 128U;  // of one thread

struct Sample {
    Vec3 point;
    Vec3 normal;
};

struct Cap {
    std::optional<std::int32_t> cut;  // nothing: a side of the box
    Vec3 up;                          // inward
    double area_mm2 = 0;
};

// In [0, 1), the same on every platform.
double unit_random(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

// Uniform in the triangle: Turk, "Generating random points in triangles" (1990).
Vec3 random_point(const TriangleMesh& mesh, std::size_t triangle, std::mt19937_64& random) {
    const auto corner = corners_of(mesh, triangle);
    double s = unit_random(random);
    double t = unit_random(random);
    if (s + t > 1) {
        s = 1 - s;
        t = 1 - t;
    }
    return corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]);
}

std::vector<Sample> samples_of(const TriangleMesh& mesh, std::size_t count) {
    std::mt19937_64 random(seed);
    std::vector<Sample> samples;
    const double step = uncut_area_mm2(mesh) / static_cast<double>(count);
    double next = unit_random(random) * step;  // the area before the next sample
    double before = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) continue;
        const Vec3 area = area_vector(mesh, t);
        before += norm(area);
        for (; next < before; next += step) samples.push_back({random_point(mesh, t, random), normalized(area)});
    }
    return samples;
}

// Visits all of so many directions.
std::size_t coprime_stride(std::size_t count) {
    std::size_t result = stride;
    while (std::gcd(result, count) != 1) ++result;
    return result;
}

// Spread evenly over the cap of the sphere around `up`, which is the first; two in a row lie far apart.
std::vector<Vec3> directions_round(Vec3 up, double tilt_deg, std::size_t count) {
    const Vec3 u = normalized(cross(up, std::abs(up.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Vec3 v = cross(up, u);
    const double lowest = std::cos(tilt_deg * std::numbers::pi / 180);
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    const std::size_t apart = coprime_stride(count);
    std::vector<Vec3> directions{up};
    for (std::size_t i = 1; i < count; ++i) {
        const auto k = static_cast<double>(i * apart % count);
        const double z = 1 - (1 - lowest) * k / static_cast<double>(count - 1);
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        directions.push_back(z * up + (r * std::cos(golden * k)) * u + (r * std::sin(golden * k)) * v);
    }
    return directions;
}

// With all caps of the piece and their areas.
std::vector<Cap> caps_of(const Piece& piece) {
    std::map<std::int32_t, double> area;
    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        const std::int32_t cut = cap_of(*piece.mesh, t);
        if (cut != no_cap) area[cut] += norm(area_vector(*piece.mesh, t));
    }
    std::vector<Cap> caps;
    for (const HalfSpace& side : piece.half_spaces) {
        if (area.contains(side.cut)) caps.push_back({side.cut, side.up(), area[side.cut]});
    }
    return caps;
}

std::vector<Cap> bases_of(const TriangleMesh& mesh, const std::vector<Cap>& caps) {
    std::vector<Cap> bases;
    for (const Cap& cap : caps) {
        if (cap.area_mm2 >= min_base * projected_area_mm2(mesh, cap.up)) bases.push_back(cap);
    }
    if (!bases.empty()) return bases;
    for (const Vec3& axis : oriented_box(mesh.points).axis) {
        bases.push_back({std::nullopt, axis, 0});
        bases.push_back({std::nullopt, -axis, 0});
    }
    return bases;
}

// The mesh around the origin, where single precision is finest.
TriangleMesh centred(const TriangleMesh& mesh, Vec3 centre) {
    TriangleMesh moved = mesh;
    for (Vec3& p : moved.points) p = p - centre;
    return moved;
}

// One piece with its samples and its tree.
class PieceJudge {
 public:
    PieceJudge(const Piece& piece, const JudgeOptions& options)
        : piece_(piece),
          options_(options),
          centre_(bounds(*piece.mesh).centre()),
          lift_mm_(lift * norm(bounds(*piece.mesh).size())),
          rays_(centred(*piece.mesh, centre_)),
          samples_(samples_of(*piece.mesh, options.samples)),
          caps_(caps_of(piece)) {
        scan_mm2_ = uncut_area_mm2(*piece.mesh);
    }

    PieceVerdict best() const {
        std::optional<PieceVerdict> best;
        for (const Cap& base : bases_of(*piece_.mesh, caps_)) {
            const PieceVerdict verdict = on(base);
            if (!best || verdict.unreachable_mm2 < best->unreachable_mm2) best = verdict;
        }
        return *best;
    }

 private:
    PieceVerdict on(const Cap& base) const {
        const std::vector<Vec3> directions = directions_round(base.up, options_.tilt_deg, options_.directions);
        PieceVerdict verdict{hidden_mm2(directions), scan_mm2_};
        for (const Cap& cap : caps_) {
            if (base.cut && cap.cut == base.cut) continue;
            verdict.area_mm2 += cap.area_mm2;
            const bool is_away = std::all_of(directions.begin(), directions.end(),
                                             [&](const Vec3& d) { return dot(-cap.up, d) < away; });
            if (is_away) verdict.unreachable_mm2 += cap.area_mm2;
        }
        return verdict;
    }

    double hidden_mm2(const std::vector<Vec3>& directions) const {
        if (samples_.empty()) return 0;
        std::atomic<std::size_t> hidden = 0;
        parallel_ranges(0, samples_.size(), samples_at_once, [&](std::size_t first, std::size_t end) {
            std::size_t last = 0;  // the direction that was free for the sample before
            for (std::size_t i = first; i < end; ++i) {
                if (!is_reached(samples_[i], directions, last) && !is_pardoned(samples_[i], directions)) ++hidden;
            }
        });
        return scan_mm2_ * static_cast<double>(hidden) / static_cast<double>(samples_.size());
    }

    bool is_reached(const Sample& sample, const std::vector<Vec3>& directions, std::size_t& last) const {
        const Vec3 origin = (sample.point - centre_) + lift_mm_ * sample.normal;
        const auto is_open = [&](const Vec3& d) {
            return dot(sample.normal, d) >= min_cosine && rays_.is_free({origin, d});
        };
        if (is_open(directions[last])) return true;
        const auto open = std::find_if(directions.begin(), directions.end(), is_open);
        if (open == directions.end()) return false;
        last = static_cast<std::size_t>(open - directions.begin());
        return true;
    }

    // Steep surface, which does not count for a tool that hardly tilts.
    bool is_pardoned(const Sample& sample, const std::vector<Vec3>& directions) const {
        return options_.tilt_deg < steep_counts_from &&
               std::any_of(directions.begin(), directions.end(),
                           [&](const Vec3& d) { return std::abs(dot(sample.normal, d)) < min_cosine; });
    }

    const Piece& piece_;
    const JudgeOptions& options_;
    Vec3 centre_;
    double lift_mm_;
    EmbreeRays rays_;
    std::vector<Sample> samples_;
    std::vector<Cap> caps_;
    double scan_mm2_ = 0;
};

}  // namespace

double uncut_area_mm2(const TriangleMesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap) area += norm(area_vector(mesh, t));
    }
    return area;
}

PieceVerdict judge(const Piece& piece, const JudgeOptions& options) {
    return PieceJudge(piece, options).best();
}

}  // namespace qchopper::bench
