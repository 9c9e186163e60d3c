// Sites first, for every joint on its own; then the patterns, one joint after the other, each against those before.
// O(joints x sites x triangles near a hole) for the sites, O(joints x sites squared) for the patterns.

#include "segment/joint/piece_joints.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "base/shared_progress.h"
#include "base/text.h"
#include "segment/joint/dowel_pattern.h"
#include "segment/joint/dowel_sites.h"

namespace qchopper {
namespace {

// A hole of a piece, for the distance to others.
struct Hole {
    Axis axis;
    DowelSize size;
};

Axis axis_in(const PieceJoint& joint, const Dowel& dowel, bool above) {
    return {dowel.point, dowel.point + (above ? dowel.size.depth : -dowel.size.depth) * joint.plane.normal};
}

bool keep_apart(const Hole& a, const Hole& b) {
    const double wall = std::max(a.size.wall, b.size.wall);
    return distance_between(a.axis, b.axis) >= a.size.radius() + b.size.radius() + wall;
}

// The holes made so far, per piece, and the patterns, per joint.
struct Made {
    std::vector<std::vector<Hole>> holes;
    std::vector<DowelPattern> patterns;
};

bool is_clear_of_holes(const Made& made, const PieceJoint& joint, const std::vector<Dowel>& dowels) {
    for (const bool above : {false, true}) {
        for (const Hole& hole : made.holes[above ? joint.above : joint.below]) {
            for (const Dowel& dowel : dowels) {
                if (!keep_apart(hole, {axis_in(joint, dowel, above), dowel.size})) return false;
            }
        }
    }
    return true;
}

std::optional<std::size_t> alike_one(const Made& made, const DowelPattern& pattern, double tolerance) {
    for (std::size_t j = 0; j < made.patterns.size(); ++j) {
        if (!made.patterns[j].empty() && are_alike(made.patterns[j], pattern, tolerance)) return j;
    }
    return std::nullopt;
}

std::vector<Dowel> dowels_of(const PieceJoint& joint, const DowelPattern& pattern, std::span<const DowelSize> sizes) {
    std::vector<Dowel> dowels;
    for (const PatternDowel& dowel : pattern) {
        dowels.push_back({sizes[dowel.size], from_plane(joint.plane, dowel.at)});
    }
    return dowels;
}

std::vector<DowelSize> largest_first(std::vector<DowelSize> sizes) {
    std::stable_sort(sizes.begin(), sizes.end(),
                     [](const DowelSize& a, const DowelSize& b) { return a.diameter > b.diameter; });
    return sizes;
}

void place(Made& made, PieceJoint& joint, std::size_t index, const DowelPattern& pattern,
           std::span<const DowelSize> sizes) {
    joint.dowels = dowels_of(joint, pattern, sizes);
    made.patterns[index] = pattern;
    for (const Dowel& dowel : joint.dowels) {
        made.holes[joint.below].push_back({axis_in(joint, dowel, false), dowel.size});
        made.holes[joint.above].push_back({axis_in(joint, dowel, true), dowel.size});
    }
}

// The largest single dowel that fits, or none.
std::optional<DowelPattern> single_dowel(const Made& made, const PieceJoint& joint, const SitesOfSizes& sites,
                                         std::span<const DowelSize> sizes) {
    for (std::size_t s = 0; s < sizes.size(); ++s) {
        const std::size_t middle = sites[s].size() / 2;
        for (std::size_t i = 0; i < sites[s].size(); ++i) {
            DowelPattern pattern{{s, sites[s][(middle + i) % sites[s].size()]}};
            if (is_clear_of_holes(made, joint, dowels_of(joint, pattern, sizes))) return pattern;
        }
    }
    return std::nullopt;
}

void choose_dowels(Made& made, PieceJoint& joint, std::size_t index, const SitesOfSizes& sites,
                   const JointSettings& settings) {
    const double tolerance = pattern_tolerance(settings.play);
    std::optional<DowelPattern> alike;  // the best that can be swapped
    std::optional<DowelPattern> chosen;
    first_pattern(settings.sizes, sites, tolerance, [&](const DowelPattern& pattern) {
        if (alike && alike_one(made, pattern, tolerance)) return false;
        if (!is_clear_of_holes(made, joint, dowels_of(joint, pattern, settings.sizes))) return false;
        (alike_one(made, pattern, tolerance) ? alike : chosen) = pattern;
        return chosen.has_value();
    });
    if (chosen) {
        joint.fault = JointFault::none;
        return place(made, joint, index, *chosen, settings.sizes);
    }
    if (alike) {
        joint.fault = JointFault::can_be_swapped;
        joint.alike = alike_one(made, *alike, tolerance);
        return place(made, joint, index, *alike, settings.sizes);
    }
    const std::optional<DowelPattern> single = single_dowel(made, joint, sites, settings.sizes);
    joint.fault = single ? JointFault::can_be_turned : JointFault::no_dowel;
    if (single) place(made, joint, index, *single, settings.sizes);
}

// Whether a hole of one size has the other size's hole in it, wall included: where it is clear, so is the other.
bool contains_hole(const DowelSize& size, const DowelSize& other) {
    return size.depth >= other.depth && size.clearance() >= other.clearance();
}

SitesOfSizes sites_among(const ContactSides& sides, const std::vector<Point2>& points,
                         const std::vector<DowelSize>& sizes) {
    SitesOfSizes sites(sizes.size());
    for (std::size_t s = sizes.size(); s-- > 0;) {
        const bool is_known = s + 1 < sizes.size() && contains_hole(sizes[s], sizes[s + 1]);
        sites[s] = clear_sites(sides, is_known ? sites[s + 1] : points, sizes[s]);
    }
    return sites;
}

// Thin walls have few sites: they are searched again on finer grids.
SitesOfSizes sites_of(const PieceJoint& joint, const std::vector<std::optional<PieceSurface>>& surfaces,
                      const JointSettings& settings) {
    constexpr std::size_t enough = 24;
    constexpr std::size_t finest = 16;  // times as many points
    const ContactSides sides{*surfaces[joint.below], *surfaces[joint.above], joint.plane, joint.cut};
    SitesOfSizes sites(settings.sizes.size());
    std::size_t points_before = 0;
    for (std::size_t times = 1; times <= finest; times *= 4) {
        const std::vector<Point2> points = grid_points(joint.contact, times * settings.sites);
        if (sites.empty() || points.size() <= points_before) break;
        points_before = points.size();
        sites = sites_among(sides, points, settings.sizes);
        if (sites.back().size() >= enough) break;
    }
    return sites;
}

std::vector<SitesOfSizes> all_sites(std::span<const Piece> pieces, const std::vector<PieceJoint>& joints,
                                    const JointSettings& settings, const Context& context) {
    std::vector<std::optional<PieceSurface>> surfaces(pieces.size());
    std::vector<bool> is_asked(pieces.size());
    for (const PieceJoint& joint : joints) is_asked[joint.below] = is_asked[joint.above] = true;
    parallel_for(0, pieces.size(), [&](std::size_t i) {
        context.check_cancelled();
        if (is_asked[i]) surfaces[i].emplace(pieces[i]);
    });
    std::vector<SitesOfSizes> sites(joints.size());
    SharedProgress progress(context, "joints searched for dowels", joints.size());
    parallel_for(0, joints.size(), [&](std::size_t j) {
        context.check_cancelled();
        sites[j] = sites_of(joints[j], surfaces, settings);
        progress.add(1);
    });
    return sites;
}

}  // namespace

std::vector<PieceJoint> contacts_of(std::span<const Piece> pieces, double min_mm2) {
    struct BoundedPiece {
        HalfSpace half_space;
        std::size_t piece = 0;
    };
    std::vector<BoundedPiece> sides;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        for (const HalfSpace& half_space : pieces[p].half_spaces) sides.push_back({half_space, p});
    }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const BoundedPiece& a, const BoundedPiece& b) { return a.half_space.cut < b.half_space.cut; });
    std::vector<std::optional<PieceJoint>> found;
    std::vector<std::pair<BoundedPiece, BoundedPiece>> pairs;
    for (const BoundedPiece& below : sides) {
        for (const BoundedPiece& above : sides) {
            if (below.half_space.cut != above.half_space.cut || below.half_space.above || !above.half_space.above)
                continue;
            pairs.emplace_back(below, above);
        }
    }
    found.resize(pairs.size());
    parallel_for(0, pairs.size(), [&](std::size_t i) {
        const auto& [below, above] = pairs[i];
        FlatRegion contact =
            contact_region(pieces[below.piece], below.half_space, pieces[above.piece], above.half_space, min_mm2);
        if (contact.empty()) return;
        found[i] =
            PieceJoint{below.half_space.cut, below.half_space.plane, below.piece, above.piece, std::move(contact), {},
                       JointFault::no_dowel};
    });
    std::vector<PieceJoint> joints;
    for (std::optional<PieceJoint>& joint : found) {
        if (joint) joints.push_back(std::move(*joint));
    }
    return joints;
}

