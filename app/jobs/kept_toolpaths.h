// Keeps the toolpath of a piece on disk from when the arm is known to follow it until its program is proven: pieces
// that no arm follows are cut again before any program is made. The files may be deleted at any time.
//
// A file is named by a SHA-256 over all that the toolpath is made from, which its holes are not, and ends in a SHA-256
// of its content. What is taken is what would be made again, to the bit (tests/app/jobs/kept_toolpaths_test.cpp).

#pragma once

#include <filesystem>
#include <optional>

#include "app/jobs/kept_programs.h"
#include "app/jobs/piece_program.h"

namespace qchopper {

constexpr const char* toolpaths_ending = ".toolpath";  // of the names of the files

// The file in `folder`, whether it is there or not. O(triangles).
std::filesystem::path toolpath_file(const std::filesystem::path& folder, const ProgramSource& source);

// What keep_toolpath wrote; nothing if there is no such file, or it is damaged. O(bytes).
std::optional<FollowedToolpath> kept_toolpath(const std::filesystem::path& file);

// What cannot be written is not kept. O(bytes): 50 a move, and 4 for each mm2 of every orientation.
void keep_toolpath(const std::filesystem::path& file, const FollowedToolpath& followed);

}  // namespace qchopper
