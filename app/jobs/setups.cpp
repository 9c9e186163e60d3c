// The cost is that of choose_setup() for each piece that is new, for placed() also that of reachable_setup().
//
// What arm and tools cannot mill is cut again (is_machinable). That a block fits and that the arm holds the extreme
// poses above it says nothing of tilted directions and of the holder. So where pieces are cut for size, a piece that
// fits the cell gets its setup, with holder, height fields and work envelope, during the search. It is finished if the
// machine holds every pose of that setup, and either the block is no higher than the longest tool is long (stick-out)
// or at most 2 points more of its surface are out of reach than for a tool without holder that tilts in all directions
// (max_by_machine). Else it is cut by the planes that need the fewest blocks no higher than that tool; a piece no
// longer than the tool is taken as it is, because cutting it further is no remedy. Accepted setups are those of the
// jobs, so only pieces that are cut further cost more: 0.5 to 3 s for one that is refused. Where the cell has tools of
// one kind with several stick-outs, that is asked with each set of tools (tool_sets()) until one is good enough, longer
// ones are taken where they leave noticeably less out of reach, and pieces are cut for the shortest.
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
#include "base/timings.h"
#include "cam/cell/job_tools.h"
#include "cam/setup/blocks_needed.h"
#include "cam/setup/limiting_tools.h"
#include "cam/setup/placement/place_block.h"
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

MappedSetup with_stock_fit(SetupChoice choice, const ToolNumbers& tools, const Cell& planned) {
    for (Setup& setup : choice.setups) setup.tools = tools;
    StockFit fit = check_stock_fit(choice.setups.front(), planned);
    return {std::move(choice), std::move(fit)};
}

UnreachableSurface unreachable_surface(const Setup& setup) {
    return {setup.access.unreachable_mm2(), setup.access.unreachable_share(), setup.access.allowed_mm2};
}

// Where no kind of tool has several stick-outs, the tools as they were ordered.
std::vector<ToolNumbers> sets_of(const Cell& planned, const ToolNumbers& ordered) {
    if (!planned.machine) return {ordered};
    std::vector<ToolNumbers> sets = tool_sets(planned.machine->tools);
    if (sets.size() == 1) sets.front() = ordered;
    return sets;
}

}  // namespace

std::optional<PlacedSetup> placed_at(const PlacedSetup& known, const Piece& piece, const Cell& cell,
                                     const BlockPlacement& place) {
    const std::size_t angles = place.table_angles.size();
    if (angles != 0 && angles != known.setup().access.orientations.size()) return std::nullopt;
    PlacedSetup other = known;
    other.choice.setups.front().placement = place;
    PlacementOptions options;
    options.is_searched = false;
    other.machine_reachability = place_block(other.setup(), *piece.mesh, cell, options);
    other.machine_reachability.remedy = known.machine_reachability.remedy;
    if (!other.fits()) return std::nullopt;
    return other;
}

Setups::Setups(Cell cell) : cell_(std::move(cell)), planned_(cell_), tool_sets_(sets_of(planned_, tools_)) {}

Cell Setups::with_shortest_tools() const {
    return with_tools(planned_, tool_sets_.front());
}

void Setups::set_orders(std::vector<SetupOrder> orders) {
    if (orders == orders_) return;
    orders_ = std::move(orders);
    stages_.clear();
}

void Setups::set_places(std::map<std::string, BlockPlacement> places) {
    const auto of = [](const std::map<std::string, BlockPlacement>& all, const std::string& name) {
        const auto found = all.find(name);
        return found == all.end() ? std::nullopt : std::optional(found->second);
    };
    for (auto& [mesh, stages] : stages_) {
        if (of(places, stages.name) != of(places_, stages.name)) stages.placed.reset();
    }
    places_ = std::move(places);
}

void Setups::set_tools(ToolNumbers tools) {
    if (tools == tools_) return;
    planned_ = with_tools(cell_, tools);
    tools_ = std::move(tools);
    tool_sets_ = sets_of(planned_, tools_);
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
    Stages& stages = stages_[piece.mesh];
    stages.name = piece.name;
    return stages;
}

