// A list per kind.

#include "sim/replay/finding.h"

#include <utility>

namespace qchopper {
namespace {

constexpr std::size_t kept_per_kind = 5;
constexpr std::array<const char*, finding_kinds> words{
    "chunk_order",     "tool_frame",     "base_frame",   "load",           "table_angle",   "tool_axis",
    "tool_change",     "reach",          "joint_limit",  "cable",          "branch",        "singularity",
    "joint_speed",     "outside_reach",  "collision",    "holder_contact", "rapid_in_foam", "feed_window",
    "link_feed",       "deep_cut",       "plunge",       "removal_rate",   "below_floor",   "spindle_off",
    "spindle_speed",   "extraction_off", "left_on",      "unknown_signal", "motion_limit",  "not_home",
    "start_from_home", "gouge",          "gouge_volume", "given_up",       "leftover",      "standing_foam",
    "missing_hole",    "shifted_hole",   "hole_depth",   "hole_diameter",  "repeated_hole", "extra_hole",
    "no_cut",          "flush_face"};

}  // namespace

const char* to_word(FindingKind kind) {
    return words[static_cast<std::size_t>(kind)];
}

bool FindingLog::wants(FindingKind kind, double worse) {
    OfKind& of = kinds_[static_cast<std::size_t>(kind)];
    ++of.count;
    return of.first.size() < kept_per_kind || worse > of.worst;
}

void FindingLog::keep(FindingKind kind, SourcePlace place, double number, double worse, std::string text) {
    OfKind& of = kinds_[static_cast<std::size_t>(kind)];
    const Finding finding{kind, place, number, std::move(text)};
    const bool is_worst = of.first.empty() || worse > of.worst;
    if (is_worst) of.worst = worse;
    if (of.first.size() < kept_per_kind) {
        of.first.push_back(finding);
    } else if (is_worst) {
        of.worst_one = finding;
    }
}

std::vector<Finding> FindingLog::findings() const {
    std::vector<Finding> all;
    for (const OfKind& of : kinds_) {
        all.insert(all.end(), of.first.begin(), of.first.end());
        if (!of.worst_one.text.empty()) all.push_back(of.worst_one);
    }
    return all;
}

std::array<std::size_t, finding_kinds> FindingLog::counts() const {
    std::array<std::size_t, finding_kinds> counts{};
    for (std::size_t i = 0; i < finding_kinds; ++i) counts[i] = kinds_[i].count;
    return counts;
}

}  // namespace qchopper
