#include "segment/cut/nest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

struct Rectangle {
    Point2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Point2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    bool contains(Point2 p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; }
};

Rectangle rectangle(std::span<const Point2> points, const Loop& loop) {
    Rectangle r;
    for (const std::uint32_t p : loop) {
        r.min = {std::min(r.min.x, points[p].x), std::min(r.min.y, points[p].y)};
        r.max = {std::max(r.max.x, points[p].x), std::max(r.max.y, points[p].y)};
    }
    return r;
}

bool is_inside(std::span<const Point2> points, const Loop& loop, Point2 p) {
    bool inside = false;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const Point2 a = points[loop[i]];
        const Point2 b = points[loop[j]];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
    return inside;
}

}  // namespace

double signed_area(std::span<const Point2> points, const Loop& loop) {
    double twice = 0;
    const Point2 o = points[loop.front()];
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point2 a = points[loop[i]];
        const Point2 b = points[loop[(i + 1) % loop.size()]];
        twice += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
    }
    return twice / 2;
}

std::vector<CapRegion> nest(std::span<const Point2> points, std::span<const Loop> loops) {
    const std::size_t count = loops.size();
    std::vector<Rectangle> box(count);
    std::vector<double> area(count);
    for (std::size_t i = 0; i < count; ++i) {
        box[i] = rectangle(points, loops[i]);
        area[i] = signed_area(points, loops[i]);
    }
    std::vector<std::vector<std::size_t>> around(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Point2 p = points[loops[i].front()];
        for (std::size_t j = 0; j < count; ++j) {
            if (j != i && box[j].contains(p) && is_inside(points, loops[j], p)) around[i].push_back(j);
        }
    }
    std::vector<CapRegion> regions;
    std::vector<std::size_t> region_of(count, count);
    for (std::size_t i = 0; i < count; ++i) {
        if (around[i].size() % 2 != 0) continue;
        region_of[i] = regions.size();
        regions.push_back({i, {}, area[i] >= 0});
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (around[i].size() % 2 == 0) continue;
        std::size_t outer = count;
        for (const std::size_t j : around[i]) {
            const bool is_outer = region_of[j] != count;
            if (is_outer && (outer == count || std::abs(area[j]) < std::abs(area[outer]))) outer = j;
        }
        if (outer == count) {  // loops that cross each other can be inside holes only: then it stands alone
            regions.push_back({i, {}, false});
            continue;
        }
        CapRegion& region = regions[region_of[outer]];
        region.holes.push_back(i);
        if (area[i] > 0) region.is_simple = false;
    }
    return regions;
}

}  // namespace qchopper
