#include "segment/access/access_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "segment/access/piece_access.h"
#include "segment/import/import_scan.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/real_scans.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::array<double, 5> tilts{0, 30, 60, 85, 90};

// Whether a sample of a side counts as unreachable.
bool is_blocked(Vec3 normal, std::span<const Vec3> allowed, double tilt, const auto& is_open) {
    if (std::any_of(allowed.begin(), allowed.end(), is_open)) return false;
    const auto is_steep = [&](Vec3 d) { return std::abs(dot(normal, d)) < 0.05; };
    return tilt >= 15 || std::none_of(allowed.begin(), allowed.end(), is_steep);
}

// Up first.
std::vector<Vec3> allowed_with_up(const SampledScan& scan, Vec3 up, double tilt) {
    std::vector<Vec3> allowed{up};
    for (const Vec3& d : scan.directions) {
        if (is_allowed(d, up, tilt)) allowed.push_back(d);
    }
    return allowed;
}

// A piece, and what one plane makes of it.
struct CutPiece {
    TrackedPiece parent;
    Plane plane;
    std::int32_t number = 0;
    std::vector<TrackedPiece> made;
};

// A random plane through a random piece; nothing where it misses.
std::optional<CutPiece> random_cut(const SampledScan& scan, const std::vector<TrackedPiece>& pieces,
                                   std::int32_t number, std::mt19937& random) {
    CutPiece cut;
    cut.parent = pieces[random() % pieces.size()];
    cut.number = number;
    cut.plane.normal = random() % 2 == 0 ? random_normal(random)
                                         : canonical({scan.directions[random() % scan.directions.size()], 0}).normal;
    const Extent range = extent(*cut.parent.piece.mesh, cut.plane.normal);
    const double share = std::uniform_real_distribution<double>(0.1, 0.9)(random);
    const auto nudged = nudge(cut.parent.piece, cut.plane.normal, std::array{range.low + share * range.size()});
    if (!nudged[0]) return std::nullopt;
    cut.plane.offset = nudged[0]->offset;
    cut.made = {cut.parent};
    if (cut_along(scan, cut.made, 0, cut.plane, number) == 0) return std::nullopt;
    return cut;
}

// Whether a ray of a sample of the parent, or the sample, ends within the flush tolerance of the plane.
bool is_flush(const SampledScan& scan, const CutPiece& cut, std::size_t row) {
    const auto at = [&](Vec3 p) { return height(cut.plane.normal, p) - cut.plane.offset; };
    const double near = 6e-6 * scan.diagonal_mm;
    const double above = at(scan.samples.sample[cut.parent.accessibility.sample[row]].point);
    if (std::abs(above) < near) return true;
    for (std::size_t k = 0; k < scan.directions.size(); ++k) {
        const double distance = cut.parent.accessibility.distances(row)[k];
        const double slope = dot(cut.plane.normal, scan.directions[k]);
        if (!std::isinf(distance) && distance > 0 && std::abs(above + distance * slope) < near) return true;
    }
    return false;
}

const SideOnBase* on_base(std::span<const SideOnBase> sides, std::int32_t cut) {
    const auto found = std::find_if(sides.begin(), sides.end(), [&](const SideOnBase& s) { return s.cut == cut; });
    return found == sides.end() ? nullptr : &*found;
}

std::span<const SideOnBase> side(const PlaneAccess& access, bool above) {
    return above ? access.above : access.below;
}

PlaneAccess swept(const SampledScan& scan, const TrackedPiece& piece, const Plane& plane, double tilt) {
    const std::vector<OwnedCap> caps = owned_caps(piece.piece);
    const JudgedPiece judged{scan, piece.accessibility, caps};
    // Two further offsets: one plane of many gives the same as alone.
    const AccessSweep sweep(piece.piece, judged, tilt);
    const double apart = 0.07 * scan.diagonal_mm;
    return sweep.sweep(plane.normal, std::array{plane.offset - apart, plane.offset, plane.offset + apart})[1];
}

// The caps of a piece with the area of one of them.
std::vector<OwnedCap> with_area(std::vector<OwnedCap> caps, std::int32_t cut, double area) {
    for (OwnedCap& cap : caps) {
        if (cap.cut == cut) cap.area_mm2 = area;
    }
    return caps;
}

struct Comparison {
    std::size_t states = 0;
    std::size_t flush = 0;         // unequal, and a ray or the sample within the flush tolerance of the plane
    std::size_t wrong = 0;         // unequal besides
    std::size_t wrongly_open = 0;  // of those; also where a side is several solids
    std::size_t blocked = 0;
};

