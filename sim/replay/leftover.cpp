// Triangles are cut into equal parts by lines along their sides; each part is judged at its middle. O(parts * (cells
// within its distance + closings)), beside the closings (reachable.h).

#include "sim/replay/leftover.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "sim/replay/reach/reachable.h"

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
    std::optional<ReachingTool> by;  // the first one that comes to it; nothing: none does
};
using Reaches = std::vector<std::optional<ReachingTool>>;  // by sample

struct Within {
    double tolerance = 0;  // mm of foam
    double too_deep = 0;   // mm of gouge
    const std::vector<float>& gouge;
};

// Precondition: sorted.
double percentile(const std::vector<std::pair<float, float>>& by_distance, double share) {
    double whole = 0;
    for (const auto& [distance, area] : by_distance) whole += area;
    double sum = 0;
    for (const auto& [distance, area] : by_distance) {
        sum += area;
        if (sum >= share * whole) return distance;
    }
    return 0;
}

// Areas and distances. The figures know already what is given up.
void add_up(LeftoverFigures& figures, const std::vector<Sample>& samples, const std::vector<Judged>& judged,
            const Reaches& given_up, const Within& within) {
    std::vector<std::pair<float, float>> by_distance;
    std::vector<std::uint32_t> points(figures.distance.size(), 0);  // of a triangle, all of one area
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        const Judged& j = judged[i];
        figures.area_mm2 += s.area;
        figures.distance[s.triangle] += j.distance;
        ++points[s.triangle];
        if (!j.by) {
            figures.largest_unreachable = std::max<double>(figures.largest_unreachable, j.distance);
            continue;
        }
        figures.is_reachable[s.triangle] = true;
        figures.reachable_mm2 += s.area;
        if (given_up[i]) {
            figures.is_given_up[s.triangle] = true;
            continue;
        }
        by_distance.emplace_back(j.distance, s.area);
        if (j.distance <= within.tolerance && within.gouge[s.triangle] <= within.too_deep) {
            figures.within_mm2 += s.area;
        }
        if (j.distance > figures.largest) figures.largest = j.distance, figures.at = s.point;
    }
    for (std::size_t t = 0; t < points.size(); ++t) {
        if (points[t] > 0) figures.distance[t] /= static_cast<float>(points[t]);
    }
    std::sort(by_distance.begin(), by_distance.end());
    figures.median = percentile(by_distance, 0.5);
    figures.percentile_99 = percentile(by_distance, 0.99);
}

std::vector<Judged> judge(const std::vector<Sample>& samples, const StockModel& stock_model, const Reaches& reaches,
                          double most, const Context& context) {
    std::vector<Judged> judged(samples.size());
    constexpr std::size_t lot = 4096;
    for (std::size_t first = 0; first < samples.size(); first += 64 * lot) {
        context.check_cancelled();
        context.progress("points of the surface measured", first, samples.size());
        parallel_ranges(
            first, std::min(samples.size(), first + 64 * lot), lot, [&](std::size_t begin, std::size_t end) {
                std::size_t nearest = 0;
                for (std::size_t i = begin; i < end; ++i) {
                    const double distance = stock_model.distance_to_removed(samples[i].point, most, nearest);
                    judged[i] = {static_cast<float>(distance), reaches[i]};
                }
            });
    }
    return judged;
}

// Areas of the points that are given up, by what would come to them.
std::vector<GivenUp> areas_of(const Reaches& given_up, const std::vector<Sample>& samples,
                              const std::vector<CuttingTool>& tools) {
    std::vector<GivenUp> all;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!given_up[i]) continue;
        const GivenUp own{tools[given_up[i]->tool].number, given_up[i]->orientation, samples[i].area};
        const auto same = std::find_if(all.begin(), all.end(), [&](const GivenUp& other) {
            return other.tool == own.tool && other.orientation == own.orientation;
        });
        if (same == all.end()) {
            all.push_back(own);
        } else {
            same->area_mm2 += own.area_mm2;
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const GivenUp& a, const GivenUp& b) { return a.area_mm2 > b.area_mm2; });
    return all;
}

std::vector<std::size_t> all_tools(const ReplayScene& scene) {
    std::vector<std::size_t> tools(scene.cell->machine->tools.size());
    std::iota(tools.begin(), tools.end(), std::size_t{0});
    return tools;
}

}  // namespace

double LeftoverFigures::sum_of(const std::vector<GivenUp>& surface) {
    double sum = 0;
    for (const GivenUp& given_up : surface) sum += given_up.area_mm2;
    return sum;
}

LeftoverFigures measure_leftover(const StockModel& stock_model, const ReplayScene& scene,
                                 const std::vector<float>& gouge, const LeftoverOptions& options,
                                 const Context& context) {
    const TriangleMesh& mesh = *scene.target;
    std::vector<Sample> samples;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (scene.is_unmilled.empty() || !scene.is_unmilled[t]) add_samples(mesh, t, options.sample_mm, samples);
    }
    const double within_reach = scene.scallop + 0.75 * options.reach_cell;
    const double tolerance = scene.scallop + options.too_much;
    // Of the samples that hold a condition; nothing for the others.
    const auto reach_where = [&](const auto& holds, const ToolsOf& tools_of) {
        std::vector<std::size_t> asked;
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (!holds(i)) continue;
            asked.push_back(i);
            points.push_back(samples[i].point);
        }
        Reaches all(samples.size());
        const Reaches found = first_reach(scene, points, tools_of, options.reach_cell, within_reach, context);
        for (std::size_t k = 0; k < asked.size(); ++k) all[asked[k]] = found[k];
        return all;
    };
    const Reaches allowed =
        reach_where([](std::size_t) { return true; }, [&](std::size_t) { return allowed_tools(scene); });
    const std::vector<Judged> judged = judge(samples, stock_model, allowed, options.most, context);

    // Of a point that keeps too much foam: what would come to it, where nothing that is used does.
    const auto keeps_too_much = [&](std::size_t i) { return judged[i].distance > tolerance; };
    const auto is_kept_in_reach = [&](std::size_t i) { return judged[i].by && keeps_too_much(i); };
    const Reaches used = reach_where(is_kept_in_reach, [&](std::size_t d) { return tools_along(scene, d); });
    Reaches given_up(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (is_kept_in_reach(i) && !used[i]) given_up[i] = judged[i].by;
    }
    Reaches not_allowed(samples.size());
    if (!scene.tools.empty()) {
        not_allowed = reach_where([&](std::size_t i) { return !judged[i].by && keeps_too_much(i); },
                                  [&](std::size_t) { return all_tools(scene); });
    }
    LeftoverFigures figures;
    figures.given_up = areas_of(given_up, samples, scene.cell->machine->tools);
    figures.not_allowed = areas_of(not_allowed, samples, scene.cell->machine->tools);
    figures.distance.assign(mesh.triangles.size(), 0);
    figures.is_reachable.assign(mesh.triangles.size(), false);
    figures.is_given_up.assign(mesh.triangles.size(), false);
    add_up(figures, samples, judged, given_up, {tolerance, options.too_deep, gouge});
    return figures;
}

}  // namespace qchopper
