// Pairs of sites are sorted into classes of their distance, half as wide as what tells two patterns apart, and a few of
// each class are proposed: the first, the last, and one found halfway. O(sites squared) for a pair of sizes.

#include "segment/joint/dowel_pattern.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace qchopper {
namespace {

constexpr std::size_t max_pairs_of_triples = 60;
constexpr std::size_t max_third_sites = 60;
constexpr std::size_t max_triples = 200;

double distance(Point2 a, Point2 b) {
    const double x = a.x - b.x;
    const double y = a.y - b.y;
    return std::sqrt(x * x + y * y);
}

// Whether a, with its dowels in this order, is alike b in its own.
bool is_alike_in_order(const DowelPattern& a, const DowelPattern& b, const std::vector<std::size_t>& order,
                       double tolerance) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[order[i]].size != b[i].size) return false;
        for (std::size_t k = 0; k < i; ++k) {
            const double difference = distance(a[order[i]].at, a[order[k]].at) - distance(b[i].at, b[k].at);
            if (std::abs(difference) > 2 * tolerance) return false;
        }
    }
    return true;
}

std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
}

// Between the axes of two dowels of one joint.
double min_distance(const DowelSize& a, const DowelSize& b) {
    return std::max(3 * std::max(a.diameter, b.diameter), a.radius() + b.radius() + std::max(a.wall, b.wall));
}

struct DistanceClass {
    std::size_t count = 0;
    std::array<std::array<std::uint32_t, 2>, 3> pairs{};  // the first, one halfway, the last
};

// Evenly spread over the list.
std::vector<Point2> some_of(const std::vector<Point2>& points, std::size_t most) {
    const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / most);
    std::vector<Point2> some;
    for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
    return some;
}

std::vector<DistanceClass> classes_of(const std::vector<Point2>& first, const std::vector<Point2>& second, double least,
                                      double width) {
    std::vector<DistanceClass> classes;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        for (std::uint32_t k = 0; k < second.size(); ++k) {
            const double d = distance(first[i], second[k]);
            if (d < least) continue;
            const auto number = static_cast<std::size_t>((d - least) / width);
            if (number >= classes.size()) classes.resize(number + 1);
            DistanceClass& of_distance = classes[number];
            if (of_distance.count == 0) of_distance.pairs.fill({i, k});
            // powers of two: found among the pairs seen so far without keeping them
            if (std::has_single_bit(of_distance.count)) of_distance.pairs[1] = {i, k};
            of_distance.pairs[2] = {i, k};
            ++of_distance.count;
        }
    }
    return classes;
}

}  // namespace

bool are_alike(const DowelPattern& a, const DowelPattern& b, double tolerance) {
    if (a.size() != b.size()) return false;
    std::vector<std::size_t> order = in_order(a.size());
    do {
        if (is_alike_in_order(a, b, order, tolerance)) return true;
    } while (std::next_permutation(order.begin(), order.end()));
    return false;
}

bool can_be_turned(const DowelPattern& pattern, double tolerance) {
    if (pattern.size() < 2) return true;
    std::vector<std::size_t> order = in_order(pattern.size());
    while (std::next_permutation(order.begin(), order.end())) {
        if (is_alike_in_order(pattern, pattern, order, tolerance)) return true;
    }
    return false;
}

std::vector<DowelPattern> pairs_of(std::span<const DowelSize> sizes, const SitesOfSizes& sites, std::size_t a,
                                   std::size_t b, double tolerance) {
    const std::vector<DistanceClass> classes =
        classes_of(sites[a], sites[b], min_distance(sizes[a], sizes[b]), tolerance);
    std::vector<DowelPattern> pairs;
    for (std::size_t c = classes.size(); c-- > 0;) {
        const std::size_t proposed = std::min<std::size_t>(classes[c].count, classes[c].pairs.size());
        for (std::size_t i = 0; i < proposed; ++i) {
            const auto [first, second] = classes[c].pairs[i];
            pairs.push_back({{a, sites[a][first]}, {b, sites[b][second]}});
        }
    }
    return pairs;
}

std::vector<DowelPattern> triples_of(std::span<const DowelSize> sizes, const SitesOfSizes& sites, std::size_t a,
                                     std::size_t c, double tolerance) {
    std::vector<DowelPattern> pairs = pairs_of(sizes, sites, a, a, tolerance);
    const std::size_t step = std::max<std::size_t>(1, pairs.size() / max_pairs_of_triples);
    const std::vector<Point2> thirds = some_of(sites[c], max_third_sites);
    std::vector<DowelPattern> triples;
    const double least = min_distance(sizes[a], sizes[c]);
    for (std::size_t i = 0; i < pairs.size() && triples.size() < max_triples; i += step) {
        for (const Point2& third : thirds) {
            DowelPattern triple = pairs[i];
            if (distance(triple[0].at, third) < least || distance(triple[1].at, third) < least) continue;
            triple.push_back({c, third});
            if (!can_be_turned(triple, tolerance)) triples.push_back(std::move(triple));
        }
    }
    return triples;
}

}  // namespace qchopper
