// Every base is laid out in its block and judged on samples with its own few directions; the best ones are judged again
// by height fields, until the best of all is one of them. Rays of the samples (segment/access/piece_access.h) and
// O(directions x triangles) for each base that is mapped.

#include "cam/setup/choose_setup.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/units.h"
#include "cam/cell/job_tools.h"
#include "cam/setup/layout/lay_out.h"
#include "cam/setup/limiting_tools.h"
#include "cam/setup/mapped_access.h"
#include "cam/setup/paint_narrow.h"
#include "cam/setup/placement/place_block.h"
#include "cam/setup/reachable_directions.h"
#include "cam/setup/standing_sections.h"
#include "cam/setup/stock_fit.h"
#include "cam/setup/undercut.h"
#include "segment/access/piece_access.h"
#include "segment/access/tool_fit.h"
#include "segment/mesh/footprint.h"

namespace qchopper {
namespace {

// Shares that differ by less are equal for the choice of a base: about the error of the samples.
constexpr double equal_share = 0.001;

std::vector<std::int32_t> cuts_of(const std::vector<FlushCap>& caps) {
    std::vector<std::int32_t> cuts;
    cuts.reserve(caps.size());
    for (const FlushCap& cap : caps) cuts.push_back(cap.cut);
    return cuts;
}

// What may stay out of reach of a piece whatever its share: a square of two diameters of the ball that finishes after
// the largest one. Nothing where no block may be sawn.
double allowed_mm2(const Cell& cell) {
    if (!is_any_sawn(cell)) return 0;
    if (!cell.machine) return 4 * cell.tool.diameter * cell.tool.diameter;
    const std::vector<CuttingTool>& tools = cell.machine->tools;
    const double largest = tools[finishing_tool(tools, std::numeric_limits<double>::infinity())].diameter;
    const double diameter = tools[finishing_tool(tools, largest)].diameter;
    return 4 * diameter * diameter;
}

double tilt_of(const Cell& cell, const SetupOptions& options) {
    return options.max_tilt_deg.value_or(max_tilt_deg(cell));
}

double ignored_mm2(const TriangleMesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.ignored.size(); ++t) area += is_ignored(mesh, t) ? norm(area_vector(mesh, t)) : 0;
    return area;
}

ToolOrientation described(const ChosenDirection& chosen, const Setup& setup, double area_mm2) {
    ToolOrientation direction;
    direction.tool_axis = chosen.direction;
    direction.tilt_deg = std::acos(std::clamp(dot(chosen.direction, setup.up), -1.0, 1.0)) / degree;
    direction.gained_share = area_mm2 > 0 ? chosen.gained_mm2 / area_mm2 : 0;
    return direction;
}

double too_narrow_mm2(const ChosenDirections& directions, const std::vector<bool>& is_narrow, double area_each_mm2) {
    std::size_t count = 0;
    for (std::size_t row = 0; row < is_narrow.size(); ++row) {
        if (is_narrow[row] && directions.samples[row] == SampleAccess::reached) ++count;
    }
    return area_each_mm2 * static_cast<double>(count);
}

// Of what the maps found to be reached: what the holder keeps out is not counted a second time.
double too_narrow_mm2(const MappedAccess& mapped, const SurfaceSamples& samples, const std::vector<bool>& is_narrow) {
    double count = 0;
    for (std::size_t row = 0; row < is_narrow.size(); ++row) {
        if (is_narrow[row]) count += static_cast<double>(mapped.reached[samples.sample[row].triangle]);
    }
    const SurfaceAccess& access = mapped.access;
    const double reached_mm2 = access.area_mm2 - access.hidden_mm2 - access.steep_mm2 - access.holder_mm2;
    return std::min(samples.area_each_mm2 * count, std::max(0.0, reached_mm2));
}

// One piece while its setup is chosen.
class Choice {
 public:
    Choice(const Piece& piece, const Cell& cell, const SetupOptions& options)
        : piece_(piece),
          cell_(cell),
          options_(options),
          tools_(limiting_tools(cell)),
          bases_(options.bases ? *options.bases : bases_of(piece)) {
        allowed_mm2_ = allowed_mm2(cell);
        whole_mm2_ = area_mm2(*piece.mesh);
        const std::vector<CapPoints> caps = caps_to_saw(*piece.mesh, cell);
        for (PieceBase& base : bases_) {
            setups_.push_back(lay_out(piece, base, cell, caps));
            base.base.flush = cuts_of(setups_.back().flush_caps);
            add_workholding(setups_.back(), nullptr);
        }
    }

    SetupChoice run() {
        judge_on_samples();
        rank();
        std::map<int, std::vector<SurfaceState>> states;  // by the number of the base
        const auto judge = [&](Setup& setup) { states[setup.base_number] = judge_by_maps(setup); };
        // Samples know of no holder and no foam, so another base may turn out to be the better one.
        while (const auto next = next_to_map(states.size())) {
            judge(setups_[*next]);
            rank();
        }
        if (options_.mapped > 0) ask_dense(setups_.front());
        SetupChoice result;
        if (!states.empty()) result.states = std::move(states[setups_.front().base_number]);
        if (!result.states.empty())
            paint_narrow(*piece_.mesh, access_->samples->scan->samples, is_narrow_, result.states);
        result.setups = std::move(setups_);
        return result;
    }

