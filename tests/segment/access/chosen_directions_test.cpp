#include "segment/access/chosen_directions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "segment/import/import_scan.h"
#include "segment/sample/sample.h"
#include "tests/real_scans.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

struct Case {
    const JudgedPiece& piece;
    TiltBase base;
    std::vector<std::uint32_t> possible;
    std::vector<Vec3> dense;
};

ChosenDirections choose(const Case& c, const DirectionOptions& options = {}) {
    return choose_directions(c.piece, c.base, c.possible, c.dense, options);
}

bool is_open_along(const Case& c, std::size_t row, Vec3 d) {
    const std::size_t k = index_of(c.piece.scan.directions, d);
    if (k < c.piece.scan.directions.size()) return c.piece.accessibility.is_open(row, k);
    return std::isinf(PieceRays(c.piece.scan, c.piece.accessibility).distance(row, d));
}

// The slow reference: one flag per row, then per cap but the base, and what they weigh.
struct Coverage {
    std::vector<bool> is_covered;
    void add(const Coverage& other) {
        for (std::size_t i = 0; i < is_covered.size(); ++i) {
            if (other.is_covered[i]) is_covered[i] = true;
        }
    }
};

Coverage covered_by(const Case& c, Vec3 d) {
    Coverage result;
    for (std::size_t row = 0; row < c.piece.accessibility.sample.size(); ++row) {
        result.is_covered.push_back(is_open_along(c, row, d));
    }
    for (const OwnedCap& cap : c.piece.caps) {
        result.is_covered.push_back(cap.cut != c.base.cut && dot(cap.outward, d) >= 0.05);
    }
    return result;
}

double area_of(const Case& c, const Coverage& coverage) {
    const std::size_t rows = c.piece.accessibility.sample.size();
    std::size_t count = 0;
    double caps = 0;
    for (std::size_t i = 0; i < coverage.is_covered.size(); ++i) {
        if (!coverage.is_covered[i]) continue;
        count += i < rows ? 1 : 0;
        caps += i < rows ? 0 : c.piece.caps[i - rows].area_mm2;
    }
    return c.piece.scan.samples.area_each_mm2 * static_cast<double>(count) + caps;
}

Coverage united(const std::vector<Coverage>& all, const std::vector<std::size_t>& which) {
    Coverage result{std::vector<bool>(all[0].is_covered.size())};
    for (const std::size_t i : which) result.add(all[i]);
    return result;
}

UnreachableArea unreachable_by(const Case& c, const std::vector<Vec3>& directions, const std::vector<Vec3>& asked) {
    Coverage all = covered_by(c, directions[0]);
    for (const Vec3& d : directions) all.add(covered_by(c, d));
    for (const Vec3& d : asked) all.add(covered_by(c, d));
    const auto is_steep = [&](Vec3 normal) {
        return std::any_of(directions.begin(), directions.end(),
                           [&](const Vec3& d) { return std::abs(dot(normal, d)) < 0.05; });
    };
    UnreachableArea area;
    const std::size_t rows = c.piece.accessibility.sample.size();
    for (std::size_t row = 0; row < rows; ++row) {
        if (all.is_covered[row]) continue;
        (is_steep(c.piece.sample(row).normal) ? area.steep_mm2 : area.hidden_mm2) += c.piece.scan.samples.area_each_mm2;
    }
    for (std::size_t k = 0; k < c.piece.caps.size(); ++k) {
        const OwnedCap& cap = c.piece.caps[k];
        if (cap.cut == c.base.cut || all.is_covered[rows + k]) continue;
        (is_steep(cap.outward) ? area.steep_mm2 : area.caps_mm2) += cap.area_mm2;
    }
    return area;
}

void expect_near(const UnreachableArea& a, const UnreachableArea& b, const std::string& what) {
    const double rounding = 1e-9 * (1 + a.total_mm2(90) + b.total_mm2(90));
    EXPECT_NEAR(a.hidden_mm2, b.hidden_mm2, rounding) << what;
    EXPECT_NEAR(a.steep_mm2, b.steep_mm2, rounding) << what;
    EXPECT_NEAR(a.caps_mm2, b.caps_mm2, rounding) << what;
}

