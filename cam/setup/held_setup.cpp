// A setup that has to be changed is chosen again with the change as an option, so that what it reaches is judged by
// height maps as that of any other. The poses of a direction do not depend on the others, so which directions are held
// together is found by adding one after another. Each trial costs a search for a place; where the first setup is held,
// which is the rule, there is one.

#include "cam/setup/held_setup.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>

#include "cam/setup/envelope.h"
#include "cam/setup/placement/place_block.h"

namespace qchopper {
namespace {

constexpr double same_direction = 1 - 1e-9;  // cosine
constexpr int replacements = 2;              // so many times others are chosen for directions that are not held

bool contains(const std::vector<Vec3>& directions, Vec3 direction) {
    return std::any_of(directions.begin(), directions.end(),
                       [&](Vec3 d) { return dot(d, direction) > same_direction; });
}

// One piece while its setup is looked for.
class HeldSearch {
 public:
    HeldSearch(const Piece& piece, const Cell& cell, const HeldOptions& options, const Context& context)
        : piece_(piece), cell_(cell), options_(options), context_(context) {}

    HeldSetup run(SetupChoice choice) {
        if (!cell_.machine || !check_envelope(choice.setups.front(), cell_).fits()) return {std::move(choice), {}};
        WorkEnvelope first = placed(choice.setups.front());
        if (first.holds()) return taken(std::move(choice), first, first.cure);
        const std::vector<Setup> bases = bases_in_order(choice);
        if (std::optional<HeldSetup> held = on_another_base(bases)) return std::move(*held);
        for (const Setup& setup : bases) {
            if (std::optional<HeldSetup> held = with_other_directions(setup)) return std::move(*held);
        }
        return refused(std::move(choice), std::move(first));
    }

 private:
    static HeldSetup taken(SetupChoice choice, WorkEnvelope envelope, EnvelopeCure cure) {
        envelope.cure = cure;
        choice.setups.front().placement = envelope.placement;
        return {std::move(choice), std::move(envelope)};
    }

    // What refuses the first direction is told, if it is not held alone: the others could be left out.
    HeldSetup refused(SetupChoice choice, WorkEnvelope first) {
        const Setup& setup = choice.setups.front();
        WorkEnvelope alone = place_block(setup, {poses_of(setup).front()}, cell_, {}, context_);
        if (!alone.holds()) first = std::move(alone);
        first.cure = options_.setup.base ? EnvelopeCure::base : EnvelopeCure::cut;
        return {std::move(choice), std::move(first)};
    }

    // The best one first, those that would leave too much out of reach last.
    std::vector<Setup> bases_in_order(const SetupChoice& choice) const {
        std::vector<Setup> bases{choice.setups.front()};
        if (options_.setup.base) return bases;
        for (std::size_t i = 1; i < choice.setups.size(); ++i) {
            if (check_envelope(choice.setups[i], cell_).fits()) bases.push_back(choice.setups[i]);
        }
        std::stable_partition(bases.begin() + 1, bases.end(),
                              [&](const Setup& s) { return is_good(s, bases.front()); });
        return bases;
    }

    bool is_good(const Setup& setup, const Setup& best) const {
        return setup.reach.unreachable_share() <= std::max(options_.max_unreachable, best.reach.unreachable_share());
    }

    std::optional<HeldSetup> on_another_base(const std::vector<Setup>& bases) {
        for (std::size_t i = 1; i < bases.size() && is_good(bases[i], bases.front()); ++i) {
            if (!first_place(bases[i], poses_of(bases[i]), cell_, {}, context_)) continue;
            if (std::optional<HeldSetup> held = chosen_again(bases[i].base_number, {}, EnvelopeCure::base)) return held;
        }
        return std::nullopt;
    }

    std::optional<HeldSetup> with_other_directions(const Setup& setup) {
        std::vector<Vec3> kept;
        std::vector<Vec3> refused;
        if (!divide_directions(setup, poses_of(setup), kept, refused)) return std::nullopt;
        const auto is_not_refused = [&](Vec3 direction) { return !contains(refused, direction); };
        for (int trial = 0; trial < replacements; ++trial) {
            SetupChoice choice = chosen(setup.base_number, is_not_refused);
            const Setup& other = choice.setups.front();
            const std::vector<DirectionPoses> poses = carving_poses(other, *piece_.mesh, cell_);
            if (first_place(other, poses, cell_, {}, context_)) {
                WorkEnvelope envelope = place_block(other, poses, cell_, {}, context_);
                if (envelope.holds()) return taken(std::move(choice), std::move(envelope), EnvelopeCure::directions);
            }
            kept.clear();
            if (!divide_directions(other, poses, kept, refused)) return std::nullopt;
        }
        const auto is_kept = [&](Vec3 direction) { return contains(kept, direction); };
        return chosen_again(setup.base_number, is_kept, EnvelopeCure::directions);
    }

    // Of the directions those that are held together at some place, and, added to `refused`, the others; false if not
    // even the first is held.
    bool divide_directions(const Setup& setup, const std::vector<DirectionPoses>& poses, std::vector<Vec3>& kept,
                           std::vector<Vec3>& refused) const {
        std::vector<DirectionPoses> together;
        BlockPlacement place;
        for (std::size_t d = 0; d < poses.size(); ++d) {
            together.push_back(poses[d]);
            std::optional<BlockPlacement> found = first_place(setup, together, cell_, place, context_);
            if (!found && d == 0) return false;
            if (!found) together.pop_back();
            (found ? kept : refused).push_back(setup.reach.directions[d].out);
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

    std::optional<HeldSetup> chosen_again(int base, const std::function<bool(Vec3)>& is_allowed, EnvelopeCure cure) {
        SetupChoice choice = chosen(base, is_allowed);
        WorkEnvelope envelope = place_block(choice.setups.front(), *piece_.mesh, cell_, {}, context_);
        if (!envelope.holds()) return std::nullopt;
        return taken(std::move(choice), std::move(envelope), cure);
    }

    WorkEnvelope placed(const Setup& setup) { return place_block(setup, poses_of(setup), cell_, {}, context_); }

    const std::vector<DirectionPoses>& poses_of(const Setup& setup) {
        const auto known = poses_.find(setup.base_number);
        if (known != poses_.end()) return known->second;
        return poses_[setup.base_number] = carving_poses(setup, *piece_.mesh, cell_);
    }

    const Piece& piece_;
    const Cell& cell_;
    const HeldOptions& options_;
    const Context& context_;
    std::map<int, std::vector<DirectionPoses>> poses_;  // by the number of the base
};

}  // namespace

HeldSetup held_setup(const Piece& piece, SetupChoice choice, const Cell& cell, const HeldOptions& options,
                     const Context& context) {
    assert(!choice.setups.empty());
    return HeldSearch(piece, cell, options, context).run(std::move(choice));
}

}  // namespace qchopper
