// The cost is that of choose_setup() for each piece that is new, for placed() also that of reachable_setup().
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
// Tests: tests/app/jobs/setups_test.cpp, APieceWhoseShaftIsDeeperThanTheToolIsLongCannotBeMilled and
// AHighPieceThatTheToolReachesFromItsSidesCanBeMilled.

#include "app/jobs/setups.h"

#include <algorithm>
#include <utility>

#include "app/jobs/unreachable_of.h"
#include "base/parallel.h"
#include "base/shared_progress.h"
#include "cam/cell/job_tools.h"
#include "cam/setup/blocks_needed.h"
#include "cam/setup/limiting_tools.h"
#include "cam/setup/reachable_setup.h"
#include "segment/access/piece_access.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

// Of a piece's surface; what more of it arm, holder and spindle keep out of reach is a reason to cut the piece.
constexpr double max_by_machine = 0.02;

template <class T, class Make>
const T& once(std::optional<T>& known, const Make& make) {
    if (!known) known = make();
    return *known;
}

UnreachableSurface unreachable_surface(const Setup& setup) {
    return {setup.access.unreachable_mm2(), setup.access.unreachable_share(), setup.access.allowed_mm2};
}

}  // namespace

void Setups::set_orders(std::vector<SetupOrder> orders) {
    if (orders == orders_) return;
    orders_ = std::move(orders);
    stages_.clear();
}

void Setups::set_tools(std::vector<std::uint16_t> tools) {
    if (tools == tools_) return;
    planned_ = with_tools(cell_, tools);
    tools_ = std::move(tools);
    stages_.clear();
}

void Setups::set_count_narrow(bool count_narrow) {
    if (count_narrow == count_narrow_) return;
    count_narrow_ = count_narrow;
    stages_.clear();
}

// Those of meshes that are gone are dropped before another is added.
Setups::Stages& Setups::stages_of(const Piece& piece) {
    const auto known = stages_.find(piece.mesh);
    if (known != stages_.end()) return known->second;
    std::erase_if(stages_, [](const auto& entry) { return entry.first.expired(); });
    return stages_[piece.mesh];
}

template <class Stage, class Make>
void Setups::compute(std::optional<Stage> Stages::*stage, const std::string& what, std::span<const Piece> pieces,
                     const Context& context, const Make& make) {
    std::vector<std::pair<const Piece*, Stages*>> missing;
    for (const Piece& piece : pieces) {
        Stages& stages = stages_of(piece);
        if (!(stages.*stage)) missing.emplace_back(&piece, &stages);
    }
    SharedProgress progress(context, what, missing.size());
    parallel_for(0, missing.size(), [&](std::size_t i) {
        context.check_cancelled();
        const auto [piece, stages] = missing[i];
        stages->*stage = make(*piece, *stages);
        progress.add(1);
    });
}

void Setups::map(std::span<const Piece> pieces, const Context& context) {
    compute(&Stages::mapped, "setups chosen", pieces, context,
            [&](const Piece& piece, const Stages&) { return mapped_of(piece); });
}

void Setups::place(std::span<const Piece> pieces, const Context& context) {
    map(pieces, context);
    Context quiet;  // several pieces at a time: places of one are no progress of all
    quiet.cancelled = context.cancelled;
    compute(&Stages::placed, "work envelopes judged", pieces, context,
            [&](const Piece& piece, const Stages& stages) { return placed_of(piece, *stages.mapped, quiet); });
}

const MappedSetup& Setups::mapped(const Piece& piece) {
    return once(stages_of(piece).mapped, [&] { return mapped_of(piece); });
}

const PlacedSetup& Setups::placed(const Piece& piece) {
    return once(stages_of(piece).placed, [&] { return placed_of(piece, mapped(piece), {}); });
}

void Setups::keep_only(std::span<const Piece> pieces) {
    for (auto& [mesh, stages] : stages_) {
        const bool is_kept = std::any_of(pieces.begin(), pieces.end(),
                                         [&known = mesh](const Piece& piece) { return known.lock() == piece.mesh; });
        if (is_kept) continue;
        stages.mapped.reset();
        stages.placed.reset();
    }
}

bool Setups::fits(const Piece& piece) {
    return once(stages_of(piece).fits, [&] { return fits_cell_and_machine(piece, planned_); });
}

UnreachableSurface Setups::unreachable(const Piece& piece) {
    return once(stages_of(piece).sampled, [&] { return sampled_of(piece); });
}

UnreachableSurface Setups::unreachable_without_holder(const Piece& piece) {
    return once(stages_of(piece).without_holder, [&] { return unreachable_of(max_tilt_deg(cell_))(piece); });
}

bool Setups::is_machinable(const Piece& piece) {
    return once(stages_of(piece).is_machinable, [&] { return find_whether_machinable(piece); });
}

bool Setups::find_whether_machinable(const Piece& piece) {
    if (!cell_.machine) return true;
    const double low = low_piece_height(planned_);
    const Vec3 size = oriented_box(piece.mesh->points).size();
    if (std::max({size.x, size.y, size.z}) <= low) return true;
    const auto is_low_enough = [&](const Setup& setup) {
        if (setup.box.max.z <= low) return true;
        return setup.access.unreachable_share() - unreachable_without_holder(piece).share <= max_by_machine;
    };
    if (!is_low_enough(mapped(piece).setup())) return false;
    const PlacedSetup& placed = this->placed(piece);
    return placed.fits() && is_low_enough(placed.setup());
}

UnreachableSurface Setups::sampled_of(const Piece& piece) const {
    SetupOptions options = options_for(piece);
    options.mapped = 0;
    options.takes_kept_samples = !count_narrow_;
    options.samples = PieceAccessOptions{}.samples;
    const SetupChoice choice = choose_setup(piece, with_tools(cell_, tools_for(piece)), options);
    return unreachable_surface(choice.setups.front());
}

const SetupOrder* Setups::order_for(const Piece& piece) const {
    const auto order =
        std::find_if(orders_.begin(), orders_.end(), [&](const SetupOrder& o) { return o.piece == piece.name; });
    return order == orders_.end() ? nullptr : &*order;
}

UnreachableSurface Setups::left_by_setup(const Piece& piece) {
    return unreachable_surface(placed(piece).setup());
}

double Setups::min_gain_mm2() const {
    const double side = 4 * limiting_tools(planned_).smallest_radius;
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

MappedSetup Setups::with_stock_fit(SetupChoice choice, const Piece& piece, const Cell& planned) const {
    for (Setup& setup : choice.setups) setup.tools = tools_for(piece);
    StockFit fit = check_stock_fit(choice.setups.front(), planned);
    return {std::move(choice), std::move(fit)};
}

MappedSetup Setups::mapped_of(const Piece& piece) const {
    const Cell planned = with_tools(cell_, tools_for(piece));
    return with_stock_fit(choose_setup(piece, planned, options_for(piece)), piece, planned);
}

PlacedSetup Setups::placed_of(const Piece& piece, const MappedSetup& mapped, const Context& context) const {
    if (!cell_.machine) return {mapped, {}};
    const Cell planned = with_tools(cell_, tools_for(piece));
    const ReachableSetupOptions options{options_for(piece), cell_.machine->max_unreachable};
    ReachableSetup reachable = reachable_setup(piece, mapped.choice, planned, options, context);
    return {with_stock_fit(std::move(reachable.choice), piece, planned), std::move(reachable.reachability)};
}

}  // namespace qchopper
