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

MachineTime sum_of_kind(const std::vector<MachineTime>& rows, const std::string& operation) {
    MachineTime sum;
    for (const MachineTime& row : rows) {
        if (row.operation == operation) add(sum, row);
    }
    return sum;
}

std::string roughing_words(const std::vector<MachineTime>& rows) {
    constexpr const char* kind = "roughing";
    const MachineTime roughing = sum_of_kind(rows, kind);
    double at_rate_s = 0;
    for (const MachineTime& row : rows) {
        if (row.operation == kind && row.tool_mm3_per_s > 0) at_rate_s += row.removed_mm3 / row.tool_mm3_per_s;
    }
    if (roughing.line_s() <= 0 || at_rate_s <= 0) return {};
    return "; roughing removes " + fixed(roughing.removed_mm3 / litre, 2) + " l at " +
           fixed(roughing.removed_mm3 / roughing.line_s() / cm3, 1) + " cm3/s, its tools may " +
           fixed(roughing.removed_mm3 / at_rate_s / cm3, 1);
}

// Of all lines of the programs.
std::string path_words(const MachineTime& all) {
    const double path_mm = all.cutting_mm + all.air_mm + all.link_mm;
    if (path_mm <= 0 || all.lines == 0) return {};
    return "; " + fixed(100 * (all.air_mm + all.link_mm) / path_mm, 0) + " % of the path removes nothing, " +
           fixed(100 * static_cast<double>(all.stops) / static_cast<double>(all.lines), 1) +
           " % of the lines stop exactly";
}

}  // namespace

std::vector<MachineTime> merged(const std::vector<MachineTime>& rows) {
    std::vector<MachineTime> sums;
    for (const MachineTime& row : rows) {
        const auto is_same = [&](const MachineTime& sum) {
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

std::string time_line(const std::vector<MachineTime>& rows) {
    if (rows.empty()) return {};
    const MachineTime all = sum_of(rows);
    std::string line = "machine time " + hours(all.seconds()) + " h:";
    for (const char* kind : {"roughing", "finishing", "fine finishing", "drilling"}) {
        line += std::string(" ") + kind + " " + hours(sum_of_kind(rows, kind).seconds()) + ",";
    }
    line.back() = ';';
    if (const double unknown = sum_of_kind(rows, "unknown").seconds(); unknown > 0)
        line += " unknown " + hours(unknown) + ";";
    line += " cutting " + hours(all.cutting_s) + ", air " + hours(all.air_s) + ", links " + hours(all.link_s) +
            ", acceleration and stops " + hours(all.acceleration_s) + ", joint moves " + hours(all.joint_move_s) +
            ", tool changes " + hours(all.tool_change_s);
    return line + roughing_words(rows) + path_words(all) + ".";
}

void add_time(nlohmann::ordered_json& document, const std::vector<MachineTime>& rows) {
    json_values::put(json_values::added(document, "time"), rows);
}

}  // namespace qchopper
