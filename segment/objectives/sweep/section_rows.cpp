// A part of the outline crosses the rows from its lower end, included, to its upper one, excluded, so that a corner on
// a row counts once.

#include "segment/objectives/sweep/section_rows.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace qchopper {

std::vector<RowCrossing> row_crossings(const Section& section, const std::vector<SectionRegion>& regions,
                                       double spacing) {
    std::vector<RowCrossing> crossings;
    const auto first_row = [&](double y) { return static_cast<std::int32_t>(std::ceil(y / spacing)); };
    for (const SectionRegion& region : regions) {
        for (const std::size_t l : region.loops) {
            const std::span<const Point2> points = section.points(section.loops[l]);
            for (std::size_t n = 0; n < points.size(); ++n) {
                Point2 a = points[n];
                Point2 b = points[n + 1 < points.size() ? n + 1 : 0];
                if (a.y > b.y) std::swap(a, b);
                const std::int32_t end = first_row(b.y);
                for (std::int32_t row = first_row(a.y); row < end; ++row) {
                    const double share = (row * spacing - a.y) / (b.y - a.y);
                    crossings.push_back({row, a.x + share * (b.x - a.x), static_cast<std::uint32_t>(l)});
                }
            }
        }
    }
    std::sort(crossings.begin(), crossings.end(), [](const RowCrossing& a, const RowCrossing& b) {
        return std::tie(a.row, a.x, a.loop) < std::tie(b.row, b.x, b.loop);
    });
    return crossings;
}

}  // namespace qchopper
