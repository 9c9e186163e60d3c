// The map of places as text.

#include "app/report/cell/cell_report.h"
#include "app/report/cell/machine_reachability_report.h"
#include "app/report/columns.h"
#include "base/text.h"
#include "base/units.h"

namespace qchopper {
namespace {

// Of one place: its margin, "-" where a pose is not held, "." where the block would hang over the table.
std::string word_of(const BlockPlace& place) {
    if (!place.is_on_table) return ".";
    return place.margin ? fixed(*place.margin, 2) : "-";
}

// Only the columns and rows in which the block stands on the table somewhere.
std::vector<std::vector<std::string>> rows_of(const BlockPlaces& map) {
    const auto place = [&](std::size_t row, std::size_t column) { return map.places[row * map.columns + column]; };
    std::vector<bool> has_column(map.columns, false);
    std::vector<bool> has_row(map.rows, false);
    for (std::size_t i = 0; i < map.places.size(); ++i) {
        if (!map.places[i].is_on_table) continue;
        has_row[i / map.columns] = true;
        has_column[i % map.columns] = true;
    }
    std::vector<std::vector<std::string>> rows{{"y \\ x"}};
    for (std::size_t column = 0; column < map.columns; ++column) {
        if (has_column[column]) rows.front().push_back(fixed(place(0, column).x, 0));
    }
    for (std::size_t row = map.rows; row-- > 0;) {
        if (!has_row[row]) continue;
        rows.push_back({fixed(place(row, 0).y, 0)});
        for (std::size_t column = 0; column < map.columns; ++column) {
            if (has_column[column]) rows.back().push_back(word_of(place(row, column)));
        }
    }
    return rows;
}

std::string question(const BlockPlaces& map) {
    const std::string size = fixed(map.block.x, 0) + " x " + fixed(map.block.y, 0) + " x " + fixed(map.block.z, 0);
    const std::string tilt = significant(degrees(map.tilt), 4);
    return "block of " + size + " mm, tool straight down" +
           (map.tilt > 0 ? " and at a tilt of " + tilt + " degrees from all around" : "");
}

}  // namespace

std::vector<std::string> lines(const PlacesInCell& places) {
    const BlockPlaces& map = places.map;
    std::vector<std::string> text{places.file + ": " + question(map)};
    text.push_back(
        "Smallest relative margin where the middle of the block stands, mm from the middle of the table, its "
        "sides along it:");
    for (const std::string& line : columns(rows_of(map))) text.push_back(line);
    text.emplace_back("- some pose is not held; . the block would hang over the table.");
    const bool holds = map.best.holds();
    text.push_back((holds ? "Best place: " : "No place holds. The best is ") + place_word(map.best.placement) + "; " +
                   describe_margin(map.best.tightest()) + ".");
    return text;
}

}  // namespace qchopper
