// The cost is that of choose_setup() for each piece that is new, for held() also that of held_setup().
//
// What arm and tools cannot carve is cut again (is_carvable). That a block fits and that the arm holds the extreme
// poses above it says nothing of tilted directions and of the holder. So where pieces are cut for size, a piece that
// fits the cell gets its setup, with holder, height maps and work envelope, during the search. It is finished if the
// machine holds every pose of that setup, and either the block is no higher than the longest tool is long (stick-out)
// or at most 2 points more of its surface are out of reach than for a tool without holder that tilts in all directions
// (most_by_machine). Else it is cut by the planes that need the fewest blocks no higher than that tool; a piece no
// longer than the tool is taken as it is, because cutting it further is no remedy. Accepted setups are those of the
// jobs, so only pieces that are cut further cost more: 0.5 to 3 s for one that is refused.
//
// Of the bunny at 1.5 m in kr60-ha it made 48 pieces in place of 16, with 1.8 % in place of 22.8 % of the surface out
// of reach and none that cannot be carved. A largest height in the cell file would be wrong for every convex piece; a
// term of the objectives would need the setup of every plane, some thousand times the cost.
// Tests: tests/app/jobs/setups_test.cpp, APieceWhoseShaftIsDeeperThanTheToolIsLongCannotBeCarved and
// AHighPieceThatTheToolReachesFromItsSidesCanBeCarved.

#include "app/jobs/setups.h"

#include <algorithm>
#include <mutex>

#include "app/jobs/unreachable_of.h"
#include "base/parallel.h"
#include "base/shared_progress.h"
#include "cam/cell/allowed_tools.h"
#include "cam/setup/blocks_needed.h"
#include "cam/setup/held_setup.h"
#include "segment/access/piece_reach.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

// Of a piece's surface; what more of it arm, holder and spindle keep out of reach is a reason to cut the piece.
constexpr double most_by_machine = 0.02;

}  // namespace

void Setups::set_orders(std::vector<SetupOrder> orders) {
    if (orders == orders_) return;
    orders_ = std::move(orders);
    carvings_.clear();
    held_.clear();
    carvable_.clear();
}

void Setups::set_tools(std::vector<std::uint16_t> tools) {
    if (tools == tools_) return;
    planned_ = with_tools(cell_, tools);
    tools_ = std::move(tools);
    carvings_.clear();
    held_.clear();
    fits_.clear();
    carvable_.clear();
}

void Setups::set_count_narrow(bool count_narrow) {
    if (count_narrow == count_narrow_) return;
    count_narrow_ = count_narrow;
    carvings_.clear();
    held_.clear();
    carvable_.clear();
}

void Setups::compute(std::span<const Piece> pieces, const Context& context) {
    std::vector<const Piece*> missing;
    for (const Piece& piece : pieces) {
        if (!carvings_.contains(piece.mesh.get())) missing.push_back(&piece);
    }
    SharedProgress progress(context, "setups chosen", missing.size());
    std::mutex changing;
    parallel_for(0, missing.size(), [&](std::size_t i) {
        context.check_cancelled();
        Carving carving = carving_of(*missing[i]);
        const std::lock_guard lock(changing);
        carvings_[missing[i]->mesh.get()] = std::move(carving);
        progress.add(1);
    });
}

const Carving& Setups::of(const Piece& piece) {
    const auto [it, is_new] = carvings_.try_emplace(piece.mesh.get());
    if (is_new) it->second = carving_of(piece);
    return it->second;
}

void Setups::compute_held(std::span<const Piece> pieces, const Context& context) {
    compute(pieces, context);
    std::vector<const Piece*> missing;
    for (const Piece& piece : pieces) {
        if (!held_.contains(piece.mesh.get())) missing.push_back(&piece);
    }
    SharedProgress progress(context, "work envelopes judged", missing.size());
    std::mutex changing;
    Context quiet;  // several pieces at a time: places of one are no progress of all
    quiet.cancelled = context.cancelled;
    parallel_for(0, missing.size(), [&](std::size_t i) {
        context.check_cancelled();
        const Piece& piece = *missing[i];
        Carving carving = held_of(piece, carvings_.at(piece.mesh.get()), quiet);
        const std::lock_guard lock(changing);
        held_[piece.mesh.get()] = std::move(carving);
        progress.add(1);
    });
}

const Carving& Setups::held(const Piece& piece) {
    const auto known = held_.find(piece.mesh.get());
    if (known != held_.end()) return known->second;
    return held_[piece.mesh.get()] = held_of(piece, of(piece), {});
}