std::vector<Vec3> directions_of(const ChosenDirections& c) {
    std::vector<Vec3> all;
    for (const ChosenDirection& d : c.chosen) all.push_back(d.direction);
    return all;
}

// What holds for every answer, from the rows one by one.
void expect_consistent(const Case& c, const DirectionOptions& options, const ChosenDirections& result,
                       const std::string& what) {
    const std::vector<Vec3> chosen = directions_of(result);
    ASSERT_FALSE(chosen.empty());
    EXPECT_EQ(chosen[0], c.base.up) << what;
    EXPECT_LE(chosen.size(), options.max_directions) << what;
    const double area = c.piece.surface_mm2(c.base);
    Coverage before{std::vector<bool>(covered_by(c, c.base.up).is_covered.size())};
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (i > 0) {
            const std::size_t k = index_of(c.piece.scan.directions, chosen[i]);
            EXPECT_TRUE(std::binary_search(c.possible.begin(), c.possible.end(), k)) << what;
            EXPECT_GT(result.chosen[i].gained_mm2, 0) << what;
        }
        if (i > 1) {
            EXPECT_LE(result.chosen[i].gained_mm2, result.chosen[i - 1].gained_mm2 + 1e-9 * area) << what;
        }
        Coverage now = before;
        now.add(covered_by(c, chosen[i]));
        EXPECT_NEAR(result.chosen[i].gained_mm2, area_of(c, now) - area_of(c, before), 1e-9 * area) << what;
        before = now;
    }
    EXPECT_NEAR(area - area_of(c, before), result.by_chosen.total_mm2(90), 1e-9 * area) << what;
    expect_near(result.by_chosen, unreachable_by(c, chosen, {}), what);
    ASSERT_EQ(result.samples.size(), c.piece.accessibility.sample.size()) << what;
    for (std::size_t row = 0; row < result.samples.size(); ++row) {
        const auto is_parallel = [&](Vec3 d) { return std::abs(dot(c.piece.sample(row).normal, d)) < 0.05; };
        const SampleAccess expected = before.is_covered[row]                                   ? SampleAccess::reached
                                      : std::any_of(chosen.begin(), chosen.end(), is_parallel) ? SampleAccess::steep
                                                                                               : SampleAccess::hidden;
        EXPECT_EQ(result.samples[row], expected) << what;
    }
    EXPECT_LE(result.by_all.total_mm2(90), result.by_chosen.total_mm2(90) + 1e-9 * area) << what;
}

// Calls check for every shape cut twice, every base of its pieces, and several tilts.
template <class Check>
void for_each_case(std::size_t samples, std::size_t dense, const Check& check) {
    std::mt19937 random(41);
    const std::vector<Vec3> all_dense = dense == 0 ? std::vector<Vec3>() : dense_directions(dense);
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const SampledScan scan = sampled(mesh, samples);
        std::vector<TrackedPiece> pieces = uncut_pieces(scan);
        cut_at(scan, pieces, 0, random_normal(random), 0.4, 1);
        cut_at(scan, pieces, pieces.size() - 1, random_normal(random), 0.6, 2);
        for (const TrackedPiece& piece : pieces) {
            const std::vector<OwnedCap> caps = owned_caps(piece.piece);
            const JudgedPiece judged{scan, piece.accessibility, caps};
            for (const OwnedCap& cap : caps) {
                for (const double tilt : {0.0, 30.0, 60.0, 90.0}) {
                    const TiltBase base = lying_on(cap);
                    std::vector<Vec3> further;
                    for (const std::uint32_t k : allowed_directions(all_dense, base.up, tilt)) {
                        further.push_back(all_dense[k]);
                    }
                    check(Case{judged, base, allowed_directions(scan.directions, base.up, tilt), further}, tilt,
                          name + ", tilt " + std::to_string(tilt));
                }
            }
        }
    }
}

