// Bounds are computed again only for normals of which planes were evaluated. O(planes) per round beside them.

#include "segment/search/best_first.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

double last_of_best(const BestFirst& search, const Bounds& bounds) {
    std::vector<double> costs;
    for (std::size_t n = 0; n < bounds.size(); ++n) {
        for (std::size_t k = 0; k < bounds[n].size(); ++k) {
            if (search.planes[n][k].stage == TermStage::whole && bounds[n][k] < never) costs.push_back(bounds[n][k]);
        }
    }
    if (costs.size() < search.best) return never;
    const auto last = costs.begin() + static_cast<std::ptrdiff_t>(search.best) - 1;
    std::nth_element(costs.begin(), last, costs.end());
    return *last;
}

// The normals with planes that can win, the least bound first.
std::vector<std::size_t> next_normals(const BestFirst& search, const Bounds& bounds, double most) {
    std::vector<std::pair<double, std::size_t>> open;  // least bound, normal
    for (std::size_t n = 0; n < bounds.size(); ++n) {
        double least = never;
        for (std::size_t k = 0; k < bounds[n].size(); ++k) {
            if (can_win(search.planes[n][k], bounds[n][k], most)) least = std::min(least, bounds[n][k]);
        }
        if (least < never) open.emplace_back(least, n);
    }
    std::sort(open.begin(), open.end());
    open.resize(std::min(open.size(), search.normals_at_once));
    std::vector<std::size_t> normals;
    normals.reserve(open.size());
    for (const auto& [least, n] : open) normals.push_back(n);
    return normals;
}

}  // namespace

double evaluate_what_can_win(const BestFirst& search) {
    Bounds bounds(search.planes.size());
    const auto update = [&](std::size_t n) {
        bounds[n].resize(search.planes[n].size());
        for (std::size_t k = 0; k < bounds[n].size(); ++k) bounds[n][k] = search.bound(n, k);
    };
    parallel_for(0, bounds.size(), update);
    while (true) {
        const double most = last_of_best(search, bounds);
        const std::vector<std::size_t> normals = next_normals(search, bounds, most);
        if (normals.empty()) return most;
        search.evaluate(normals, bounds, most);
        parallel_for(0, normals.size(), [&](std::size_t i) { update(normals[i]); });
    }
}

void keep_least(std::vector<std::size_t>& planes, std::size_t count, std::span<const double> values) {
    if (planes.size() <= count) return;
    std::stable_sort(planes.begin(), planes.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    planes.resize(count);
    std::sort(planes.begin(), planes.end());
}

}  // namespace qchopper