void Setups::keep_only(std::span<const Piece> pieces) {
    for (Carvings* carvings : {&carvings_, &held_}) {
        std::erase_if(*carvings, [&](const auto& carving) {
            return std::none_of(pieces.begin(), pieces.end(),
                                [&](const Piece& piece) { return piece.mesh.get() == carving.first; });
        });
    }
}

bool Setups::fits(const Piece& piece) {
    Answer& known = fits_[piece.mesh.get()];
    if (known.mesh.expired()) known = {piece.mesh, fits_cell_and_machine(piece, planned_)};
    return known.is_yes;
}

bool Setups::is_carvable(const Piece& piece) {
    Answer& known = carvable_[piece.mesh.get()];
    if (known.mesh.expired()) known = {piece.mesh, find_whether_carvable(piece)};
    return known.is_yes;
}

// The setup is kept only of a piece that is not cut further.
bool Setups::find_whether_carvable(const Piece& piece) {
    if (!cell_.machine) return true;
    const double low = low_piece_height(planned_);
    const Vec3 size = oriented_box(piece.mesh->points).size();
    if (std::max({size.x, size.y, size.z}) <= low) return true;
    const auto is_low_enough = [&](const Carving& carving) {
        if (carving.setup().box.max.z <= low) return true;
        const double of_tilt = unreachable_of(max_tilt_deg(cell_))(piece).share;
        return carving.setup().reach.unreachable_share() - of_tilt <= most_by_machine;
    };
    Carving best = carving_of(piece);
    Carving held = is_low_enough(best) ? held_of(piece, best, {}) : Carving{};
    if (!held.mesh || !held.fits() || !is_low_enough(held)) return false;
    carvings_[piece.mesh.get()] = std::move(best);
    held_[piece.mesh.get()] = std::move(held);
    return true;
}

UnreachableSurface Setups::unreachable(const Piece& piece) {
    SetupOptions options = options_for(piece);
    options.mapped = 0;
    options.takes_kept_samples = !count_narrow_;
    options.samples = PieceReachOptions{}.samples;
    const SetupChoice choice = choose_setup(piece, with_tools(cell_, tools_for(piece)), options);
    const SurfaceReach& reach = choice.setups.front().reach;
    return {reach.unreachable_mm2(), reach.unreachable_share()};
}

const SetupOrder* Setups::order_for(const Piece& piece) const {
    const auto order =
        std::find_if(orders_.begin(), orders_.end(), [&](const SetupOrder& o) { return o.piece == piece.name; });
    return order == orders_.end() ? nullptr : &*order;
}

UnreachableSurface Setups::left_by_setup(const Piece& piece) {
    const SurfaceReach& reach = held(piece).setup().reach;
    return {reach.unreachable_mm2(), reach.unreachable_share()};
}

double Setups::least_gain_mm2() const {
    const double side = 4 * smallest_radius(planned_);
    return side * side;
}

SetupOptions Setups::options_for(const Piece& piece) const {
    SetupOptions options;
    options.count_narrow = count_narrow_;
    const SetupOrder* order = order_for(piece);
    if (order == nullptr) return options;
    options.base = order->base;
    options.max_directions = order->max_directions.value_or(options.max_directions);
    return options;
}

const std::vector<std::uint16_t>& Setups::tools_for(const Piece& piece) const {
    const SetupOrder* order = order_for(piece);
    return order != nullptr && !order->tools.empty() ? order->tools : tools_;
}

Carving Setups::carving_of(const Piece& piece) const {
    const Cell planned = with_tools(cell_, tools_for(piece));
    Carving carving{choose_setup(piece, planned, options_for(piece)), {}, piece.mesh};
    for (Setup& setup : carving.choice.setups) setup.tools = tools_for(piece);
    carving.envelope = check_envelope(carving.setup(), planned);
    return carving;
}

Carving Setups::held_of(const Piece& piece, const Carving& best, const Context& context) const {
    if (!cell_.machine) return best;
    const Cell planned = with_tools(cell_, tools_for(piece));
    const HeldOptions options{options_for(piece), cell_.machine->max_unreachable};
    HeldSetup held = held_setup(piece, best.choice, planned, options, context);
    Carving carving{std::move(held.choice), {}, piece.mesh, std::move(held.envelope)};
    for (Setup& setup : carving.choice.setups) setup.tools = tools_for(piece);
    carving.envelope = check_envelope(carving.setup(), planned);
    return carving;
}

}  // namespace qchopper