std::ostream& operator<<(std::ostream& out, const Comparison& c) {
    return out << c.states << " states, " << c.blocked << " blocked; unequal: " << c.flush << " flush, " << c.wrong
               << " others; " << c.wrongly_open << " wrongly open";
}

// The accessibility of a piece, to be filled in for single samples.
PieceAccessibility without_samples(const PieceAccessibility& piece) {
    return {piece.solid, piece.half_spaces, piece.scan_triangle, {}, {}};
}

// Per row of the parent whether it is unreachable on each base of its side, by a sweep of this sample alone.
void compare_samples(const SampledScan& scan, const CutPiece& cut, double tilt, Comparison& result) {
    const std::vector<OwnedCap> parent_caps = owned_caps(cut.parent.piece);
    TriangleMesh caps_alone;
    caps_alone.points = cut.parent.piece.mesh->points;
    for (std::size_t t = 0; t < cut.parent.piece.mesh->triangles.size(); ++t) {
        if (cap_of(*cut.parent.piece.mesh, t) == no_cap) continue;
        caps_alone.triangles.push_back(cut.parent.piece.mesh->triangles[t]);
        caps_alone.cap_of.push_back(cap_of(*cut.parent.piece.mesh, t));
    }
    const Piece flat = piece_of(std::move(caps_alone));
    PieceAccessibility one = without_samples(cut.parent.accessibility);
    const PlaneAccess all = swept(scan, cut.parent, cut.plane, tilt);
    const double each = scan.samples.area_each_mm2;
    std::vector<double> sums(2 * (parent_caps.size() + 1));  // of single samples, per side and base
    for (const TrackedPiece& made : cut.made) {
        const bool above = made.piece.half_spaces.back().above;
        const CutPieceReference reference(scan, made);
        const PieceRays rays(scan, made.accessibility);
        const std::vector<OwnedCap> caps = owned_caps(made.piece);
        for (std::size_t row = 0; row < made.accessibility.sample.size(); ++row) {
            const auto& of_parent = cut.parent.accessibility.sample;
            const auto parent_row = static_cast<std::size_t>(
                std::lower_bound(of_parent.begin(), of_parent.end(), made.accessibility.sample[row]) -
                of_parent.begin());
            one.sample = {made.accessibility.sample[row]};
            const std::span<const float> distances = cut.parent.accessibility.distances(parent_row);
            one.distance.assign(distances.begin(), distances.end());
            const PlaneAccess access = AccessSweep(flat, {scan, one, parent_caps}, tilt)
                                           .sweep(cut.plane.normal, std::array{cut.plane.offset})[0];
            const Vec3 normal = scan.samples.sample[made.accessibility.sample[row]].normal;
            for (const OwnedCap& cap : caps) {
                const std::int32_t base = cap.cut == cut.number ? new_cut : cap.cut;
                const SideOnBase* fast = on_base(side(access, above), base);
                ASSERT_NE(fast, nullptr);
                const bool is_swept = fast->unreachable_mm2 - fast->caps_mm2 > each / 2;
                const std::vector<Vec3> allowed = allowed_with_up(scan, -cap.outward, tilt);
                const auto is_open = [&](Vec3 d) {
                    return reference.is_open(row, d, std::isinf(rays.distance(row, d)));
                };
                const bool expected = is_blocked(normal, allowed, tilt, is_open);
                ++result.states;
                result.blocked += expected ? 1 : 0;
                if (is_swept == expected) continue;
                const bool excused = is_flush(scan, cut, parent_row);
                if (excused && cut.made.size() == 2) ++result.flush;
                if (!excused && cut.made.size() == 2) ++result.wrong;
                if (!excused && !is_swept) ++result.wrongly_open;
            }
            for (const bool is_above : {true, false}) {
                for (std::size_t b = 0; b <= parent_caps.size(); ++b) {
                    const SideOnBase* fast = on_base(side(access, is_above), b == 0 ? new_cut : parent_caps[b - 1].cut);
                    if (fast != nullptr) sums[2 * b + (is_above ? 1 : 0)] += fast->unreachable_mm2 - fast->caps_mm2;
                }
            }
        }
    }
    for (const bool above : {true, false}) {
        for (std::size_t b = 0; b <= parent_caps.size(); ++b) {
            const SideOnBase* whole = on_base(side(all, above), b == 0 ? new_cut : parent_caps[b - 1].cut);
            if (whole == nullptr) continue;
            EXPECT_NEAR((whole->unreachable_mm2 - whole->caps_mm2) / each, sums[2 * b + (above ? 1 : 0)] / each, 1e-6);
        }
    }
}

