// The pieces of a project as the page draws them, made once and kept in the project's cache.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/open_project.h"

namespace qchopper {

struct ShownPiece {
    std::string name;
    std::string mesh;         // its id (app/display/display_store.h)
    double deviation_mm = 0;  // from the piece, at most
    bool operator==(const ShownPiece&) const = default;
};

// Where they are kept.
std::filesystem::path display_folder(const std::filesystem::path& project);

// In the order of the project's pieces. Throws what display_pieces throws (app/display/make_display.h).
std::vector<ShownPiece> shown_pieces(OpenProject& open, const Context& context);

// The id of the states of a piece's faces by its setup. Throws what Setups::placed throws. Preconditions: the project
// has a cell and a piece of that name.
std::string shown_states(OpenProject& open, const std::string& piece, const Context& context);

}  // namespace qchopper
