#include "segment/raster/solid_lines.h"

namespace qchopper {

SolidLines spans_between(std::vector<LineCrossing> crossings, std::size_t columns, std::size_t rows) {
    // Leaving before entering: solids that touch are two spans.
    std::sort(crossings.begin(), crossings.end(), [](const LineCrossing& a, const LineCrossing& b) {
        if (a.line != b.line) return a.line < b.line;
        return a.height != b.height ? a.height < b.height : a.depth_change < b.depth_change;
    });
    SolidLines map{columns, rows, {}, {}};
    map.first.reserve(columns * rows + 1);
    std::size_t next = 0;
    for (std::size_t line = 0; line < columns * rows; ++line) {
        map.first.push_back(static_cast<std::uint32_t>(map.spans.size()));
        std::int32_t depth = 0;
        double low = 0;
        for (; next < crossings.size() && crossings[next].line == line; ++next) {
            const std::int32_t before = depth;
            depth += crossings[next].depth_change;
            if (before <= 0 && depth > 0) low = crossings[next].height;
            if (before > 0 && depth <= 0 && low < crossings[next].height) {
                map.spans.push_back({low, crossings[next].height});
            }
        }
    }
    map.first.push_back(static_cast<std::uint32_t>(map.spans.size()));
    return map;
}

}  // namespace qchopper
