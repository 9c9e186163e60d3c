// Triangles are cut into equal parts by lines along their sides; each part is judged at its middle.

#include "sim/replay/leftover.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sim/replay/reachable.h"

namespace qchopper {
namespace {

struct Sample {
    Vec3 point;
    float area = 0;
    std::uint32_t triangle = 0;
};

// The middles of the n * n equal parts of a triangle.
void add_samples(const TriangleMesh& mesh, std::uint32_t t, double spacing, std::vector<Sample>& samples) {
    const std::array<Vec3, 3> c = corners_of(mesh, t);
    const double longest = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
    const int n = std::max(1, static_cast<int>(std::ceil(std::min(longest / spacing, 2000.0))));
    const auto area = static_cast<float>(norm(area_vector(mesh, t)) / n / n);
    const Vec3 u = (1.0 / n) * (c[1] - c[0]);
    const Vec3 v = (1.0 / n) * (c[2] - c[0]);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            samples.push_back({c[0] + (i + 1.0 / 3) * u + (j + 1.0 / 3) * v, area, t});
            if (j + 1 < n - i) samples.push_back({c[0] + (i + 2.0 / 3) * u + (j + 2.0 / 3) * v, area, t});
        }
    }
}

struct Judged {
    float distance = 0;
    bool is_reachable = false;
};

double percentile(std::vector<std::pair<float, float>>& by_distance, double share) {
    std::sort(by_distance.begin(), by_distance.end());
    double whole = 0;
    for (const auto& [distance, area] : by_distance) whole += area;
    double sum = 0;
    for (const auto& [distance, area] : by_distance) {
        sum += area;
        if (sum >= share * whole) return distance;
    }
    return 0;
}

}  // namespace

LeftoverFigures measure_leftover(const Foam& foam, const ReplayScene& scene, const std::vector<float>& gouge,
                                 const LeftoverOptions& options, const Context& context) {
    const TriangleMesh& mesh = *scene.target;
    std::vector<SurfaceMap> closings;
    const auto finest = finest_tools(scene);
    for (std::size_t d = 0; d < finest.size(); ++d) {
        context.progress("directions closed", d, finest.size());
        if (!finest[d]) continue;
        closings.push_back(closing_of(scene, d, scene.cell->machine->tools[*finest[d]], options.reach_cell, context));
    }
    std::vector<Sample> samples;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (scene.is_base.empty() || !scene.is_base[t]) add_samples(mesh, t, options.sample_mm, samples);
    }
    const double within_reach = scene.scallop + 0.75 * options.reach_cell;
    std::vector<Judged> judged(samples.size());
    constexpr std::size_t lot = 4096;
    for (std::size_t first = 0; first < samples.size(); first += 64 * lot) {
        context.check_cancelled();
        context.progress("points of the surface measured", first, samples.size());
        parallel_ranges(first, std::min(samples.size(), first + 64 * lot), lot,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t i = begin; i < end; ++i) {
                                const Vec3 p = samples[i].point;
                                for (const SurfaceMap& map : closings) {
                                    const Vec3 q = apply_inverse(map.frame_in_setup, p);
                                    judged[i].is_reachable |= map.distance_above(q, within_reach + 1) <= within_reach;
                                }
                                judged[i].distance = static_cast<float>(foam.distance_to_removed(p, options.most));
                            }
                        });
    }
    LeftoverFigures figures;
    figures.distance.assign(mesh.triangles.size(), 0);
    figures.is_reachable.assign(mesh.triangles.size(), false);
    std::vector<std::pair<float, float>> by_distance;
    const double tolerance = scene.scallop + options.too_much;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        const Judged& j = judged[i];
        figures.area_mm2 += s.area;
        figures.distance[s.triangle] = std::max(figures.distance[s.triangle], j.distance);
        if (!j.is_reachable) {
            figures.largest_unreachable = std::max<double>(figures.largest_unreachable, j.distance);
            continue;
        }
        figures.is_reachable[s.triangle] = true;
        figures.reachable_mm2 += s.area;
        by_distance.emplace_back(j.distance, s.area);
        if (j.distance <= tolerance && gouge[s.triangle] <= options.too_deep) figures.within_mm2 += s.area;
        if (j.distance > figures.largest) figures.largest = j.distance, figures.at = s.point;
    }
    figures.percentile_99 = percentile(by_distance, 0.99);
    return figures;
}

}  // namespace qchopper