 private:
    PieceAccessOptions access_options(bool asks_dense) const {
        return {tilt_of(cell_, options_),
                {options_.max_directions},
                options_.samples,
                options_.takes_kept_samples,
                asks_dense};
    }

    // Without the foam that stays, which only maps tell, a setup holds less.
    void add_workholding(Setup& setup, const StockPoints* stock_points) const {
        if (!cell_.machine) return;
        setup.workholding = check_workholding(standing_sections(*piece_.mesh, setup, stock_points), setup, cell_);
    }

    // Which directions the arm holds over a piece that lies on one of bases_.
    ReachableDirections held_of_base() const {
        return [this](const PieceBase& base, std::span<const Vec3> directions) {
            const auto laid = std::find_if(setups_.begin(), setups_.end(),
                                           [&](const Setup& s) { return s.base_number == base.number; });
            std::vector<Vec3> in_setup;
            for (const Vec3& d : directions) in_setup.push_back(rotate(laid->piece_in_setup, d));
            std::vector<std::uint8_t> held = reachable_directions(cell_, laid->box, laid->spoil, in_setup);
            for (std::size_t d = 0; options_.is_allowed && d < held.size(); ++d) {
                if (!options_.is_allowed(directions[d])) held[d] = 0;
            }
            return held;
        };
    }

    // Dense directions take the most time, so they are asked for the base that is taken alone.
    void ask_dense(Setup& setup) const {
        const auto base = std::find_if(bases_.begin(), bases_.end(),
                                       [&](const PieceBase& b) { return b.number == setup.base_number; });
        const BaseAccess access = base_access(*access_->samples, *base, access_options(true), held_of_base());
        describe_further(setup, access);
    }

    void describe_further(Setup& setup, const BaseAccess& of_base) const {
        const double area_mm2 = of_base.area_mm2;
        const double unreachable = of_base.directions.by_all.total_mm2(tilt_of(cell_, options_));
        setup.access.all_directions_share = area_mm2 > 0 ? unreachable / area_mm2 : 0;
        setup.access.further.reset();
        if (of_base.directions.further) setup.access.further = described(*of_base.directions.further, setup, area_mm2);
    }

    void judge_on_samples() {
        const PieceAccessOptions options = access_options(false);
        access_ = piece_access(piece_, bases_, options, held_of_base());
        const SampledScan& scan = *access_->samples->scan;
        is_narrow_.assign(scan.samples.sample.size(), false);
        if (options_.mapped > 0 || options_.count_narrow) {
            std::vector<bool> is_cap(piece_.mesh->triangles.size());
            for (std::size_t t = 0; t < is_cap.size(); ++t) is_cap[t] = cap_of(*piece_.mesh, t) != no_cap;
            is_narrow_ = too_narrow(*piece_.mesh, is_cap, scan.samples.sample, {tools_.smallest_radius, 0});
        }
        for (std::size_t i = 0; i < bases_.size(); ++i) fill(setups_[i], access_->bases[i], options.tilt_deg);
    }

    void fill(Setup& setup, const BaseAccess& of_base, double tilt_deg) const {
        const ChosenDirections& directions = of_base.directions;
        SurfaceAccess& access = setup.access;
        access.area_mm2 = of_base.area_mm2;
        access.ignored_mm2 = ignored_mm2(*piece_.mesh);
        access.allowed_mm2 = allowed_mm2_;
        for (const ChosenDirection& d : directions.chosen) {
            access.orientations.push_back(described(d, setup, access.area_mm2));
        }
        access.hidden_mm2 = directions.by_chosen.hidden_mm2 + directions.by_chosen.caps_mm2;
        access.steep_mm2 = directions.by_chosen.steep_mm2;
        access.too_narrow_mm2 = too_narrow_mm2(directions, is_narrow_, access_->samples->scan->samples.area_each_mm2);
        access.steep_counts = tilt_deg >= steep_counts_from_deg;
        access.narrow_counts = options_.count_narrow;
        describe_further(setup, of_base);
        access.is_arm_checked = cell_.machine.has_value();
        const Facing sums = facing(*piece_.mesh, setup.up, setup.base, cuts_of(setup.flush_caps));
        setup.undercut = sums.undercut();
        setup.undercut_by_count = sums.undercut_by_count();
    }

    std::vector<SurfaceState> judge_by_maps(Setup& setup) const {
        MappedAccess result = mapped_access(*piece_.mesh, setup, tools_, options_.map);
        SurfaceAccess& access = result.access;
        access.too_narrow_mm2 = too_narrow_mm2(result, access_->samples->scan->samples, is_narrow_);
        access.narrow_counts = setup.access.narrow_counts;
        access.all_directions_share = setup.access.all_directions_share;
        access.further = setup.access.further;
        access.allowed_mm2 = setup.access.allowed_mm2;
        access.is_arm_checked = setup.access.is_arm_checked;
        setup.access = std::move(access);
        add_workholding(setup, result.stock_points ? &*result.stock_points : nullptr);
        return std::move(result.states);
    }

