// A setup that has to be changed is chosen again with the change as an option, so that what it reaches is judged by
// height fields as that of any other. The poses of a direction do not depend on the others, so which directions are
// held together is found by adding one after another. Each trial costs a search for a place; where the first setup is
// held, which is the rule, there is one.

#include "cam/setup/reachable_setup.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>

#include "cam/setup/placement/place_block.h"
#include "cam/setup/stock_fit.h"

namespace qchopper {
namespace {

constexpr double same_direction = 1 - 1e-9;  // cosine
constexpr int replacements = 2;              // so many times others are chosen for directions that are not held

bool contains(const std::vector<Vec3>& directions, Vec3 direction) {
    return std::any_of(directions.begin(), directions.end(),
                       [&](Vec3 d) { return dot(d, direction) > same_direction; });
}

// One piece while its setup is looked for.
class ReachableSetupSearch {
 public:
    ReachableSetupSearch(const Piece& piece, const Cell& cell, const ReachableSetupOptions& options,
                         const Context& context)
        : piece_(piece), cell_(cell), options_(options), context_(context) {}

    ReachableSetup run(SetupChoice choice) {
        if (!cell_.machine || !check_stock_fit(choice.setups.front(), cell_).fits()) return {std::move(choice), {}};
        MachineReachability first = placed(choice.setups.front());
        if (first.holds()) return taken(std::move(choice), first, first.remedy);
        const std::vector<Setup> bases = bases_in_order(choice);
        if (std::optional<ReachableSetup> held = on_another_base(bases)) return std::move(*held);
        for (const Setup& setup : bases) {
            if (std::optional<ReachableSetup> held = with_other_directions(setup)) return std::move(*held);
        }
        return refused(std::move(choice), std::move(first));
    }

 private:
    static ReachableSetup taken(SetupChoice choice, MachineReachability reachability, Remedy remedy) {
        reachability.remedy = remedy;
        choice.setups.front().placement = reachability.placement;
        return {std::move(choice), std::move(reachability)};
    }

    // What refuses the first direction is told, if it is not held alone: the others could be left out.
    ReachableSetup refused(SetupChoice choice, MachineReachability first) {
        const Setup& setup = choice.setups.front();
        MachineReachability alone = place_block(setup, {poses_of(setup).front()}, cell_, {}, context_);
        if (!alone.holds()) first = std::move(alone);
        first.remedy = options_.setup.base ? Remedy::base : Remedy::cut;
        return {std::move(choice), std::move(first)};
    }

    // The best one first, those that would leave too much out of reach last.
    std::vector<Setup> bases_in_order(const SetupChoice& choice) const {
        std::vector<Setup> bases{choice.setups.front()};
        if (options_.setup.base) return bases;
        for (std::size_t i = 1; i < choice.setups.size(); ++i) {
            if (check_stock_fit(choice.setups[i], cell_).fits()) bases.push_back(choice.setups[i]);
        }
        std::stable_partition(bases.begin() + 1, bases.end(),
                              [&](const Setup& s) { return is_good(s, bases.front()); });
        return bases;
    }

    bool is_good(const Setup& setup, const Setup& best) const {
        return !setup.access.exceeds(std::max(options_.max_unreachable, best.access.unreachable_share()));
    }

    std::optional<ReachableSetup> on_another_base(const std::vector<Setup>& bases) {
        for (std::size_t i = 1; i < bases.size() && is_good(bases[i], bases.front()); ++i) {
            if (!first_place(bases[i], poses_of(bases[i]), cell_, {}, context_)) continue;
            if (std::optional<ReachableSetup> held = chosen_again(bases[i].base_number, {}, Remedy::base)) return held;
        }
        return std::nullopt;
    }

    std::optional<ReachableSetup> with_other_directions(const Setup& setup) {
        std::vector<Vec3> kept;
        std::vector<Vec3> refused;
        if (!divide_directions(setup, poses_of(setup), kept, refused)) return std::nullopt;
        const auto is_not_refused = [&](Vec3 direction) { return !contains(refused, direction); };
        for (int trial = 0; trial < replacements; ++trial) {
            SetupChoice choice = chosen(setup.base_number, is_not_refused);
            const Setup& other = choice.setups.front();
            const std::vector<OrientationPoses> poses = milling_poses(other, *piece_.mesh, cell_);
            if (first_place(other, poses, cell_, {}, context_)) {
                MachineReachability reachability = place_block(other, poses, cell_, {}, context_);
                if (reachability.holds())
                    return taken(std::move(choice), std::move(reachability), Remedy::orientations);
            }
            kept.clear();
            if (!divide_directions(other, poses, kept, refused)) return std::nullopt;
        }
        const auto is_kept = [&](Vec3 direction) { return contains(kept, direction); };
        return chosen_again(setup.base_number, is_kept, Remedy::orientations);
    }

    // Of the directions those that are held together at some place, and, added to `refused`, the others; false if not
    // even the first is held.
    bool divide_directions(const Setup& setup, const std::vector<OrientationPoses>& poses, std::vector<Vec3>& kept,
                           std::vector<Vec3>& refused) const {
        std::vector<OrientationPoses> together;
        BlockPlacement place;
        for (std::size_t d = 0; d < poses.size(); ++d) {
            together.push_back(poses[d]);
            std::optional<BlockPlacement> found = first_place(setup, together, cell_, place, context_);
            if (!found && d == 0) return false;
            if (!found) together.pop_back();
            (found ? kept : refused).push_back(setup.access.orientations[d].tool_axis);
            if (found) place = std::move(*found);
        }
        return true;
    }

    SetupChoice chosen(int base, const std::function<bool(Vec3)>& is_allowed) const {
        context_.check_cancelled();
        SetupOptions options = options_.setup;
        options.base = base;
        options.is_allowed = is_allowed;
        return choose_setup(piece_, cell_, options);
    }

    std::optional<ReachableSetup> chosen_again(int base, const std::function<bool(Vec3)>& is_allowed, Remedy remedy) {
        SetupChoice choice = chosen(base, is_allowed);
        MachineReachability reachability = place_block(choice.setups.front(), *piece_.mesh, cell_, {}, context_);
        if (!reachability.holds()) return std::nullopt;
        return taken(std::move(choice), std::move(reachability), remedy);
    }

    MachineReachability placed(const Setup& setup) { return place_block(setup, poses_of(setup), cell_, {}, context_); }

    const std::vector<OrientationPoses>& poses_of(const Setup& setup) {
        const auto known = poses_.find(setup.base_number);
        if (known != poses_.end()) return known->second;
        return poses_[setup.base_number] = milling_poses(setup, *piece_.mesh, cell_);
    }

    const Piece& piece_;
    const Cell& cell_;
    const ReachableSetupOptions& options_;
    const Context& context_;
    std::map<int, std::vector<OrientationPoses>> poses_;  // by the number of the base
};

}  // namespace

ReachableSetup reachable_setup(const Piece& piece, SetupChoice choice, const Cell& cell,
                               const ReachableSetupOptions& options, const Context& context) {
    assert(!choice.setups.empty());
    return ReachableSetupSearch(piece, cell, options, context).run(std::move(choice));
}

}  // namespace qchopper