TEST(ChosenDirections, EqualARecountRowByRow) {
    std::size_t cases = 0;
    std::size_t with_several = 0;
    for_each_case(300, 0, [&](const Case& c, double tilt, const std::string& what) {
        const ChosenDirections result = choose(c);
        expect_consistent(c, {}, result, what);
        EXPECT_FALSE(result.further.has_value());
        std::vector<Vec3> all{c.base.up};
        for (const std::uint32_t k : c.possible) all.push_back(c.piece.scan.directions[k]);
        expect_near(result.by_all, unreachable_by(c, all, {}), what);
        // That of the search counts no cap as steep.
        EXPECT_EQ(result.by_all.hidden_mm2, unreachable_area(c.piece, c.base, tilt).hidden_mm2) << what;
        ++cases;
        with_several += result.chosen.size() > 2 ? 1 : 0;
    });
    EXPECT_GT(cases, 50U);
    EXPECT_GT(with_several, 20U);
}

TEST(ChosenDirections, MoreOfThemNeverLeaveMore) {
    for_each_case(300, 0, [&](const Case& c, double, const std::string& what) {
        double before = std::numeric_limits<double>::infinity();
        for (std::size_t most = 1; most <= 9; ++most) {
            const ChosenDirections result = choose(c, {most, 0});
            const double now = result.by_chosen.total_mm2(90);
            EXPECT_LE(now, before + 1e-9) << what << " " << most;
            EXPECT_LE(result.chosen.size(), most) << what;
            before = now;
        }
        const ChosenDirections all = choose(c, {1'000, 0});
        EXPECT_NEAR(all.by_chosen.total_mm2(90), all.by_all.total_mm2(90), 1e-9) << what;
        EXPECT_EQ(choose(c, {1, 0}).chosen.size(), 1U) << what;
        EXPECT_EQ(choose(c, {8, 1.01}).chosen.size(), 1U) << what;
    });
}

TEST(ChosenDirections, DenseDirectionsAreAskedWhereTheChosenDoNotReach) {
    std::size_t with_further = 0;
    for_each_case(100, 60, [&](const Case& c, double tilt, const std::string& what) {
        for (const std::size_t most : {1U, 3U}) {
            const DirectionOptions options{most, 0.005};
            const ChosenDirections result = choose(c, options);
            expect_consistent(c, options, result, what);
            std::vector<Vec3> all{c.base.up};
            for (const std::uint32_t k : c.possible) all.push_back(c.piece.scan.directions[k]);
            expect_near(result.by_all, unreachable_by(c, all, c.dense), what);
            const UnreachableArea judged = unreachable_area(c.piece, c.base, tilt, c.dense);
            EXPECT_NEAR(result.by_all.hidden_mm2, judged.hidden_mm2, 1e-9) << what;
            EXPECT_GE(result.by_all.steep_mm2, judged.steep_mm2 - 1e-9) << what;
            EXPECT_LE(result.by_all.caps_mm2, judged.caps_mm2) << what;  // dense directions may face a cap

            Coverage chosen = covered_by(c, c.base.up);
            for (const Vec3& d : directions_of(result)) chosen.add(covered_by(c, d));
            double best = 0;
            Vec3 best_direction;
            for (const Vec3& d : c.dense) {
                Coverage with = chosen;
                with.add(covered_by(c, d));
                const double gain = area_of(c, with) - area_of(c, chosen);
                if (gain > best + 1e-9) {
                    best = gain;
                    best_direction = d;
                }
            }
            const bool is_worth_it = best > 0 && best >= 0.005 * c.piece.surface_mm2(c.base);
            ASSERT_EQ(result.further.has_value(), is_worth_it) << what;
            if (!is_worth_it) continue;
            ++with_further;
            EXPECT_NEAR(result.further->gained_mm2, best, 1e-6) << what;
            EXPECT_EQ(result.further->direction, best_direction) << what;
            EXPECT_LE(result.by_all.total_mm2(90), result.by_chosen.total_mm2(90) - result.further->gained_mm2 + 1e-6)
                << what;
        }
    });
    EXPECT_GT(with_further, 30U);
}

// A table of random openness, without a piece that would have it: directions 0 to directions-1, of which 0 is up.
struct RandomTable {
    RandomTable(std::size_t directions, std::size_t rows, std::mt19937& random)
        : scan(sampled(shapes::box({0, 0, 0}, {10, 10, 10}), rows)) {
        scan.directions = dense_directions(directions);
        accessibility.sample.resize(rows);
        std::iota(accessibility.sample.begin(), accessibility.sample.end(), 0U);
        for (std::size_t i = 0; i < rows * directions; ++i) {
            const bool is_open = random() % 4 == 0;
            accessibility.distance.push_back(is_open ? std::numeric_limits<float>::infinity() : 0.0F);
        }
    }
    void open(std::size_t direction, std::initializer_list<std::size_t> rows) {
        const std::size_t directions = scan.directions.size();
        for (std::size_t row = 0; row < accessibility.sample.size(); ++row) {
            const bool is_open = std::find(rows.begin(), rows.end(), row) != rows.end();
            accessibility.distance[row * directions + direction] =
                is_open ? std::numeric_limits<float>::infinity() : 0.0F;
        }
    }
    Case of(const JudgedPiece& judged) const {
        std::vector<std::uint32_t> possible(scan.directions.size());
        std::iota(possible.begin(), possible.end(), 0U);
        return {judged, {scan.directions[0], std::nullopt}, possible, {}};
    }
    SampledScan scan;
    PieceAccessibility accessibility;
};

// The same method on flags: the best addition, then every exchange that is better than all others, in turn.
std::vector<std::size_t> chosen_plainly(const Case& c, const std::vector<Coverage>& all, std::size_t most) {
    std::vector<std::size_t> chosen{0};
    const auto best_with = [&](std::vector<std::size_t> others) {
        others.push_back(0);
        std::pair<double, std::size_t> best{area_of(c, united(all, others)), all.size()};
        for (std::size_t d = 1; d < all.size(); ++d) {
            others.back() = d;
            const double area = area_of(c, united(all, others));
            if (area > best.first) best = {area, d};
        }
        return best;
    };
    while (chosen.size() < most) {
        const std::size_t next = best_with(chosen).second;
        if (next == all.size()) break;
        chosen.push_back(next);
        for (std::size_t i = 1; i < chosen.size(); ++i) {
            std::vector<std::size_t> others = chosen;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
            const auto [area, d] = best_with(others);
            if (area > area_of(c, united(all, chosen))) chosen[i] = d;
        }
    }
    return chosen;
}

TEST(ChosenDirections, EqualThePlainMethodAndComeNearTheBestSetThatThereIs) {
    std::mt19937 random(42);
    double sum = 0;
    double sum_of_best = 0;
    for (int round = 0; round < 100; ++round) {
        const RandomTable table(7, 70, random);
        const JudgedPiece judged{table.scan, table.accessibility, {}};
        const Case c = table.of(judged);
        std::vector<Coverage> all;
        for (const Vec3& d : table.scan.directions) all.push_back(covered_by(c, d));
        const ChosenDirections result = choose(c, {3, 0});
        std::vector<std::size_t> expected = chosen_plainly(c, all, 3);
        std::vector<std::size_t> found;
        for (const Vec3& d : directions_of(result)) found.push_back(index_of(table.scan.directions, d));
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << round;
        double best = 0;
        for (std::size_t a = 1; a < 7; ++a) {
            for (std::size_t b = a + 1; b < 7; ++b) best = std::max(best, area_of(c, united(all, {0, a, b})));
        }
        const double area = area_of(c, united(all, found));
        EXPECT_LE(area, best + 1e-9);
        EXPECT_GE(area, 0.9 * best);
        sum += area;
        sum_of_best += best;
    }
    EXPECT_GE(sum, 0.99 * sum_of_best);
}

TEST(ChosenDirections, AnExchangeMakesGoodWhatGreedyChoiceMisses) {
    std::mt19937 random(43);
    RandomTable table(4, 6, random);
    table.open(0, {});
    table.open(1, {0, 1, 2, 3});  // the most at once, but the other two reach all
    table.open(2, {0, 1, 4});
    table.open(3, {2, 3, 5});
    const JudgedPiece judged{table.scan, table.accessibility, {}};
    const ChosenDirections result = choose(table.of(judged), {3, 0});
    EXPECT_EQ(directions_of(result),
              (std::vector<Vec3>{table.scan.directions[0], table.scan.directions[2], table.scan.directions[3]}));
    EXPECT_EQ(result.by_chosen.total_mm2(90), 0);
    EXPECT_NEAR(result.chosen[1].gained_mm2, 300, 1e-9);
    EXPECT_NEAR(result.chosen[2].gained_mm2, 300, 1e-9);
}

TEST(ChosenDirections, OfEqualOnesTheFirstIsTaken) {
    std::mt19937 random(44);
    RandomTable table(4, 6, random);
    table.open(0, {0});
    for (const std::size_t d : {1U, 2U, 3U}) table.open(d, {1, 2});
    const JudgedPiece judged{table.scan, table.accessibility, {}};
    const ChosenDirections result = choose(table.of(judged), {4, 0});
    EXPECT_EQ(directions_of(result), (std::vector<Vec3>{table.scan.directions[0], table.scan.directions[1]}));
}

TEST(ChosenDirections, UpAloneIsChosenWithoutPossibleOnes) {
    const Vec3 up = normalized({0.2, 0.1, 1});
    const TriangleMesh mesh =
        shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}), cross({0, 0, 1}, up), std::acos(up.z));
    SampledScan scan = sampled(mesh, 3'000);
    scan.directions = tool_directions(world);
    ASSERT_EQ(index_of(scan.directions, up), scan.directions.size());  // rays are cast for it
    const TrackedPiece piece = uncut_pieces(scan)[0];
    const JudgedPiece judged{scan, piece.accessibility, {}};
    const Case c{judged, {up, std::nullopt}, {}, {}};
    const ChosenDirections result = choose(c);
    expect_consistent(c, {}, result, "box");
    ASSERT_EQ(result.chosen.size(), 1U);
    EXPECT_NEAR(result.chosen[0].gained_mm2, 1'600, 60);
    EXPECT_NEAR(result.by_chosen.hidden_mm2, 1'600, 60);
    EXPECT_NEAR(result.by_chosen.steep_mm2, 4 * 1'600, 60);
    expect_near(result.by_all, result.by_chosen, "box");
    const ChosenDirections tilted = choose({judged, c.base, allowed_directions(scan.directions, up, 60), {}});
    EXPECT_NEAR(tilted.by_chosen.total_mm2(60), 1'600, 60);
}

// The cap beside the base stands upright on it.
TEST(ChosenDirections, AnUprightCapIsSteepUntilADirectionFacesIt) {
    const SampledScan scan = sampled(shapes::box({0, 0, 0}, {40, 40, 40}), 1'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    cut_at(scan, pieces, 0, {1, 0, 0}, 0.5, 1);
    cut_at(scan, pieces, 0, {0, 0, 1}, 0.5, 2);
    for (const TrackedPiece& piece : pieces) {
        const std::vector<OwnedCap> caps = owned_caps(piece.piece);
        if (caps.size() < 2) continue;
        const JudgedPiece judged{scan, piece.accessibility, caps};
        const TiltBase base = lying_on(caps[0]);
        const Case c{judged, base, allowed_directions(scan.directions, base.up, 60), {}};
        const double steep_samples =
            static_cast<double>(piece.accessibility.sample.size()) * scan.samples.area_each_mm2;
        const UnreachableArea upright = choose(c, {1, 0}).by_chosen;
        EXPECT_EQ(upright.caps_mm2, 0);
        EXPECT_GT(upright.steep_mm2, caps[1].area_mm2);
        EXPECT_LT(upright.steep_mm2, caps[1].area_mm2 + steep_samples);
        EXPECT_NEAR(choose(c).by_chosen.total_mm2(60), 0, 1e-9);
    }
}

TEST(ChosenDirections, ACapIsReachedOnceSomeDirectionFacesIt) {
    const SampledScan scan = sampled(shapes::box({0, 0, 0}, {40, 40, 40}), 1'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    cut_at(scan, pieces, 0, canonical({normalized({1, 0, -0.2}), 0}).normal, 0.5, 1);
    cut_at(scan, pieces, 0, {0, 0, 1}, 0.5, 2);
    std::size_t overhanging = 0;
    for (const TrackedPiece& piece : pieces) {
        const std::vector<OwnedCap> caps = owned_caps(piece.piece);
        const JudgedPiece judged{scan, piece.accessibility, caps};
        for (const OwnedCap& cap : caps) {
            const TiltBase base = lying_on(cap);
            const Case c{judged, base, allowed_directions(scan.directions, base.up, 60), {}};
            double others = 0;
            for (const OwnedCap& other : caps) {
                if (other.cut != cap.cut && dot(other.outward, base.up) < 0) others += other.area_mm2;
            }
            EXPECT_NEAR(choose(c, {1, 0}).by_chosen.caps_mm2, others, 1e-9);
            EXPECT_EQ(choose(c).by_chosen.caps_mm2, 0);
            overhanging += others > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(overhanging, 0U);
}

auto bytes_of(const ChosenDirections& c) {
    std::vector<double> numbers;
    const auto add = [&](const ChosenDirection& d) {
        for (const double v : {d.direction.x, d.direction.y, d.direction.z, d.gained_mm2}) numbers.push_back(v);
    };
    for (const ChosenDirection& d : c.chosen) add(d);
    if (c.further) add(*c.further);
    for (const UnreachableArea& a : {c.by_chosen, c.by_all}) {
        for (const double v : {a.hidden_mm2, a.steep_mm2, a.caps_mm2}) numbers.push_back(v);
    }
    return std::tuple(c.chosen.size(), c.further.has_value(), c.samples, numbers);
}

TEST(ChosenDirections, AreTheSameForAnyNumberOfThreads) {
    SampleOptions sample_options;
    sample_options.faces = 20'000;
    const SampledScan scan = sampled(sample(Specimen::vertebra, sample_options), 1'000);
    const TrackedPiece piece = uncut_pieces(scan)[0];
    const JudgedPiece judged{scan, piece.accessibility, {}};
    const Vec3 up{0, 0, 1};
    const std::vector<Vec3> dense = dense_directions(100);
    const Case c{judged, {up, std::nullopt}, allowed_directions(scan.directions, up, 60), dense};
    const auto expected = bytes_of(choose(c));
    EXPECT_GT(std::get<0>(expected), 2U);
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(bytes_of(choose(c)), expected) << threads;
    }
}

TEST(ChosenDirections, EqualARecountOnRealScans) {
    if (!std::filesystem::exists(QCHOPPER_MESHES)) GTEST_SKIP() << "skipped: the real meshes are not here";
    std::size_t taken = 0;
    for (const RealScan& real : valid_scans(QCHOPPER_MESHES, 30'000)) {
        ImportOptions options;
        options.mm_per_unit = 1;
        const TriangleMesh mesh = import_scan(std::filesystem::path(QCHOPPER_MESHES) / real.file, options).mesh;
        const SampledScan scan = sampled(mesh, 500);
        for (const TrackedPiece& piece : uncut_pieces(scan)) {
            if (piece.accessibility.sample.size() < 100) continue;
            const JudgedPiece judged{scan, piece.accessibility, {}};
            const Vec3 up = scan.directions[0];
            const Case c{judged, {up, std::nullopt}, allowed_directions(scan.directions, up, 60), {}};
            expect_consistent(c, {}, choose(c), real.file);
            ++taken;
        }
    }
    EXPECT_GT(taken, 0U);
}

}  // namespace
}  // namespace qchopper
