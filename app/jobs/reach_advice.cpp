// A table of kinds, with the share of each and the sentence for it. O(samples x directions) for what is inside.

#include "app/jobs/reach_advice.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "cam/setup/holder_limit.h"
#include "segment/access/sampled_piece.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

constexpr double least_share = 0.001;

// What is out of reach for other reasons than the holder and the tool's radius, split by what would reach it.
struct Seen {
    double few_directions = 0;
    double tilt = 0;
    double inside = 0;
};

Seen seen(const AdviceInput& input) {
    const SurfaceReach& r = input.reach;
    const double unseen = r.area_mm2 > 0 ? (r.hidden_mm2 + (r.steep_counts ? r.steep_mm2 : 0)) / r.area_mm2 : 0;
    const double by_all = std::min(unseen, r.all_directions_share);
    const double inside = std::min(by_all, input.inside_share);
    return {unseen - by_all, by_all - inside, inside};
}

std::string millimetres(double mm) {
    return fixed(mm, 0) + " mm";
}

std::string holder_cure(const AdviceInput& input, const Cell& cell) {
    double depth = 0;
    for (const SetupDirection& d : input.reach.directions) depth = std::max(depth, d.depth_mm);
    const std::string deep = ", while surface in sight lies up to " + millimetres(depth) + " deep in the block";
    if (!cell.machine) return "a longer tool or a slimmer holder" + deep;
    const CarvingTool& tool = longest_tool(cell.machine->tools);
    return "a longer tool or a slimmer holder: " + tool.name + " reaches " + millimetres(tool.stick_out) +
           " to its holder" + deep;
}

std::string directions_cure(const AdviceInput& input, const Cell&) {
    const std::size_t most = input.max_directions;
    // Where fewer were chosen than allowed, a further one gains too little to be worth a program of its own.
    if (input.reach.directions.size() < most) return "finishing by hand: no further direction gains half a percent";
    return "more directions: " + input.setup_command + " --directions " + std::to_string(most + 4);
}

std::string tilt_cure(const AdviceInput& input, const Cell&) {
    std::string cut = "another cut: " + input.segment_command;
    if (input.tilt_deg >= largest_tilt_deg) return cut;
    return "a larger tilt than " + fixed(input.tilt_deg, 0) + " degrees, or " + cut;
}

std::string narrow_cure(const AdviceInput&, const Cell& cell) {
    double least = cell.tool.diameter;
    if (cell.machine) {
        least = cell.machine->tools.front().diameter;
        for (const CarvingTool& tool : cell.machine->tools) least = std::min(least, tool.diameter);
    }
    return "a smaller tool than that of " + millimetres(least);
}

std::string inside_cure(const AdviceInput&, const Cell&) {
    return "a mask, if it may stay: --ignore-inside, or --ignore-surface FILE";
}

struct AdviceKind {
    ReachFault fault;
    const char* word;
    const char* what;
    std::string (*cures)(const AdviceInput&, const Cell&);
};

constexpr std::array<AdviceKind, 5> kinds{{
    {ReachFault::holder, "holder", "because of the holder", holder_cure},
    {ReachFault::few_directions, "few_directions", "reached by directions that are not chosen", directions_cure},
    {ReachFault::tilt, "tilt", "hidden or steep from all directions that can be held", tilt_cure},
    {ReachFault::narrow, "narrow", "too narrow", narrow_cure},
    {ReachFault::inside, "inside", "inside, where no direction at all reaches", inside_cure},
}};

double share_of(ReachFault fault, const AdviceInput& input) {
    const SurfaceReach& r = input.reach;
    switch (fault) {
        case ReachFault::holder:
            return r.area_mm2 > 0 ? r.holder_mm2 / r.area_mm2 : 0;
        case ReachFault::few_directions:
            return seen(input).few_directions;
        case ReachFault::tilt:
            return seen(input).tilt;
        case ReachFault::narrow:
            return r.narrow_counts && r.area_mm2 > 0 ? r.too_narrow_mm2 / r.area_mm2 : 0;
        case ReachFault::inside:
            return seen(input).inside;
    }
    return 0;
}

}  // namespace

const char* to_word(ReachFault fault) {
    for (const AdviceKind& kind : kinds) {
        if (kind.fault == fault) return kind.word;
    }
    return "?";
}

std::vector<ReachAdvice> reach_advice(const AdviceInput& input, const Cell& cell) {
    std::vector<ReachAdvice> advice;
    for (const AdviceKind& kind : kinds) {
        const double share = share_of(kind.fault, input);
        if (share >= least_share) advice.push_back({kind.fault, share, kind.what, kind.cures(input, cell)});
    }
    std::stable_sort(advice.begin(), advice.end(),
                     [](const ReachAdvice& a, const ReachAdvice& b) { return a.share > b.share; });
    return advice;
}

double inside_share(const Piece& piece) {
    constexpr std::size_t samples = 2'000;
    std::optional<SampledPiece> own;
    if (!piece.samples || piece.samples->accessibility.sample.empty()) {
        own = sampled_alone(piece, tool_directions(oriented_box(piece.mesh->points).axis), samples);
    }
    const PieceAccessibility& seen = own ? own->accessibility : piece.samples->accessibility;
    std::size_t inside = 0;
    for (std::size_t row = 0; row < seen.sample.size(); ++row) {
        const auto distances = seen.distances(row);
        const bool is_open = std::any_of(distances.begin(), distances.end(), [](float d) { return std::isinf(d); });
        inside += is_open ? 0 : 1;
    }
    return seen.sample.empty() ? 0 : static_cast<double>(inside) / static_cast<double>(seen.sample.size());
}

}  // namespace qchopper
