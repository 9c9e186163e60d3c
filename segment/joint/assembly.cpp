// Per cut: which solids are in front of which, on both sides; their strongly connected groups; and an order of the
// groups, by repeatedly taking the nearest one that nothing needs to precede. Reachability by S. Warshall, "A theorem
// on Boolean matrices" (1962): O(solids^3).

#include "segment/joint/assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/parallel.h"
#include "segment/joint/in_front.h"

namespace qchopper {
namespace {

using Indices = std::vector<std::size_t>;

// The pieces that a piece of the cut tree has become.
class Leaves {
 public:
    explicit Leaves(const Segmentation& segmentation) {
        for (std::size_t i = 0; i < segmentation.pieces.size(); ++i) of_[segmentation.pieces[i].name] = {i};
        for (auto cut = segmentation.cuts.rbegin(); cut != segmentation.cuts.rend(); ++cut) {
            Indices all;
            for (const std::string& name : cut->pieces) {
                const Indices& part = of_[name];
                all.insert(all.end(), part.begin(), part.end());
            }
            std::sort(all.begin(), all.end());
            of_[cut->piece] = std::move(all);
        }
    }
    const Indices& of(const std::string& name) { return of_[name]; }

 private:
    std::map<std::string, Indices> of_;
};

// Solids of one side of a cut, and which of them must stand before which.
struct CutSide {
    std::vector<Indices> solids;
    std::vector<double> nearness;                  // of the middle of the solid, along the normal from the plane
    std::vector<std::vector<bool>> precedes;       // [i][k]: i stands before k, because k is in front of i
    std::vector<std::vector<std::size_t>> groups;  // of solids, in the order in which they are joined
};

void find_order_relation(CutSide& side, const std::vector<Piece>& pieces, Vec3 outward, const Context& context) {
    const std::size_t count = side.solids.size();
    side.precedes.assign(count, std::vector<bool>(count, false));
    std::vector<std::optional<TurnedSolid>> turned(count);
    parallel_for(0, count, [&](std::size_t i) {
        context.check_cancelled();
        std::vector<const TriangleMesh*> meshes;
        for (const std::size_t p : side.solids[i]) meshes.push_back(pieces[p].mesh.get());
        turned[i].emplace(meshes, outward);
    });
    for (std::size_t i = 0; i < count; ++i) side.nearness.push_back(0.5 * (turned[i]->low() + turned[i]->high()));
    if (count < 2) return;
    std::vector<std::vector<InFront>> found(count);
    parallel_for(0, count, [&](std::size_t i) {
        for (std::size_t k = 0; k < i; ++k) {
            context.check_cancelled();
            found[i].push_back(in_front(*turned[i], *turned[k]));
        }
    });
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            side.precedes[k][i] = found[i][k].first;
            side.precedes[i][k] = found[i][k].second;
        }
    }
}

std::vector<std::vector<bool>> closure(std::vector<std::vector<bool>> reaches) {
    const std::size_t count = reaches.size();
    for (std::size_t through = 0; through < count; ++through) {
        for (std::size_t i = 0; i < count; ++i) {
            if (!reaches[i][through]) continue;
            for (std::size_t k = 0; k < count; ++k) reaches[i][k] = reaches[i][k] || reaches[through][k];
        }
    }
    return reaches;
}

// Groups of solids that interlock, nearest first among those that nothing left precedes.
void order_groups(CutSide& side) {
    const std::size_t count = side.solids.size();
    const std::vector<std::vector<bool>> reaches = closure(side.precedes);
    std::vector<bool> is_left(count, true);
    const auto can_go = [&](std::size_t i) {
        for (std::size_t k = 0; k < count; ++k) {
            if (is_left[k] && reaches[k][i] && !reaches[i][k]) return false;
        }
        return true;
    };
    for (std::size_t left = count; left > 0;) {
        std::optional<std::size_t> next;
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_left[i] || !can_go(i)) continue;
            if (!next || side.nearness[i] < side.nearness[*next]) next = i;
        }
        std::vector<std::size_t> group;
        for (std::size_t i = 0; i < count; ++i) {
            if (is_left[i] && (i == *next || (reaches[i][*next] && reaches[*next][i]))) group.push_back(i);
        }
        for (const std::size_t i : group) is_left[i] = false;
        left -= group.size();
        side.groups.push_back(std::move(group));
    }
}

bool is_above(const Piece& piece, std::int32_t cut) {
    for (const HalfSpace& half_space : piece.half_spaces) {
        if (half_space.cut == cut) return half_space.above;
    }
    return false;
}