Setups::Stages& Setups::known_stages_of(const Piece& piece) {
    Stages& stages = stages_of(piece);
    if (!stages.bases) stages.bases = std::make_shared<const std::vector<PieceBase>>(bases_of(piece));
    return stages;
}

std::shared_ptr<const std::vector<PieceBase>> Setups::known_bases(const Piece& piece) const {
    const auto stages = stages_.find(piece.mesh);
    return stages == stages_.end() ? nullptr : stages->second.bases;
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
        known_stages_of(*piece);  // which are made
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
    return once(known_stages_of(piece).mapped, [&] { return mapped_of(piece); });
}

const PlacedSetup& Setups::placed(const Piece& piece) {
    return once(stages_of(piece).placed, [&] { return placed_of(piece, mapped(piece), {}); });
}

void Setups::know(const Piece& piece, PlacedSetup setup) {
    Stages& stages = stages_of(piece);
    stages.mapped = setup;
    stages.placed = std::move(setup);
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

// Precondition: its bases are known.
bool Setups::find_whether_fits(const Piece& piece) const {
    const std::vector<ToolNumbers> sets = tool_sets_for(piece);
    return std::any_of(sets.begin(), sets.end(), [&](const ToolNumbers& tools) {
        return fits_cell_and_machine(piece, with_tools(cell_, tools), *known_bases(piece));
    });
}

bool Setups::fits(const Piece& piece) {
    return once(known_stages_of(piece).fits, [&] { return find_whether_fits(piece); });
}

// Functions that are called in parallel find the stages of their piece made, and change no others.
void Setups::work_out(std::span<const Piece> pieces, const AskedOfPieces& asked, Timings* timings) {
    std::vector<Piece> left(pieces.begin(), pieces.end());
    StageTimer stage(timings, "blocks chosen");
    if (asked.fits_cell) {
        compute(&Stages::fits, {}, left, {}, [&](const Piece& p, const Stages&) { return find_whether_fits(p); });
        std::erase_if(left, [&](const Piece& piece) { return !fits(piece); });
    }
    stage.next("setups of pieces that fit");
    if (asked.is_machinable) {
        compute(&Stages::is_machinable, {}, left, {},
                [&](const Piece& p, const Stages&) { return find_whether_machinable(p); });
        std::erase_if(left, [&](const Piece& piece) { return !is_machinable(piece); });
    }
    stage.next("surface out of reach");
    if (asked.unreachable) {
        compute(&Stages::sampled, {}, left, {}, [&](const Piece& p, const Stages&) { return sampled_of(p); });
    }
}

UnreachableSurface Setups::unreachable(const Piece& piece) {
    return once(known_stages_of(piece).sampled, [&] { return sampled_of(piece); });
}

UnreachableSurface Setups::unreachable_without_holder(const Piece& piece) {
    return once(stages_of(piece).without_holder, [&] { return unreachable_of(max_tilt_deg(cell_))(piece); });
}

bool Setups::is_machinable(const Piece& piece) {
    return once(stages_of(piece).is_machinable, [&] { return find_whether_machinable(piece); });
}

bool Setups::refuse_with_long_tools(const Piece& piece) {
    const std::vector<ToolNumbers> sets = tool_sets_for(piece);
    if (sets.size() == 1 || placed(piece).setup().tools == sets.front()) return false;
    return std::exchange(stages_of(piece).is_machinable, false) != false;
}

bool Setups::find_whether_machinable(const Piece& piece) {
    if (!cell_.machine) return true;
    const Vec3 size = oriented_box(piece.mesh->points).size();
    const auto low = [&](const ToolNumbers& tools) { return low_piece_height(with_tools(cell_, tools)); };
    if (std::max({size.x, size.y, size.z}) <= low(tool_sets_for(piece).front())) return true;
    const auto is_low_enough = [&](const Setup& setup) {
        if (setup.box.max.z <= low(setup.tools)) return true;
        return setup.access.unreachable_share() - unreachable_without_holder(piece).share <= max_by_machine;
    };
    if (!is_low_enough(mapped(piece).setup())) return false;
    const PlacedSetup& placed = this->placed(piece);
    return placed.fits() && is_low_enough(placed.setup());
}

// With the first set of tools that leaves no more out of reach than may be. If none does: with the longer ones of two
// where they leave less by an area that is noticed.
UnreachableSurface Setups::sampled_of(const Piece& piece) const {
    SetupOptions options = options_for(piece);
    options.mapped = 0;
    options.takes_kept_samples = !count_narrow_;
    options.samples = PieceAccessOptions{}.samples;
    std::optional<UnreachableSurface> best;
    for (const ToolNumbers& tools : tool_sets_for(piece)) {
        const SetupChoice choice = choose_setup(piece, with_tools(cell_, tools), options);
        const UnreachableSurface own = unreachable_surface(choice.setups.front());
        if (!best || own.mm2 + min_gain_mm2() <= best->mm2) best = own;
        if (is_good(choice.setups.front())) break;
    }
    return *best;
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
    options.bases = known_bases(piece);
    const SetupOrder* order = order_for(piece);
    if (order == nullptr) return options;
    options.base = order->base;
    options.max_directions = order->max_directions.value_or(options.max_directions);
    return options;
}

std::vector<ToolNumbers> Setups::tool_sets_for(const Piece& piece) const {
    const SetupOrder* order = order_for(piece);
    if (order == nullptr || order->tools.empty()) return tool_sets_;
    return sets_of(with_tools(cell_, order->tools), order->tools);
}

bool Setups::is_good(const Setup& setup) const {
    return !cell_.machine || !setup.access.exceeds(cell_.machine->max_unreachable);
}

bool Setups::is_worth(const Setup& other, bool other_fits, const Setup& setup, bool fits) const {
    if (other_fits != fits) return other_fits;
    return other.access.unreachable_mm2() + min_gain_mm2() <= setup.access.unreachable_mm2();
}

MappedSetup Setups::mapped_with(const ToolNumbers& tools, const Piece& piece) const {
    const Cell planned = with_tools(cell_, tools);
    return with_stock_fit(choose_setup(piece, planned, options_for(piece)), tools, planned);
}

// Of the sets of tools as in sampled_of(), if the block fits.
MappedSetup Setups::mapped_of(const Piece& piece) const {
    const std::vector<ToolNumbers> sets = tool_sets_for(piece);
    MappedSetup best = mapped_with(sets.front(), piece);
    for (std::size_t i = 1; i < sets.size() && !(best.stock_fit.fits() && is_good(best.setup())); ++i) {
        MappedSetup longer = mapped_with(sets[i], piece);
        if (is_worth(longer.setup(), longer.stock_fit.fits(), best.setup(), best.stock_fit.fits())) {
            best = std::move(longer);
        }
    }
    return best;
}

PlacedSetup Setups::placed_with(const MappedSetup& mapped, const Piece& piece, const Context& context) const {
    const ToolNumbers& tools = mapped.setup().tools;
    const Cell planned = with_tools(cell_, tools);
    const ReachableSetupOptions options{options_for(piece), cell_.machine->max_unreachable};
    ReachableSetup reachable = reachable_setup(piece, mapped.choice, planned, options, context);
    return {with_stock_fit(std::move(reachable.choice), tools, planned), std::move(reachable.reachability)};
}

// With other tools where the arm does not hold every pose with those of the mapped setup, or only with too much out of
// reach.
PlacedSetup Setups::placed_of(const Piece& piece, const MappedSetup& mapped, const Context& context) const {
    if (!cell_.machine) return {mapped, {}};
    PlacedSetup best = placed_with(mapped, piece, context);
    for (const ToolNumbers& tools : tool_sets_for(piece)) {
        if (best.fits() && is_good(best.setup())) break;
        if (tools == mapped.setup().tools) continue;
        PlacedSetup other = placed_with(mapped_with(tools, piece), piece, context);
        if (is_worth(other.setup(), other.fits(), best.setup(), best.fits())) best = std::move(other);
    }
    const auto place = places_.find(piece.name);
    if (place == places_.end() || !best.fits()) return best;
    const Cell planned = with_tools(cell_, best.setup().tools);
    return placed_at(best, piece, planned, place->second).value_or(std::move(best));
}

}  // namespace qchopper