// Both sides, where each is one solid, beside the pieces that were really cut.
void compare_sides(const SampledScan& scan, const CutPiece& cut, double tilt, Comparison& result) {
    ASSERT_EQ(cut.made.size(), 2U);
    const PlaneAccess access = swept(scan, cut.parent, cut.plane, tilt);
    // Counted where it is asked for: most planes have no such sample.
    const auto flush = [&] {
        std::size_t count = 0;
        for (std::size_t row = 0; row < cut.parent.accessibility.sample.size(); ++row) {
            count += is_flush(scan, cut, row) ? 1 : 0;
        }
        return static_cast<double>(count);
    };
    const double each = scan.samples.area_each_mm2;
    const double size = scan.diagonal_mm * scan.diagonal_mm;
    for (const TrackedPiece& made : cut.made) {
        const std::span<const SideOnBase> sides = side(access, made.piece.half_spaces.back().above);
        ASSERT_FALSE(sides.empty());
        EXPECT_EQ(sides.front().cut, new_cut);
        const std::vector<OwnedCap> caps =
            with_area(owned_caps(made.piece), cut.number, std::max(1e-300, sides.front().base_mm2));
        const JudgedPiece judged{scan, made.accessibility, caps};
        for (const OwnedCap& cap : caps) {
            const SideOnBase* fast = on_base(sides, cap.cut == cut.number ? new_cut : cap.cut);
            ASSERT_NE(fast, nullptr);
            EXPECT_NEAR(fast->base_mm2, cap.area_mm2, 1e-9 * size);
            const TiltBase base = lying_on(cap);
            const UnreachableArea slow = unreachable_area(judged, base, tilt);
            EXPECT_NEAR(fast->caps_mm2, slow.caps_mm2, 1e-9 * size);
            const double expected = slow.total_mm2(tilt) - slow.caps_mm2;
            const double samples = (fast->unreachable_mm2 - fast->caps_mm2 - expected) / each;
            if (std::abs(samples) > 1e-6) {
                EXPECT_LE(std::abs(samples), flush() + 1e-6);
            }
            const double projected = (fast->projected_mm2 - projected_area_mm2(judged, base.up)) / each;
            if (std::abs(projected) > 1e-6) {
                EXPECT_LE(std::abs(projected), flush() + 1e-6);
            }
            result.states += made.accessibility.sample.size();
            result.blocked += static_cast<std::size_t>(std::lround(expected / each));
            result.flush += static_cast<std::size_t>(std::lround(std::abs(samples)));
        }
    }
}