    static long steps(double share) { return std::lround(share / equal_share); }
    // The largest share out of reach with which a setup is preferred for its workholding: the cell's limit, or that
    // of the setup that leaves least.
    double max_for_workholding() const {
        double least = 1;
        for (const Setup& s : setups_) {
            if (check_stock_fit(s, cell_).fits()) least = std::min(least, s.access.unreachable_share());
        }
        return cell_.machine ? std::max(cell_.machine->max_unreachable, least + equal_share) : least;
    }

    // Where blocks are sawn, the surface that counts differs from base to base, and more of it would make a share look
    // better: then areas are compared, of the area of the whole piece.
    long unreachable_steps(const Setup& s) const {
        return steps(allowed_mm2_ > 0 ? s.access.unreachable_mm2() / whole_mm2_ : s.access.unreachable_share());
    }
    // mm3: of the block, and what the area to mill counts for.
    static double foam_and_milling(const Setup& s) {
        const Vec3 size = s.block.size;
        return size.x * size.y * size.z + foam_per_milled_cap * s.access.area_mm2;
    }

    // What counts for the order before what only maps tell.
    auto before_foam(const Setup& s, double most) const {
        const bool holds = s.workholding && s.workholding->passes() && !s.access.exceeds(most);
        return std::tuple(options_.base != s.base_number, !check_stock_fit(s, cell_).fits(), !holds,
                          unreachable_steps(s));
    }

    // Index of the setup that is judged by maps next: the first, or one as good, as long as fewer are mapped than
    // wanted.
    std::optional<std::size_t> next_to_map(std::size_t mapped) const {
        if (options_.mapped == 0) return std::nullopt;
        if (setups_.front().access.method == AccessMethod::sampled) return 0;
        if (mapped >= options_.mapped) return std::nullopt;
        const auto next = std::find_if(setups_.begin(), setups_.end(),
                                       [](const Setup& s) { return s.access.method == AccessMethod::sampled; });
        const double most = max_for_workholding();
        if (next == setups_.end() || before_foam(*next, most) != before_foam(setups_.front(), most)) {
            return std::nullopt;
        }
        return static_cast<std::size_t>(next - setups_.begin());
    }

    // Equal shares are compared as whole steps, because a comparison with a tolerance is no order. Of two, what is
    // known by maps comes first: of samples no foam is known.
    void rank() {
        const double most = max_for_workholding();
        const auto key = [&](const Setup& s) {
            const Vec3 size = s.block.size;
            const double block_mm3 = size.x * size.y * size.z;
            return std::tuple_cat(
                before_foam(s, most),
                std::tuple(s.access.method == AccessMethod::sampled, allowed_mm2_ > 0 ? foam_and_milling(s) : 0,
                           steps(s.access.foam_mm3 / block_mm3), steps(s.access.rest_material_mm3 / block_mm3),
                           !s.block.offcuts.empty(), block_mm3, s.base_number));
        };
        std::stable_sort(setups_.begin(), setups_.end(),
                         [&](const Setup& a, const Setup& b) { return key(a) < key(b); });
    }

    const Piece& piece_;
    const Cell& cell_;
    const SetupOptions& options_;
    const LimitingTools tools_;
    std::vector<PieceBase> bases_;
    std::vector<Setup> setups_;  // one per base
    std::optional<PieceAccess> access_;
    std::vector<bool> is_narrow_;  // per sample
    double allowed_mm2_ = 0;       // SurfaceAccess::allowed_mm2; above 0 where blocks are sawn
    double whole_mm2_ = 0;         // of the piece's surface
};

}  // namespace

double max_tilt_deg(const Cell& cell) {
    return cell.machine ? cell.machine->max_tilt / degree : default_tilt_deg;
}

SetupChoice choose_setup(const Piece& piece, const Cell& cell, const SetupOptions& options) {
    assert(piece.mesh && !piece.mesh->triangles.empty() && !cell.stock.empty());
    return Choice(piece, cell, options).run();
}

bool fits_cell(const Piece& piece, const Cell& cell) {
    const std::vector<PieceBase> bases = bases_of(piece);
    const std::vector<CapPoints> caps = caps_to_saw(*piece.mesh, cell);
    return std::any_of(bases.begin(), bases.end(), [&](const PieceBase& base) {
        return check_stock_fit(lay_out(piece, base, cell, caps), cell).fits();
    });
}

bool fits_cell_and_machine(const Piece& piece, const Cell& cell, std::span<const PieceBase> bases) {
    const std::vector<CapPoints> caps = caps_to_saw(*piece.mesh, cell);
    return std::any_of(bases.begin(), bases.end(), [&](const PieceBase& base) {
        Setup setup = lay_out(piece, base, cell, caps);
        if (!check_stock_fit(setup, cell).fits()) return false;
        setup.access.orientations.push_back({setup.up, 0, 0, 0});
        return fits_machine(setup, *piece.mesh, cell);
    });
}

}  // namespace qchopper
