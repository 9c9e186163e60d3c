// The results of `cells list`, `cells show`, `cells check` and `cells reach`: lines for people and documents for
// programs (docs/user/cell-file.md). O(values of the files).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report/document.h"
#include "cam/cell/cell.h"
#include "cam/cell/cell_check.h"
#include "cam/cell/taught_poses.h"
#include "cam/setup/placement/block_places.h"

namespace qchopper {

// A cell file of a folder.
struct ListedCell {
    std::string file;
    std::optional<Cell> cell;  // nothing: it is wrong
    std::string error;         // why
};

// A picture of the reach that was written.
struct ReachPicture {
    std::string file;
    double y = 0;     // mm, of the section
    double step = 0;  // mm, between its points
};

struct ShownCell {
    std::string file;
    const Cell& cell;  // outlives this object
    std::optional<ReachPicture> picture;
};

struct CheckedCell {
    std::string file;
    const Cell& cell;  // outlives this object
    CellCheck check;
    std::optional<TaughtPoseCheck> poses;  // where poses were given
    bool is_good() const { return check.may_be_dispatched() && (!poses || poses->agrees); }
};

struct PlacesInCell {
    std::string file;
    const Cell& cell;  // outlives this object
    BlockPlaces map;
};

std::vector<std::string> lines(const std::vector<ListedCell>& cells);
Document document(const std::vector<ListedCell>& cells);
std::vector<std::string> lines(const ShownCell& shown);
Document document(const ShownCell& shown);
std::vector<std::string> lines(const CheckedCell& checked);
Document document(const CheckedCell& checked);
// Of the map a row per y, the largest first, as one looks at a drawing.
std::vector<std::string> lines(const PlacesInCell& places);
Document document(const PlacesInCell& places);

}  // namespace qchopper
