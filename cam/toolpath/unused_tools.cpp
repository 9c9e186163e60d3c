// Directions without any operation first, then tools one after the other.

#include "cam/toolpath/unused_tools.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.h"
#include "cam/cell/job_tools.h"
#include "cam/toolpath/worthwhile_tools.h"

namespace qchopper {
namespace {

std::string number_of(const CellMachine& machine, std::size_t tool) {
    return "tool " + std::to_string(machine.tools[tool].number);
}

// "tool 2 roughs, tools 3 and 4 finish, and this one would shorten the work by less than its change takes or add less
// than 0.3 % of the surface".
std::string describe(const CellMachine& machine, const ToolChoice& chosen) {
    std::vector<std::uint16_t> numbers;
    for (const std::size_t tool : chosen.finishing) numbers.push_back(machine.tools[tool].number);
    return number_of(machine, chosen.roughing) + " roughs, " + describe_tools(numbers) +
           (numbers.size() > 1 ? " finish" : " finishes") +
           "; it would shorten the work by less than its change takes, or add less than " +
           fixed(100 * worthwhile_share, 1) + " % of the surface";
}

class Listing {
 public:
    Listing(const CellMachine& machine, const ToolChoice& chosen, const Toolpath& toolpath,
            const ToolsAlong& has_nothing)
        : machine_(machine), chosen_(chosen), has_nothing_(has_nothing) {
        for (const Operation& operation : toolpath.operations) used_.insert({operation.tool, operation.orientation});
    }

    std::vector<UnusedTool> list(std::size_t directions) const {
        std::vector<UnusedTool> unused;
        for (std::size_t d = 0; d < directions; ++d) {
            if (!is_milled(d)) unused.push_back({std::nullopt, d, why(chosen_.finishing.back(), d)});
        }
        for (std::size_t tool = 0; tool < machine_.tools.size(); ++tool) {
            if (machine_.tools[tool].shape != ToolShape::ball) continue;
            if (!is_chosen(tool)) {
                unused.push_back({tool, std::nullopt, describe(machine_, chosen_)});
                continue;
            }
            for (std::size_t d = 0; d < directions; ++d) {
                if (is_milled(d) && !used_.contains({tool, d})) unused.push_back({tool, d, why(tool, d)});
            }
        }
        return unused;
    }

 private:
    bool is_milled(std::size_t orientation) const {
        return std::any_of(used_.begin(), used_.end(), [&](const auto& pair) { return pair.second == orientation; });
    }
    bool finishes(std::size_t tool) const { return std::ranges::count(chosen_.finishing, tool) > 0; }
    bool is_chosen(std::size_t tool) const { return tool == chosen_.roughing || finishes(tool); }
    std::string why(std::size_t tool, std::size_t orientation) const {
        if (!finishes(tool)) return "it roughs, and no foam is left for that";
        if (has_nothing_.contains({tool, orientation})) {
            return "tools and orientations before it leave no surface that it would finish";
        }
        return "foam that stands keeps its holder or its flute from all of its passes";
    }

    const CellMachine& machine_;
    const ToolChoice& chosen_;
    const ToolsAlong& has_nothing_;
    ToolsAlong used_;
};

}  // namespace

std::vector<UnusedTool> unused_tools(const CellMachine& machine, const ToolChoice& chosen, std::size_t directions,
                                     const Toolpath& toolpath, const ToolsAlong& has_nothing) {
    return Listing(machine, chosen, toolpath, has_nothing).list(directions);
}

}  // namespace qchopper
