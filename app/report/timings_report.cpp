// Text and JSON from a value.

#include "app/report/timings_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/text.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> row(const std::string& name, const SpentTime& spent, double whole_s) {
    const double share = whole_s > 0 ? spent.wall_s / whole_s : 0;
    return {name, fixed(spent.wall_s, 3), fixed(spent.cpu_s, 3), fixed(100 * share, 1) + " %"};
}

}  // namespace

std::vector<std::string> table(const RunTimes& times) {
    std::vector<std::vector<std::string>> rows{{"stage", "wall s", "CPU s", "share"}};
    SpentTime other = times.whole;
    for (const StageTime& stage : times.stages) {
        rows.push_back(row(stage.name, stage.spent, times.whole.wall_s));
        other.wall_s -= stage.spent.wall_s;
        other.cpu_s -= stage.spent.cpu_s;
    }
    rows.push_back(row("in no stage", other, times.whole.wall_s));
    rows.push_back(row("whole", times.whole, times.whole.wall_s));
    std::vector<std::string> text = columns(rows);
    text.push_back("peak memory  " + fixed(static_cast<double>(times.peak_memory_bytes) / 1e6, 0) + " MB");
    return text;
}

Document with_timings(const Document& document, const RunTimes& times) {
    const auto stage_json = [](const StageTime& stage) {
        return Json{{"name", stage.name}, {"wall_s", stage.spent.wall_s}, {"cpu_s", stage.spent.cpu_s}};
    };
    Json json = *document.json;
    json["timings"] = {{"stages", list_of(times.stages, stage_json)},
                       {"wall_s", times.whole.wall_s},
                       {"cpu_s", times.whole.cpu_s},
                       {"peak_memory_bytes", times.peak_memory_bytes}};
    return document.is_one_line ? compose_line(std::move(json)) : compose(std::move(json));
}

}  // namespace qchopper
