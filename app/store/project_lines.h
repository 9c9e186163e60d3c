// Lines about the state of a project, the same in messages and reports.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/store/project.h"

namespace qchopper {

// "discarded after cut 2: piece C, 1,234 faces, 12.345 ml (3.21 % of the scan)", one line per discarded piece, in the
// order of the decisions. Precondition: project.discards and project.discarded have the same length.
std::vector<std::string> discarded_lines(const Project& project);

// "2 fragments (0.012 ml in all), listed in project.json and kept in pieces/fragments.ply"; empty without fragments.
std::string fragments_line(const Project& project);

// "ignored: 12.40 % of the scan's surface (painted in FILE, inside)".
std::string ignored_line(const IgnoredSurface& ignored);
// "no cut: through 1,234 points of the scan (painted in FILE)".
std::string no_cut_line(const NoCutSurface& no_cut);
// "symmetry plane: normal 1.0000 0.0000 0.0000, offset 0.012 mm; mirror images miss by 0.44 of the distance of samples:
// symmetric".
std::string symmetry_line(const SymmetryPlane& symmetry);
// Those of these lines that the project has.
std::vector<std::string> scan_lines(const Project& project);

// What the stress analysis found, and what it leaves open: how fine it is, the largest tension, floating solids,
// hinges, walls that are too thin for its voxels.
std::vector<std::string> stress_lines(const StressedModel& stress);

// "The 3 cuts made so far are kept in NAME.qch", without a full stop.
std::string kept_cuts(std::size_t cuts, const std::filesystem::path& folder, bool is_beam = false);

// The lines of the cuts that a round of the search has made, of which `told` were told before: several after cuts on
// trial. Of a beam, whose cuts may all have changed, the last cut alone.
std::vector<std::string> round_lines(const std::vector<Cut>& cuts, std::size_t told, const SearchSettings& settings);

// "cut 7 of piece K: by their setups another plane leaves 3.1 instead of 10.9 % of its pieces out of reach; taken".
// One per cut that was asked.
std::vector<std::string> review_lines(const SetupReview& review);

}  // namespace qchopper
