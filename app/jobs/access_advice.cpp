// A table of kinds, with the share of each and the sentence for it. O(samples x directions) for what is inside.

#include "app/jobs/access_advice.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "cam/setup/limiting_tools.h"
#include "segment/access/sampled_piece.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

constexpr double min_share = 0.001;

// What is out of reach for other reasons than the holder and the tool's radius, split by what would reach it.
struct Seen {
    double few_orientations = 0;
    double tilt = 0;
    double inside = 0;
};

Seen seen(const AdviceInput& input) {
    const SurfaceAccess& r = input.access;
    const double unseen = r.area_mm2 > 0 ? (r.hidden_mm2 + (r.steep_counts ? r.steep_mm2 : 0)) / r.area_mm2 : 0;
    const double by_all = std::min(unseen, r.all_directions_share);
    const double inside = std::min(by_all, input.inside_share);
    return {unseen - by_all, by_all - inside, inside};
}

std::string millimetres(double mm) {
    return fixed(mm, 0) + " mm";
}

Sentence holder_remedy(const AdviceInput& input, const Cell& cell) {
    double depth = 0;
    for (const ToolOrientation& d : input.access.orientations) depth = std::max(depth, d.depth_mm);
    const std::string deep = ", while surface in sight lies up to " + millimetres(depth) + " deep in the block";
    if (!cell.machine) return "a longer tool or a slimmer holder" + deep;
    const CuttingTool& tool = longest_tool(cell.machine->tools);
    return "a longer tool or a slimmer holder: " + tool.name + " reaches " + millimetres(tool.stick_out) +
           " to its holder" + deep;
}

Sentence directions_remedy(const AdviceInput& input, const Cell&) {
    const std::size_t most = input.max_directions;
    if (input.is_limited) {
        const std::string limit = counted(most, "tool orientation");
        return Sentence::with_key("see_setup_limit", {limit, input.folder, input.piece},
                                  "finishing by hand: it is limited to " + limit + " by its setup");
    }
    // Where fewer were chosen than allowed, a further one gains too little to be worth a program of its own.
    if (input.access.orientations.size() < most)
        return "finishing by hand: no further orientation gains half a percent";
    const std::string more = std::to_string(most + 4);
    return Sentence::with_key("more_orientations", {more, input.folder, input.piece},
                              "more tool orientations: " + more);
}

Sentence tilt_remedy(const AdviceInput& input, const Cell&) {
    Sentence cut = Sentence::with_key("another_cut", {input.folder, input.piece}, "another cut");
    if (input.tilt_deg >= largest_tilt_deg) return cut;
    const std::string tilt = "a larger tilt than " + fixed(input.tilt_deg, 0) + " degrees";
    std::string text = tilt + ", or " + cut.text;
    return Sentence::with_key("larger_tilt", {tilt, std::move(cut)}, std::move(text));
}

Sentence narrow_remedy(const AdviceInput&, const Cell& cell) {
    return "a smaller tool than that of " + millimetres(2 * limiting_tools(cell).smallest_radius);
}

Sentence inside_remedy(const AdviceInput&, const Cell&) {
    return Sentence::with_key("mask", {}, "a mask, if it may stay");
}

struct AdviceKind {
    AccessFault fault;
    const char* word;
    const char* what;
    Sentence (*remedies)(const AdviceInput&, const Cell&);
};

constexpr std::array<AdviceKind, 5> kinds{{
    {AccessFault::holder, "holder", "because of the holder", holder_remedy},
    {AccessFault::few_orientations, "few_orientations", "reached in orientations that are not chosen",
     directions_remedy},
    {AccessFault::tilt, "tilt", "hidden or steep from all directions that can be held", tilt_remedy},
    {AccessFault::narrow, "narrow", "too narrow", narrow_remedy},
    {AccessFault::inside, "inside", "inside, where no direction at all reaches", inside_remedy},
}};

double share_of(AccessFault fault, const AdviceInput& input) {
    const SurfaceAccess& r = input.access;
    switch (fault) {
        case AccessFault::holder:
            return r.area_mm2 > 0 ? r.holder_mm2 / r.area_mm2 : 0;
        case AccessFault::few_orientations:
            return seen(input).few_orientations;
        case AccessFault::tilt:
            return seen(input).tilt;
        case AccessFault::narrow:
            return r.narrow_counts && r.area_mm2 > 0 ? r.too_narrow_mm2 / r.area_mm2 : 0;
        case AccessFault::inside:
            return seen(input).inside;
    }
    return 0;
}

}  // namespace

const char* to_word(AccessFault fault) {
    for (const AdviceKind& kind : kinds) {
        if (kind.fault == fault) return kind.word;
    }
    return "?";
}

std::vector<AccessAdvice> access_advice(const AdviceInput& input, const Cell& cell) {
    std::vector<AccessAdvice> advice;
    for (const AdviceKind& kind : kinds) {
        const double share = share_of(kind.fault, input);
        if (share >= min_share) advice.push_back({kind.fault, share, kind.what, kind.remedies(input, cell)});
    }
    std::stable_sort(advice.begin(), advice.end(),
                     [](const AccessAdvice& a, const AccessAdvice& b) { return a.share > b.share; });
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