std::vector<PieceJoint> piece_joints(std::span<const Piece> pieces, const JointSettings& given,
                                     const Context& context) {
    JointSettings settings = given;
    settings.sizes = largest_first(given.sizes);
    std::vector<PieceJoint> joints = contacts_of(pieces, settings.min_mm2);
    context.progress("joints searched for dowels", 0, joints.size());
    const std::vector<SitesOfSizes> sites = all_sites(pieces, joints, settings, context);
    std::vector<std::size_t> order(joints.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto room = [&](std::size_t j) {
        std::size_t count = 0;
        for (const std::vector<Point2>& of_size : sites[j]) count += of_size.size();
        return count;
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(room(a), joints[a].contact.area_mm2) < std::pair(room(b), joints[b].contact.area_mm2);
    });
    Made made{std::vector<std::vector<Hole>>(pieces.size()), std::vector<DowelPattern>(joints.size())};
    for (const std::size_t j : order) {
        context.check_cancelled();
        choose_dowels(made, joints[j], j, sites[j], settings);
    }
    return joints;
}

std::string joint_name(const PieceJoint& joint, std::span<const Piece> pieces) {
    return pieces[joint.below].name + "-" + pieces[joint.above].name + " (cut " + std::to_string(joint.cut) + ")";
}

std::string describe_fault(const PieceJoint& joint, std::span<const Piece> pieces, std::span<const PieceJoint> joints) {
    const std::string name =
        "joint " + joint_name(joint, pieces) + ", " + fixed(joint.contact.area_mm2 / 100, 1) + " cm2: ";
    switch (joint.fault) {
        case JointFault::none:
            return {};
        case JointFault::can_be_swapped:
            return name + "its dowels also fit joint " + joint_name(joints[*joint.alike], pieces) +
                   ", and there is no room for others";
        case JointFault::can_be_turned:
            return name + "there is room for one dowel only, so it can be turned";
        case JointFault::no_dowel:
            return name + "no dowel of the list fits";
    }
    return {};
}

}  // namespace qchopper