void expect_equal(const Comparison& c, const std::string& what) {
    std::cout << what << ": " << c << std::endl;
    EXPECT_GT(c.states, 0U) << what;
    EXPECT_GT(c.blocked, c.states / 50) << what;
    EXPECT_LE(1'000 * c.flush, c.states) << what;
    EXPECT_LE(100'000 * c.wrong, c.states) << what;  // grazing rays
    EXPECT_EQ(c.wrongly_open, 0U) << what;
}

constexpr std::array specimens{Specimen::vertebra, Specimen::skull, Specimen::femur};

// Made once: that takes longer than all the rest.
const TriangleMesh& small_specimen(Specimen kind) {
    static std::map<Specimen, TriangleMesh> made;
    if (!made.contains(kind)) {
        SampleOptions options;
        options.faces = 6'000;
        made[kind] = sample(kind, options);
    }
    return made[kind];
}

TEST(AccessSweep, EqualsRaysCastOnReallyCutPiecesSampleForSample) {
    std::mt19937 random(41);
    Comparison all;
    std::vector<TriangleMesh> meshes;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) meshes.push_back(mesh);
    for (const Specimen kind : specimens) meshes.push_back(small_specimen(kind));
    for (const TriangleMesh& mesh : meshes) {
        const SampledScan scan = sampled(mesh, 150);
        for (int round = 0; round < 3; ++round) {
            std::vector<TrackedPiece> pieces = uncut_pieces(scan);
            for (std::int32_t number = 1; number <= 5; ++number) {
                const auto cut = random_cut(scan, pieces, number, random);
                if (!cut) continue;
                for (const double tilt : tilts) compare_samples(scan, *cut, tilt, all);
                // The next plane cuts a piece of this one, so that it has several bases.
                pieces = cut->made;
            }
        }
    }
    expect_equal(all, "shapes and specimens");
}

// Planes within the flush tolerance of flat regions, which nudge() would move away: only samples whose rays end at the
// plane may differ.
TEST(AccessSweep, BesideFlatRegionsDiffersOnlyWhereRaysEndAtThePlane) {
    Comparison all;
    for (const auto& mesh : {shapes::stairs(), shapes::nested(), shapes::rotated(shapes::nested(), {1, 2, 3}, 0.4)}) {
        const SampledScan scan = sampled(mesh, 60);
        for (std::uint32_t i = 0; i < 6; ++i) {
            const std::size_t t = i * (mesh.triangles.size() / 6);
            const Vec3 normal = normalized(area_vector(mesh, t));
            const Plane flat = canonical({normal, dot(normal, corners_of(mesh, t)[0])});
            for (const double beside : {-1e-6, -3e-8, -1e-9, 1e-9, 3e-8, 1e-6}) {
                CutPiece cut;
                cut.parent = uncut_pieces(scan)[0];
                cut.plane = {flat.normal, flat.offset + beside * scan.diagonal_mm};
                cut.number = 1;
                cut.made = {cut.parent};
                if (cut_along(scan, cut.made, 0, cut.plane, 1) > 0) compare_samples(scan, cut, 60, all);
            }
        }
    }
    std::cout << "flush planes: " << all << std::endl;
    EXPECT_GT(all.states, 1'000U);
    EXPECT_EQ(all.wrong, 0U);
    EXPECT_EQ(all.wrongly_open, 0U);
}

// Cuts along random planes, and compares both sides of each that makes two solids.
void compare_scan(const TriangleMesh& mesh, std::size_t samples, int rounds, std::mt19937& random, Comparison& result) {
    const SampledScan scan = sampled(mesh, samples);
    for (int round = 0; round < rounds; ++round) {
        std::vector<TrackedPiece> pieces = uncut_pieces(scan);
        for (std::int32_t number = 1; number <= 5; ++number) {
            const auto cut = random_cut(scan, pieces, number, random);
            if (!cut) continue;
            if (cut->made.size() == 2) {
                for (const double tilt : tilts) compare_sides(scan, *cut, tilt, result);
            }
            const auto most =
                std::max_element(cut->made.begin(), cut->made.end(), [](const TrackedPiece& a, const TrackedPiece& b) {
                    return a.accessibility.sample.size() < b.accessibility.sample.size();
                });
            pieces = {*most};
        }
    }
}

TEST(AccessSweep, EqualsTheUnreachableAreaOfReallyCutPieces) {
    std::mt19937 random(42);
    Comparison of_shapes;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) compare_scan(mesh, 300, 2, random, of_shapes);
    expect_equal(of_shapes, "shapes");
    Comparison of_specimens;
    for (const Specimen kind : specimens) {
        compare_scan(small_specimen(kind), 1'000, 2, random, of_specimens);
    }
    expect_equal(of_specimens, "specimens");
}

// Both sides of a plane on their best bases, beside the entry (piece_access.h) on the pieces that it makes.
TEST(AccessSweep, EqualsTheEntryOnReallyCutPieces) {
    constexpr double tilt = 60;
    std::mt19937 random(49);
    int compared = 0;
    for (const Specimen kind : {Specimen::femur, Specimen::vertebra}) {
        std::vector<Piece> pieces{piece_of(small_specimen(kind))};
        sample_uncut(pieces, {}, 2'000);
        for (std::int32_t number = 1; number <= 12; ++number) {
            const Piece& piece = pieces[random() % pieces.size()];
            const Vec3 normal = random_normal(random);
            const Extent range = extent(*piece.mesh, normal);
            const auto nudged = nudge(piece, normal, std::array{range.low + 0.45 * range.size()})[0];
            auto made = nudged ? cut_piece(piece, {normal, nudged->offset}, number) : std::nullopt;
            if (!made || made->pieces.size() != 2) continue;
            sample_parts(piece, *made);
            // Where no cap carries a side the entry takes the sides of its box, the sweep the best cap.
            const bool both_lie = std::all_of(made->pieces.begin(), made->pieces.end(), [&](const Piece& part) {
                return area_on_best_base(part, tilt).base.base.cut.has_value();
            });
            const Plane plane{normal, nudged->offset};
            const std::optional<double> really = unreachable_when_cut_mm2(piece, plane, 0, tilt);
            ASSERT_TRUE(really.has_value());
            if (both_lie) {
                ++compared;
                // A few rays end at the plane, and the new cap's area is that of the samples.
                const double near = 3 * piece.samples->scan->samples.area_each_mm2 + 0.01 * made->cap_area_mm2;
                EXPECT_NEAR(cut_access(piece, plane, tilt).unreachable_mm2, *really, near) << number;
            }
            pieces = made->pieces;
        }
    }
    EXPECT_GE(compared, 10);
}

TEST(AccessSweep, EqualsTheUnreachableAreaOnRealScans) {
    if (!std::filesystem::exists(QCHOPPER_MESHES)) GTEST_SKIP() << "skipped: the real meshes are not here";
    std::mt19937 random(43);
    Comparison all;
    for (const RealScan& real : valid_scans(QCHOPPER_MESHES, 30'000)) {
        ImportOptions options;
        options.mm_per_unit = 1;
        compare_scan(import_scan(std::filesystem::path(QCHOPPER_MESHES) / real.file, options).mesh, 1'000, 2, random,
                     all);
    }
    expect_equal(all, "real scans");
}

// A piece with two caps, its sweep for several tilts.
struct Sample {
    explicit Sample(const TriangleMesh& mesh, std::size_t samples = 2'000, int cuts = 2)
        : scan(sampled(mesh, samples)), pieces(uncut_pieces(scan)) {
        std::mt19937 random(44);
        for (std::int32_t number = 1; number <= cuts; ++number) {
            const std::size_t made = cut_at(scan, pieces, 0, random_normal(random), 0.4, number);
            if (made > 0) pieces = {pieces[pieces.size() - made]};
        }
        caps = owned_caps(pieces[0].piece);
    }
    JudgedPiece judged() const { return {scan, pieces[0].accessibility, caps}; }
    std::vector<PlaneAccess> sweep(Vec3 normal, double tilt, int planes = 20) const {
        return AccessSweep(pieces[0].piece, judged(), tilt).sweep(normal, offsets(normal, planes));
    }
    std::vector<double> offsets(Vec3 normal, int planes) const {
        const Extent range = extent(*pieces[0].piece.mesh, normal);
        std::vector<double> result;
        for (int j = 1; j <= planes; ++j) result.push_back(range.low + range.size() * j / (planes + 1));
        return result;
    }
    SampledScan scan;
    std::vector<TrackedPiece> pieces;
    std::vector<OwnedCap> caps;
};

TEST(AccessSweep, GrowingTheTiltNeverMakesTheAreaLarger) {
    std::mt19937 random(45);
    std::size_t smaller = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Sample piece(mesh, 500);
        for (const Vec3 normal : {random_normal(random), canonical({piece.scan.directions[40], 0}).normal}) {
            std::vector<PlaneAccess> before = piece.sweep(normal, 15);
            for (const double tilt : {30.0, 60.0, 75.0, 90.0}) {
                const std::vector<PlaneAccess> now = piece.sweep(normal, tilt);
                for (std::size_t j = 0; j < now.size(); ++j) {
                    for (const bool above : {true, false}) {
                        const auto a = side(before[j], above);
                        const auto b = side(now[j], above);
                        ASSERT_EQ(a.size(), b.size());
                        for (std::size_t i = 0; i < a.size(); ++i) {
                            EXPECT_LE(b[i].unreachable_mm2, a[i].unreachable_mm2 * (1 + 1e-12)) << name << " " << tilt;
                            smaller += b[i].unreachable_mm2 < a[i].unreachable_mm2 ? 1 : 0;
                        }
                    }
                }
                before = now;
            }
        }
    }
    EXPECT_GT(smaller, 100U);
}

TEST(AccessSweep, AFurtherBaseNeverMakesTheLeastLarger) {
    std::mt19937 random(46);
    std::size_t smaller = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Sample piece(mesh, 500);
        for (int i = 0; i < 4; ++i) {
            for (const PlaneAccess& access : piece.sweep(random_normal(random), 60)) {
                for (const bool above : {true, false}) {
                    const std::span<const SideOnBase> all = side(access, above);
                    for (std::size_t count = 1; count < all.size(); ++count) {
                        const auto few = all.first(count);
                        // Where none carries, one that does is taken, whatever its area.
                        if (std::none_of(few.begin(), few.end(), [](const SideOnBase& b) { return b.is_stable(); })) {
                            continue;
                        }
                        const double less = best_base(all.first(count + 1)).unreachable_mm2;
                        EXPECT_LE(less, best_base(few).unreachable_mm2) << name;
                        smaller += less < best_base(few).unreachable_mm2 ? 1 : 0;
                    }
                }
            }
        }
    }
    EXPECT_GT(smaller, 10U);
}

TEST(AccessSweep, TheLeastIsThatOfTheBasesThatCarry) {
    const SideOnBase carries{1, 30, 0, 10, 100};
    const SideOnBase also{2, 20, 0, 50, 100};
    const SideOnBase too_small{3, 5, 0, 9.9, 100};
    EXPECT_EQ(best_base(std::array{carries, too_small, also}).unreachable_mm2, 20);
    EXPECT_EQ(best_base(std::array{too_small, carries}).unreachable_mm2, 30);
    EXPECT_EQ(best_base(std::array{too_small}).unreachable_mm2, 5);
}

TEST(AccessSweep, TurningModelPlanesAndDirectionsTogetherChangesNothing) {
    const Vec3 axis{1, 2, 3};
    const auto turned = [&](Vec3 v) { return shapes::rotated({{v}, {}, {}}, axis, 0.7).points[0]; };
    for (const TriangleMesh& mesh : {shapes::nested(), shapes::torus({0, 0, 0}, 40, 12), shapes::stairs()}) {
        SampledScan scans[2] = {sampled(mesh, 2'000), sampled(shapes::rotated(mesh, axis, 0.7), 2'000)};
        scans[1].directions.clear();
        for (const Vec3& d : scans[0].directions) scans[1].directions.push_back(turned(d));
        std::vector<TrackedPiece> pieces[2];
        for (int i = 0; i < 2; ++i) {
            const Vec3 first = normalized({1, 0.4, 0.2});
            pieces[i] = uncut_pieces(scans[i]);
            ASSERT_GE(cut_along(scans[i], pieces[i], 0, {i == 0 ? first : turned(first), 1.3}, 1), 2U);
        }
        for (const double tilt : tilts) {
            for (const Vec3 normal : {normalized({0.3, -0.2, 1}), scans[0].directions[17]}) {
                std::vector<PlaneAccess> access[2];
                for (int i = 0; i < 2; ++i) {
                    const TrackedPiece& piece = pieces[i].back();
                    const std::vector<OwnedCap> caps = owned_caps(piece.piece);
                    const JudgedPiece judged{scans[i], piece.accessibility, caps};
                    access[i] = AccessSweep(piece.piece, judged, tilt)
                                    .sweep(i == 0 ? normal : turned(normal), std::array{-7.7, 1.234, 6.1});
                }
                const double few = 4 * scans[0].samples.area_each_mm2;
                for (std::size_t j = 0; j < access[0].size(); ++j) {
                    for (const bool above : {true, false}) {
                        const auto before = side(access[0][j], above);
                        const auto after = side(access[1][j], above);
                        ASSERT_EQ(before.size(), after.size());
                        for (std::size_t b = 0; b < before.size(); ++b) {
                            EXPECT_NEAR(after[b].unreachable_mm2, before[b].unreachable_mm2, few) << tilt;
                            EXPECT_NEAR(after[b].base_mm2, before[b].base_mm2, few);
                            EXPECT_NEAR(after[b].projected_mm2, before[b].projected_mm2, few);
                        }
                    }
                }
            }
        }
    }
}

TEST(AccessSweep, AConvexSolidHidesOnlyWhatFacesDown) {
    std::mt19937 random(47);
    for (const auto& mesh : {shapes::ball({5, -3, 2}, 25, 40), shapes::pyramid({0, 0, 0}, 20, 50),
                             shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}, 8), {1, 2, 3}, 0.7)}) {
        const Sample piece(mesh, 3'000, 1);
        ASSERT_EQ(piece.caps.size(), 1U);
        for (int i = 0; i < 5; ++i) {
            const Vec3 normal = random_normal(random);
            const std::vector<double> offsets = piece.offsets(normal, 20);
            const std::vector<PlaneAccess> planes = piece.sweep(normal, 90);
            for (std::size_t j = 0; j < planes.size(); ++j) {
                for (const bool above : {true, false}) {
                    for (const SideOnBase& s : side(planes[j], above)) {
                        const Vec3 up = s.cut != new_cut ? -piece.caps[0].outward : above ? normal : -normal;
                        std::size_t down = 0;
                        for (const std::uint32_t k : piece.pieces[0].accessibility.sample) {
                            const SurfaceSample& sample = piece.scan.samples.sample[k];
                            if ((height(normal, sample.point) >= offsets[j]) != above) continue;
                            down += dot(sample.normal, up) <= -std::cos(23 * std::numbers::pi / 180) ? 1 : 0;
                        }
                        EXPECT_LE(s.unreachable_mm2 - s.caps_mm2,
                                  (static_cast<double>(down) + 1e-6) * piece.scan.samples.area_each_mm2);
                    }
                }
            }
        }
    }
}

// A bar of 40 x 40 x 120 mm: areas are known.
TEST(AccessSweep, AreasOfABarAreKnown) {
    const Sample bar(shapes::box({0, 0, 0}, {40, 40, 120}), 8'000, 0);
    const double each = bar.scan.samples.area_each_mm2;
    for (const PlaneAccess& access : bar.sweep({0, 0, 1}, 60)) {
        for (const bool above : {true, false}) {
            ASSERT_EQ(side(access, above).size(), 1U);
            const SideOnBase& s = side(access, above).front();
            EXPECT_EQ(s.cut, new_cut);
            EXPECT_EQ(s.unreachable_mm2, 0);
            EXPECT_NEAR(s.base_mm2, 1'600, 4 * each);
            EXPECT_NEAR(s.projected_mm2, 1'600, 4 * each);
            EXPECT_TRUE(s.is_stable());
        }
    }
    for (const PlaneAccess& access : bar.sweep({0, 0, 1}, 0))
        EXPECT_EQ(best_base(access.above).unreachable_mm2, 0);  // steep
    const std::vector<PlaneAccess> beside =
        AccessSweep(bar.pieces[0].piece, bar.judged(), 60).sweep({0, 0, 1}, std::array{-1.0, 121.0});
    EXPECT_EQ(beside[0].below[0].unreachable_mm2, 0);  // no sample
    EXPECT_EQ(beside[1].above[0].unreachable_mm2, 0);
    EXPECT_NEAR(beside[0].above[0].unreachable_mm2, 1'600, 4 * each);  // the whole bar, and its foot
    EXPECT_TRUE(AccessSweep(bar.pieces[0].piece, bar.judged(), 60).sweep({0, 0, 1}, {}).empty());
}

// cut_accessibility and cut() count height == offset as above.
TEST(AccessSweep, ASampleOnThePlaneBelongsToTheSideAbove) {
    const SampledScan scan = sampled(shapes::box({0, 0, 0}, {40, 40, 40}), 3'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    ASSERT_EQ(cut_along(scan, pieces, 0, {{0, 0, 1}, 10}, 1), 2U);
    const TrackedPiece& lower = pieces[1];
    ASSERT_FALSE(lower.piece.half_spaces[0].above);
    const std::vector<OwnedCap> caps = owned_caps(lower.piece);
    // Its foot lies at height 0 to the last bit; it is the top on the old base.
    const AccessSweep sweep(lower.piece, {scan, lower.accessibility, caps}, 60);
    const PlaneAccess at_foot = sweep.sweep({0, 0, 1}, std::array{0.0})[0];
    EXPECT_NEAR(projected_area_mm2({scan, lower.accessibility, caps}, {0, 0, 1}), 1'600, 1e-6);  // its cap alone
    ASSERT_EQ(at_foot.above.size(), 2U);
    ASSERT_EQ(at_foot.below.size(), 1U);
    EXPECT_EQ(at_foot.below[0].projected_mm2, 0);
    EXPECT_NEAR(at_foot.above[1].projected_mm2, 1'600, 4 * scan.samples.area_each_mm2);
    EXPECT_NEAR(at_foot.above[0].unreachable_mm2, 1'600, 4 * scan.samples.area_each_mm2);
    // The same upside down: the side that the normal points away from loses it.
    const PlaneAccess from_under = sweep.sweep({0, 0, -1}, std::array{0.0})[0];
    ASSERT_EQ(from_under.below.size(), 2U);
    EXPECT_NEAR(from_under.below[1].projected_mm2, 1'600, 1e-6);  // the new cap, where the foot was
    EXPECT_NEAR(from_under.above[0].unreachable_mm2, 0, 1e-9);
    EXPECT_NEAR(from_under.above[0].projected_mm2, 1'600, 4 * scan.samples.area_each_mm2);
}

// An old cap that faces down, beside the new base, and parts of it on both sides.
TEST(AccessSweep, CapsThatFaceAwayCountByTheirAreaOnTheSide) {
    const SampledScan scan = sampled(shapes::box({0, 0, 0}, {40, 40, 40}), 3'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    ASSERT_EQ(cut_along(scan, pieces, 0, {{0, 0, 1}, 10}, 1), 2U);
    const TrackedPiece& upper = pieces[0];
    ASSERT_TRUE(upper.piece.half_spaces[0].above);
    const std::vector<OwnedCap> caps = owned_caps(upper.piece);
    const JudgedPiece judged{scan, upper.accessibility, caps};
    const AccessSweep sweep(upper.piece, judged, 30);
    // Across the old cap: parts of 40 x 15 and 40 x 25 mm face sideways, which a tool tilted by 30 degrees cannot reach
    // from a base at right angles.
    const PlaneAccess across = sweep.sweep({1, 0, 0}, std::array{15.0})[0];
    ASSERT_EQ(across.below.size(), 2U);
    ASSERT_EQ(across.above.size(), 2U);
    EXPECT_NEAR(across.below[1].base_mm2, 600, 1e-6);
    EXPECT_NEAR(across.above[1].base_mm2, 1'000, 1e-6);
    EXPECT_EQ(across.below[0].caps_mm2, 0);
    // The new cap stands upright on the old base, and a tilted tool reaches it.
    EXPECT_EQ(across.below[1].caps_mm2, 0);
    // Parallel to it: the old cap, face down on nothing but the new base's opposite.
    const PlaneAccess parallel = sweep.sweep({0, 0, 1}, std::array{25.0})[0];
    ASSERT_EQ(parallel.above.size(), 1U);
    ASSERT_EQ(parallel.below.size(), 2U);
    EXPECT_NEAR(parallel.below[1].base_mm2, 1'600, 1e-6);
    EXPECT_EQ(parallel.below[0].caps_mm2, 0);  // on the new base the old cap faces up
    EXPECT_EQ(parallel.below[1].caps_mm2, 0);
    // Slanting, with the old cap as the roof of an overhang above the plane.
    const Vec3 slanting = normalized({1, 0, 1});
    const PlaneAccess roof = sweep.sweep(slanting, std::array{dot(slanting, {20, 0, 10})})[0];
    ASSERT_EQ(roof.above.size(), 2U);
    EXPECT_NEAR(roof.above[1].base_mm2, 800, 1e-6);
    EXPECT_NEAR(roof.above[0].caps_mm2, 800, 1e-6);
    EXPECT_NEAR(roof.above[1].caps_mm2, roof.above[0].base_mm2, 1e-6);
    EXPECT_EQ(roof.below[0].caps_mm2, 0);
    EXPECT_EQ(roof.below[1].caps_mm2, 0);
}

TEST(AccessSweep, TheNewCapHasTheAreaOfTheCut) {
    std::mt19937 random(48);
    for (const TriangleMesh& mesh : {small_specimen(Specimen::vertebra), shapes::torus({0, 0, 0}, 40, 12)}) {
        for (const int cuts : {0, 2}) {
            const Sample piece(mesh, 5'000, cuts);
            for (int i = 0; i < 10; ++i) {
                const Vec3 normal = random_normal(random);
                const std::vector<double> offsets = piece.offsets(normal, 9);
                const std::vector<PlaneAccess> planes = piece.sweep(normal, 60, 9);
                for (const std::size_t j : {2U, 4U, 6U}) {
                    const auto halves = qchopper::cut(*piece.pieces[0].piece.mesh, {normal, offsets[j]}, 9);
                    ASSERT_TRUE(halves);
                    EXPECT_NEAR(planes[j].below[0].base_mm2, halves->cap_area_mm2, 0.005 * area_mm2(mesh));
                    EXPECT_EQ(planes[j].below[0].base_mm2, planes[j].above[0].base_mm2);
                }
            }
        }
    }
}

TEST(AccessSweep, IsTheSameForAnyNumberOfThreads) {
    const Sample piece(small_specimen(Specimen::skull), 3'000);
    ASSERT_EQ(piece.caps.size(), 2U);
    std::vector<Vec3> normals = octahedron_normals();
    normals.push_back(normalized({0.123, 0.4, 1}));
    const auto all = [&] {
        const AccessSweep sweep(piece.pieces[0].piece, piece.judged(), 60);
        std::vector<std::vector<PlaneAccess>> result(normals.size());
        parallel_for(0, normals.size(),
                     [&](std::size_t i) { result[i] = sweep.sweep(normals[i], piece.offsets(normals[i], 40)); });
        std::vector<std::tuple<std::int32_t, double, double, double, double>> flat;
        for (const auto& planes : result) {
            for (const PlaneAccess& access : planes) {
                for (const bool above : {true, false}) {
                    for (const SideOnBase& s : side(access, above)) {
                        flat.emplace_back(s.cut, s.unreachable_mm2, s.caps_mm2, s.base_mm2, s.projected_mm2);
                    }
                }
            }
        }
        return flat;
    };
    const auto expected = all();
    EXPECT_GT(expected.size(), 2 * 40 * normals.size());
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(all(), expected) << threads;
    }
}

}  // namespace
}  // namespace qchopper
