// Sums of rows. O(rows * different rows).

#include "app/report/time_report.h"

#include <algorithm>

#include "app/jobs/time_fields.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr double litre = 1e6;  // mm3
constexpr double cm3 = 1e3;    // mm3

std::string hours(double seconds) {
    return fixed(seconds / 3600, 2);
}

void add(ProofTime& sum, const ProofTime& row) {
    sum.cutting_s += row.cutting_s;
    sum.air_s += row.air_s;
    sum.link_s += row.link_s;
    sum.acceleration_s += row.acceleration_s;
    sum.joint_move_s += row.joint_move_s;
    sum.tool_change_s += row.tool_change_s;
    sum.cutting_mm += row.cutting_mm;
    sum.air_mm += row.air_mm;
    sum.link_mm += row.link_mm;
    sum.removed_mm3 += row.removed_mm3;
    sum.lines += row.lines;
    sum.stops += row.stops;
    sum.short_lines += row.short_lines;
    sum.tool_changes += row.tool_changes;
}

ProofTime sum_of(const std::vector<ProofTime>& rows, const std::string& operation) {
    ProofTime sum;
    for (const ProofTime& row : rows) {
        if (operation.empty() || row.operation == operation) add(sum, row);
    }
    return sum;
}

std::string roughing_words(const std::vector<ProofTime>& rows) {
    constexpr const char* kind = "roughing";
    const ProofTime roughing = sum_of(rows, kind);
    double at_rate_s = 0;
    for (const ProofTime& row : rows) {
        if (row.operation == kind && row.tool_mm3_per_s > 0) at_rate_s += row.removed_mm3 / row.tool_mm3_per_s;
    }
    if (roughing.line_s() <= 0 || at_rate_s <= 0) return {};
    return "; roughing removes " + fixed(roughing.removed_mm3 / litre, 2) + " l at " +
           fixed(roughing.removed_mm3 / roughing.line_s() / cm3, 1) + " cm3/s, its tools may " +
           fixed(roughing.removed_mm3 / at_rate_s / cm3, 1);
}

}  // namespace

std::vector<ProofTime> merged(const std::vector<ProofTime>& rows) {
    std::vector<ProofTime> sums;
    for (const ProofTime& row : rows) {
        const auto is_same = [&](const ProofTime& sum) {
            return sum.operation == row.operation && sum.tool == row.tool && sum.tool_mm3_per_s == row.tool_mm3_per_s;
        };
        const auto found = std::find_if(sums.begin(), sums.end(), is_same);
        if (found == sums.end()) {
            sums.push_back(row);
        } else {
            add(*found, row);
        }
    }
    return sums;
}

std::string time_line(const std::vector<ProofTime>& rows) {
    if (rows.empty()) return {};
    const ProofTime all = sum_of(rows, {});
    std::string line = "machine time " + hours(all.seconds()) + " h:";
    for (const char* kind : {"roughing", "finishing", "fine finishing", "drilling"}) {
        line += std::string(" ") + kind + " " + hours(sum_of(rows, kind).seconds()) + ",";
    }
    line.back() = ';';
    if (const double unknown = sum_of(rows, "unknown").seconds(); unknown > 0)
        line += " unknown " + hours(unknown) + ";";
    line += " cutting " + hours(all.cutting_s) + ", air " + hours(all.air_s) + ", links " + hours(all.link_s) +
            ", acceleration and stops " + hours(all.acceleration_s) + ", joint moves " + hours(all.joint_move_s) +
            ", tool changes " + hours(all.tool_change_s);
    return line + roughing_words(rows) + ".";
}

void add_time(nlohmann::ordered_json& document, const std::vector<ProofTime>& rows) {
    json_values::put(json_values::added(document, "time"), rows);
}

}  // namespace qchopper
