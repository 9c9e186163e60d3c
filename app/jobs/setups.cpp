// The cost is that of choose_setup() for each piece that is new, for held() also that of reachable_setup().
//
// What arm and tools cannot mill is cut again (is_machinable). That a block fits and that the arm holds the extreme
// poses above it says nothing of tilted directions and of the holder. So where pieces are cut for size, a piece that
// fits the cell gets its setup, with holder, height fields and work envelope, during the search. It is finished if the
// machine holds every pose of that setup, and either the block is no higher than the longest tool is long (stick-out)
// or at most 2 points more of its surface are out of reach than for a tool without holder that tilts in all directions
// (max_by_machine). Else it is cut by the planes that need the fewest blocks no higher than that tool; a piece no
// longer than the tool is taken as it is, because cutting it further is no remedy. Accepted setups are those of the
// jobs, so only pieces that are cut further cost more: 0.5 to 3 s for one that is refused.
//
// Of the bunny at 1.5 m in kr60-ha it made 48 pieces in place of 16, with 1.8 % in place of 22.8 % of the surface out
// of reach and none that cannot be milled. A largest height in the cell file would be wrong for every convex piece; a
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
#include "cam/setup/reachable_setup.h"
#include "segment/access/piece_access.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

// Of a piece's surface; what more of it arm, holder and spindle keep out of reach is a reason to cut the piece.
constexpr double max_by_machine = 0.02;

}  // namespace

void Setups::set_orders(std::vector<SetupOrder> orders) {
    if (orders == orders_) return;
    orders_ = std::move(orders);
    piece_setups_.clear();
    held_.clear();
    machinable_.clear();
}

void Setups::set_tools(std::vector<std::uint16_t> tools) {
    if (tools == tools_) return;
    planned_ = with_tools(cell_, tools);
    tools_ = std::move(tools);
    piece_setups_.clear();
    held_.clear();
    fits_.clear();
    machinable_.clear();
}

void Setups::set_count_narrow(bool count_narrow) {
    if (count_narrow == count_narrow_) return;
    count_narrow_ = count_narrow;
    piece_setups_.clear();
    held_.clear();
    machinable_.clear();
}

void Setups::compute(std::span<const Piece> pieces, const Context& context) {
    std::vector<const Piece*> missing;
    for (const Piece& piece : pieces) {
        if (!piece_setups_.contains(piece.mesh.get())) missing.push_back(&piece);
    }
    SharedProgress progress(context, "setups chosen", missing.size());
    std::mutex changing;
    parallel_for(0, missing.size(), [&](std::size_t i) {
        context.check_cancelled();
        PieceSetup piece_setup = piece_setup_of(*missing[i]);
        const std::lock_guard lock(changing);
        piece_setups_[missing[i]->mesh.get()] = std::move(piece_setup);
        progress.add(1);
    });
}

const PieceSetup& Setups::of(const Piece& piece) {
    const auto [it, is_new] = piece_setups_.try_emplace(piece.mesh.get());
    if (is_new) it->second = piece_setup_of(piece);
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
        PieceSetup piece_setup = held_of(piece, piece_setups_.at(piece.mesh.get()), quiet);
        const std::lock_guard lock(changing);
        held_[piece.mesh.get()] = std::move(piece_setup);
        progress.add(1);
    });
}

const PieceSetup& Setups::held(const Piece& piece) {
    const auto known = held_.find(piece.mesh.get());
    if (known != held_.end()) return known->second;
    return held_[piece.mesh.get()] = held_of(piece, of(piece), {});
}

void Setups::keep_only(std::span<const Piece> pieces) {
    for (PieceSetups* piece_setups : {&piece_setups_, &held_}) {
        std::erase_if(*piece_setups, [&](const auto& piece_setup) {
            return std::none_of(pieces.begin(), pieces.end(),
                                [&](const Piece& piece) { return piece.mesh.get() == piece_setup.first; });
        });
    }
}

bool Setups::fits(const Piece& piece) {
    Answer& known = fits_[piece.mesh.get()];
    if (known.mesh.expired()) known = {piece.mesh, fits_cell_and_machine(piece, planned_)};
    return known.is_yes;
}

bool Setups::is_machinable(const Piece& piece) {
    Answer& known = machinable_[piece.mesh.get()];
    if (known.mesh.expired()) known = {piece.mesh, find_whether_machinable(piece)};
    return known.is_yes;
}

// The setup is kept only of a piece that is not cut further.
bool Setups::find_whether_machinable(const Piece& piece) {
    if (!cell_.machine) return true;
    const double low = low_piece_height(planned_);
    const Vec3 size = oriented_box(piece.mesh->points).size();
    if (std::max({size.x, size.y, size.z}) <= low) return true;
    const auto is_low_enough = [&](const PieceSetup& piece_setup) {
        if (piece_setup.setup().box.max.z <= low) return true;
        const double of_tilt = unreachable_of(max_tilt_deg(cell_))(piece).share;
        return piece_setup.setup().access.unreachable_share() - of_tilt <= max_by_machine;
    };
    PieceSetup best = piece_setup_of(piece);
    PieceSetup held = is_low_enough(best) ? held_of(piece, best, {}) : PieceSetup{};
    if (!held.mesh || !held.fits() || !is_low_enough(held)) return false;
    piece_setups_[piece.mesh.get()] = std::move(best);
    held_[piece.mesh.get()] = std::move(held);
    return true;
}

UnreachableSurface Setups::unreachable(const Piece& piece) {
    SetupOptions options = options_for(piece);
    options.mapped = 0;
    options.takes_kept_samples = !count_narrow_;
    options.samples = PieceAccessOptions{}.samples;
    const SetupChoice choice = choose_setup(piece, with_tools(cell_, tools_for(piece)), options);
    const SurfaceAccess& access = choice.setups.front().access;
    return {access.unreachable_mm2(), access.unreachable_share()};
}

const SetupOrder* Setups::order_for(const Piece& piece) const {
    const auto order =
        std::find_if(orders_.begin(), orders_.end(), [&](const SetupOrder& o) { return o.piece == piece.name; });
    return order == orders_.end() ? nullptr : &*order;
}

UnreachableSurface Setups::left_by_setup(const Piece& piece) {
    const SurfaceAccess& access = held(piece).setup().access;
    return {access.unreachable_mm2(), access.unreachable_share()};
}

double Setups::min_gain_mm2() const {
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

PieceSetup Setups::piece_setup_of(const Piece& piece) const {
    const Cell planned = with_tools(cell_, tools_for(piece));
    PieceSetup piece_setup{choose_setup(piece, planned, options_for(piece)), {}, piece.mesh};
    for (Setup& setup : piece_setup.choice.setups) setup.tools = tools_for(piece);
    piece_setup.stock_fit = check_stock_fit(piece_setup.setup(), planned);
    return piece_setup;
}

PieceSetup Setups::held_of(const Piece& piece, const PieceSetup& best, const Context& context) const {
    if (!cell_.machine) return best;
    const Cell planned = with_tools(cell_, tools_for(piece));
    const ReachableSetupOptions options{options_for(piece), cell_.machine->max_unreachable};
    ReachableSetup held = reachable_setup(piece, best.choice, planned, options, context);
    PieceSetup piece_setup{std::move(held.choice), {}, piece.mesh, std::move(held.reachability)};
    for (Setup& setup : piece_setup.choice.setups) setup.tools = tools_for(piece);
    piece_setup.stock_fit = check_stock_fit(piece_setup.setup(), planned);
    return piece_setup;
}

}  // namespace qchopper
