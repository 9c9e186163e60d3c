#include "segment/access/access_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>

#include "segment/access/piece_access.h"
#include "segment/import/import_scan.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/real_scans.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/segment/access/swept_planes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

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

// The caps of a piece that may be sawn when it lies on a base: square to it, or opposite.
std::vector<std::int32_t> sawn_with(std::span<const OwnedCap> caps, const TiltBase& base) {
    std::vector<std::int32_t> sawn;
    for (const OwnedCap& cap : caps) {
        const double up = dot(cap.outward, base.up);
        if (std::abs(up) < 1e-9 || up > 1 - 1e-9) sawn.push_back(cap.cut);
    }
    return sawn;
}

struct Comparison {
    std::size_t states = 0;
    std::size_t flush = 0;         // unequal, and a ray or the sample within the flush tolerance of the plane
    std::size_t wrong = 0;         // unequal besides
    std::size_t wrongly_open = 0;  // of those; also where a side is several solids
    std::size_t blocked = 0;
    std::size_t sawn = 0;  // caps of sides that may be faces of the block
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
            TiltBase base = lying_on(cap);
            base.flush = sawn_with(caps, base);
            result.sawn += base.flush.size();
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

// Sawn caps are no surface to reach, and the sweep does not know which are sawn: it must count none of those that may
// be, at any tilt, and still count caps that overhang. Fails if is_out_of_reach() takes a cap that is square to the
// base for one that faces away (turned_away = 1e-9), and if the sweep leaves overhanging caps out.
TEST(AccessSweep, CountsNoCapThatMayBeSawn) {
    const Vec3 up = normalized({0.2, -0.3, 0.9});
    const Vec3 across = normalized(cross(up, {1, 0.1, 0}));
    const Vec3 along = cross(across, up);
    for (const double tilt : {0.0, 60.0}) {
        Comparison all;
        double overhanging = 0;
        for (const Specimen kind : specimens) {
            const SampledScan scan = sampled(small_specimen(kind), 1'000);
            std::vector<TrackedPiece> pieces = uncut_pieces(scan);
            std::int32_t number = 0;
            for (const Vec3& normal : {up, across, normalized(up + 2 * along), along, across, up}) {
                CutPiece cut;
                cut.number = ++number;
                cut.parent = pieces.front();
                const Extent range = extent(*cut.parent.piece.mesh, normal);
                cut.plane = canonical({normal, range.low + 0.55 * range.size()});
                cut.made = {cut.parent};
                if (cut_along(scan, cut.made, 0, cut.plane, number) == 2) compare_sides(scan, cut, tilt, all);
                for (const SideOnBase& below : swept(scan, cut.parent, cut.plane, tilt).below) {
                    overhanging += below.caps_mm2;
                }
                // The largest part is cut on, so that several caps meet in it.
                pieces = {*std::max_element(cut.made.begin(), cut.made.end(), [](const auto& a, const auto& b) {
                    return a.accessibility.sample.size() < b.accessibility.sample.size();
                })};
            }
        }
        expect_equal(all, "square caps, tilt " + std::to_string(static_cast<int>(tilt)));
        EXPECT_GT(all.sawn, 20U);
        EXPECT_GT(overhanging, 0);
    }
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

}  // namespace
}  // namespace qchopper
