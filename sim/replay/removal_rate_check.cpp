// A window over the lines goes on by one line at a time and drops lines at its beginning. O(lines).

#include "sim/replay/removal_rate_check.h"

#include <deque>

#include "base/text.h"

namespace qchopper {
namespace {

// Lines in a row of one tool, the last ones that are together as long as the tool is wide.
class RateWindow {
 public:
    // mm3/s; 0 as long as the lines are shorter together.
    double add(double length, double seconds, double volume, double width) {
        parts_.push_back({length, seconds, volume});
        sum_.add(parts_.back(), 1);
        while (sum_.length - parts_.front().length >= width) {
            sum_.add(parts_.front(), -1);
            parts_.pop_front();
        }
        return sum_.length >= width && sum_.seconds > 0 ? sum_.volume / sum_.seconds : 0;
    }

 private:
    struct Part {
        double length = 0;
        double seconds = 0;
        double volume = 0;
        void add(const Part& other, double sign) {
            length += sign * other.length;
            seconds += sign * other.seconds;
            volume += sign * other.volume;
        }
    };
    std::deque<Part> parts_;
    Part sum_;
};

}  // namespace

void check_removal_rate(const ToolPath& path, const std::vector<LineCut>& cuts, const ReplayScene& scene,
                        FindingLog& log) {
    RateWindow window;
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        const TipLine& line = path.lines[i];
        const CuttingTool& tool = scene.cell->machine->tools[line.tool];
        if (path.before(i) == nullptr || path.lines[i - 1].tool != line.tool) window = {};
        const double length = norm(line.to - line.from);
        if (is_drill(tool) || !(line.feed > 0) || !(length > 0)) continue;
        const double rate = window.add(length, length / line.feed, cuts[i].removed_mm3, tool.diameter);
        if (rate <= (1 + removal_tolerance) * tool.removal_mm3_per_s) continue;
        log.add(FindingKind::removal_rate, line.place, rate / 1000, rate / tool.removal_mm3_per_s, [&] {
            return "foam is removed at " + fixed(rate / 1000, 1) + " cm3/s, tool " + std::to_string(tool.number) +
                   " may remove " + fixed(tool.removal_mm3_per_s / 1000, 1);
        });
    }
}

}  // namespace qchopper
