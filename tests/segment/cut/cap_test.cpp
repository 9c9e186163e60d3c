#include "segment/cut/cap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "segment/cut/ear_clipping.h"

namespace qchopper {
namespace {

struct Drawing {
    std::vector<Point2> points;
    std::vector<Loop> loops;
    void loop(const std::vector<Point2>& corners) {
        Loop l;
        for (const Point2& p : corners) {
            l.push_back(static_cast<std::uint32_t>(points.size()));
            points.push_back(p);
        }
        loops.push_back(l);
    }
    void circle(Point2 centre, double radius, int n) {  // negative radius: clockwise
        std::vector<Point2> corners;
        for (int i = 0; i < n; ++i) {
            const double phi = 2 * std::numbers::pi * i / n * (radius < 0 ? -1 : 1);
            corners.push_back(
                {centre.x + std::abs(radius) * std::cos(phi), centre.y + std::abs(radius) * std::sin(phi)});
        }
        loop(corners);
    }
};

// The caps of all loops, and the number of their regions.
std::pair<CapTriangles, std::size_t> caps_of(const Drawing& d) {
    const std::vector<Loop> loops = capped(d.loops);
    const std::vector<CapRegion> regions = nest_polygons(d.points, loops);
    return {triangulate_regions(d.points, loops, regions), regions.size()};
}

// Every loop edge belongs to one triangle, every other edge to two that run it in opposite directions.
void expect_closes(const Drawing& d, const std::vector<std::array<std::uint32_t, 3>>& triangles, const char* what) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_NE(t[k], t[(k + 1) % 3]) << what;
            ++uses[{t[k], t[(k + 1) % 3]}];
        }
    }
    for (const Loop& loop : d.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) --uses[{loop[i], loop[(i + 1) % loop.size()]}];
    }
    for (const auto& [edge, count] : uses) {
        const auto back = uses.find({edge.second, edge.first});
        ASSERT_EQ(count, back == uses.end() ? 0 : back->second) << what;
        ASSERT_LE(count, 1) << what;
    }
}

double covered(const Drawing& d, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    double area = 0;
    for (const auto& t : triangles) area += signed_area(d.points, {t[0], t[1], t[2]});
    return area;
}

double drawn(const Drawing& d) {
    double area = 0;
    for (const Loop& loop : d.loops) area += signed_area(d.points, loop);
    return area;
}

std::size_t expected_triangles(const Drawing& d, std::size_t regions) {
    return d.points.size() + 2 * d.loops.size() - 4 * regions;
}

TEST(Cap, RingsInRingsBecomeRegionsWithHoles) {
    Drawing d;
    d.circle({0, 0}, 50, 40);
    d.circle({10, 0}, -30, 25);
    d.circle({-38, 0}, -5, 8);
    d.circle({10, 0}, 20, 16);
    d.circle({10, 0}, -10, 9);
    d.circle({200, 0}, 10, 12);
    const auto [caps, regions] = caps_of(d);
    EXPECT_EQ(regions, 3U);
    EXPECT_EQ(caps.forced_regions, 0U);
    EXPECT_EQ(caps.triangles.size(), expected_triangles(d, 3));
    EXPECT_NEAR(covered(d, caps.triangles), drawn(d), 1e-9);
    expect_closes(d, caps.triangles, "rings");
}

TEST(Cap, EarsAgreeWithTheDelaunayTriangulationOnSimpleRegions) {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        Drawing d;
        std::vector<Point2> star;
        const int n = 5 + static_cast<int>(random() % 60);
        for (int i = 0; i < n; ++i) {
            const double phi = 2 * std::numbers::pi * i / n;
            const double r = 20 + static_cast<double>(random() % 1000) / 20;
            star.push_back({r * std::cos(phi), r * std::sin(phi)});
        }
        d.loop(star);
        const std::size_t holes = random() % 4;
        for (std::size_t i = 0; i < holes; ++i) {
            d.circle({-6 + 6 * static_cast<double>(i), static_cast<double>(random() % 7) - 3}, -2,
                     3 + static_cast<int>(random() % 6));
        }
        const auto ears = clip_ears(d.points, d.loops[0], std::span(d.loops).subspan(1));
        const auto [caps, regions] = caps_of(d);
        ASSERT_EQ(caps.forced_regions, 0U);
        ASSERT_EQ(ears.size(), caps.triangles.size());
        ASSERT_EQ(ears.size(), expected_triangles(d, 1));
        double absolute = 0;
        for (const auto& t : ears) absolute += std::abs(signed_area(d.points, {t[0], t[1], t[2]}));
        ASSERT_NEAR(absolute, drawn(d), 1e-9);  // nothing overlaps
        expect_closes(d, ears, "ears");
    }
}

TEST(Cap, LoopsThatCrossThemselvesOrEachOtherStillClose) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        Drawing d;
        const int loops = 1 + static_cast<int>(random() % 3);
        for (int l = 0; l < loops; ++l) {
            std::vector<Point2> scribble;
            const int n = 3 + static_cast<int>(random() % 30);
            for (int i = 0; i < n; ++i) {
                scribble.push_back({static_cast<double>(random() % 100), static_cast<double>(random() % 100)});
            }
            d.loop(scribble);
        }
        const auto [caps, regions] = caps_of(d);
        ASSERT_EQ(caps.triangles.size(), expected_triangles(d, regions));
        ASSERT_NEAR(covered(d, caps.triangles), drawn(d), 1e-6);
        expect_closes(d, caps.triangles, "scribble");
    }
}

TEST(Cap, APointOnAnotherLoopsEdgeAndPointsInOnePlaceStillClose) {
    Drawing d;
    d.loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
    d.loop({{5, 0}, {4, 4}, {6, 4}});  // touches the outer edge from inside: collinear, clockwise
    d.loop({{20, 0}, {30, 0}, {30, 0}, {30, 10}, {20, 10}});
    const auto [caps, regions] = caps_of(d);
    EXPECT_EQ(regions, 2U);
    EXPECT_EQ(caps.triangles.size(), expected_triangles(d, 2));
    EXPECT_NEAR(covered(d, caps.triangles), drawn(d), 1e-9);
    expect_closes(d, caps.triangles, "touching");
}

}  // namespace
}  // namespace qchopper