bool contains(const Indices& sorted, std::size_t value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

// Joins what a cut parted.
class CutAssembly {
 public:
    CutAssembly(const Segmentation& segmentation, std::span<const PieceJoint> joints, const Cut& cut, Leaves& leaves,
                const Context& context)
        : pieces_(segmentation.pieces), joints_(joints), cut_(cut) {
        for (const std::string& name : cut.pieces) {
            const Indices& solid = leaves.of(name);
            if (!solid.empty()) sides_[is_above(pieces_[solid.front()], cut.number) ? 1 : 0].solids.push_back(solid);
        }
        for (const bool above : {false, true}) {
            find_order_relation(sides_[above], pieces_, outward(above), context);
            order_groups(sides_[above]);
        }
    }

    void add_steps(std::vector<AssemblyStep>& steps) {
        const bool standing_side = sides_[0].groups.size() > sides_[1].groups.size();
        if (sides_[standing_side].groups.empty()) return;
        std::array<std::size_t, 2> next{};
        Indices standing = members({standing_side, next[standing_side]++});
        while (next[0] < sides_[0].groups.size() || next[1] < sides_[1].groups.size()) {
            const Group group = next_group(next, !standing_side, standing);
            ++next[group.above];
            steps.push_back(step(group, standing));
            standing.insert(standing.end(), steps.back().moved.begin(), steps.back().moved.end());
            std::sort(standing.begin(), standing.end());
        }
    }

 private:
    struct Group {
        bool above = false;
        std::size_t number = 0;
    };

    Vec3 outward(bool above) const { return above ? cut_.chosen.plane.normal : -cut_.chosen.plane.normal; }

    Indices members(const Group& group) const {
        Indices all;
        for (const std::size_t solid : sides_[group.above].groups[group.number]) {
            const Indices& part = sides_[group.above].solids[solid];
            all.insert(all.end(), part.begin(), part.end());
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    Indices joints_between(const Indices& moved, const Indices& standing) const {
        Indices between;
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            const PieceJoint& joint = joints_[j];
            if (joint.cut != cut_.number) continue;
            if ((contains(moved, joint.below) && contains(standing, joint.above)) ||
                (contains(moved, joint.above) && contains(standing, joint.below))) {
                between.push_back(j);
            }
        }
        return between;
    }

    // Of the next groups of both sides one that touches what stands, of the moving side first.
    Group next_group(const std::array<std::size_t, 2>& next, bool moving_side, const Indices& standing) const {
        std::optional<Group> any;
        for (const bool above : {moving_side, !moving_side}) {
            if (next[above] >= sides_[above].groups.size()) continue;
            const Group group{above, next[above]};
            if (!joints_between(members(group), standing).empty()) return group;
            if (!any) any = group;
        }
        return *any;
    }

    // Heights along the normal.
    std::array<double, 2> range(const Indices& pieces) const {
        std::array<double, 2> range{INFINITY, -INFINITY};
        for (const std::size_t p : pieces) {
            for (const Vec3& point : pieces_[p].mesh->points) {
                const double h = height(cut_.chosen.plane.normal, point);
                range = {std::min(range[0], h), std::max(range[1], h)};
            }
        }
        return range;
    }

    // No solid that stands on the side of those that move is in front of one of them, the plane separates the others,
    // and the dowels of the joints are parallel to the move.
    bool is_clear(const Group& group, const Indices& standing, const std::array<double, 2>& moved_range) const {
        const CutSide& side = sides_[group.above];
        for (const std::size_t i : side.groups[group.number]) {
            for (std::size_t k = 0; k < side.solids.size(); ++k) {
                const bool stands = contains(standing, side.solids[k].front());
                if (stands && side.precedes[i][k]) return false;
            }
        }
        const double offset = cut_.chosen.plane.offset;
        const double slack = 1e-6;
        if (group.above ? moved_range[0] < offset - slack : moved_range[1] > offset + slack) return false;
        for (const Indices& solid : sides_[!group.above].solids) {
            const std::array<double, 2> heights = range(solid);
            if (group.above ? heights[1] > offset + slack : heights[0] < offset - slack) return false;
        }
        return true;
    }

    AssemblyStep step(const Group& group, const Indices& standing) const {
        AssemblyStep step;
        step.cut = cut_.number;
        step.moved = members(group);
        step.standing = standing;
        step.solids = sides_[group.above].groups[group.number].size();
        step.direction = -outward(group.above);
        step.joints = joints_between(step.moved, standing);
        const std::array<double, 2> moved_range = range(step.moved);
        const std::array<double, 2> standing_range = range(standing);
        double dowel = 0;
        for (const std::size_t j : step.joints) {
            for (const Dowel& d : joints_[j].dowels) dowel = std::max(dowel, d.size.depth);
        }
        // until the moved pieces have passed all that stands, and its dowels
        const double apart = group.above ? standing_range[1] - moved_range[0] : moved_range[1] - standing_range[0];
        step.distance_mm = std::max(0.0, apart) + dowel + 10;
        step.is_clear = is_clear(group, standing, moved_range);
        return step;
    }

    const std::vector<Piece>& pieces_;
    std::span<const PieceJoint> joints_;
    const Cut& cut_;
    std::array<CutSide, 2> sides_;  // below, above
};

}  // namespace

Assembly assembly_of(const Segmentation& segmentation, std::span<const PieceJoint> joints, const Context& context) {
    Leaves leaves(segmentation);
    Assembly assembly;
    const std::size_t count = segmentation.cuts.size();
    for (std::size_t c = count; c-- > 0;) {
        context.check_cancelled();
        context.progress("cuts undone for the assembly", count - 1 - c, count);
        CutAssembly(segmentation, joints, segmentation.cuts[c], leaves, context).add_steps(assembly.steps);
    }
    return assembly;
}

std::vector<std::vector<AssemblyKey>> assembly_keys(const Assembly& assembly, std::size_t pieces) {
    std::vector<std::vector<AssemblyKey>> keys(pieces);
    std::vector<Vec3> shift(pieces);
    for (std::size_t s = assembly.steps.size(); s-- > 0;) {
        const AssemblyStep& step = assembly.steps[s];
        for (const std::size_t p : step.moved) {
            keys[p].push_back({static_cast<double>(s + 1), shift[p]});
            shift[p] = shift[p] - step.distance_mm * step.direction;
            keys[p].push_back({static_cast<double>(s), shift[p]});
        }
    }
    for (std::vector<AssemblyKey>& of_piece : keys) {
        std::reverse(of_piece.begin(), of_piece.end());
        if (!of_piece.empty() && of_piece.front().time_s > 0) of_piece.insert(of_piece.begin(), {0, of_piece[0].shift});
        // two steps in a row share a time
        const auto same = [](const AssemblyKey& a, const AssemblyKey& b) { return a.time_s == b.time_s; };
        of_piece.erase(std::unique(of_piece.begin(), of_piece.end(), same), of_piece.end());
    }
    return keys;
}

}  // namespace qchopper
