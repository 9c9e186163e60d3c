// Converts between a project and the segmentation that its decisions make.
//
// Scan and decisions give the same pieces again, bit for bit (tests/app/store/project_test.cpp). `scan` is always the
// imported scan of the project; lengths in mm about its centre.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/store/project.h"
#include "base/context.h"

namespace qchopper {

// Copies the state of the segmentation into the project. Cuts, then discarded pieces, that the history does not have
// are added to it; cuts at its end that the segmentation does not have are dropped (decisions.h, follow). Precondition:
// discarded pieces that are new to the history were discarded after the last cut. O(faces).
void record(Project& project, const Segmentation& segmentation);

// Applies the first `cuts` of the cuts in force to the scan exactly as they were made, and discards what was discarded
// before the next cut. Reports progress in cuts. Throws Cancelled. Precondition: cuts <= project.cuts.size(). Throws
// InputError (config) if a cut misses or a piece does not exist. O(cuts) times the cost of a cut.
// The pieces have samples if the settings want them. What rays find on the uncut scan is kept in the folder `cache`,
// which changes nothing but the time; empty: it is not kept.
Segmentation replay(const Project& project, const TriangleMesh& scan, std::size_t cuts, const Context& context = {},
                    const std::filesystem::path& cache = {});
// All of them.
Segmentation replay(const Project& project, const TriangleMesh& scan, const Context& context = {},
                    const std::filesystem::path& cache = {});

// The pieces that the cuts of these numbers divide, as they were before, by the number. Costs as replay().
std::map<std::int32_t, Piece> divided_pieces(const Project& project, const TriangleMesh& scan,
                                             const std::vector<std::int32_t>& numbers, const Context& context = {},
                                             const std::filesystem::path& cache = {});

// The index of a piece in segmentation.pieces; nothing if no piece has that name. O(pieces).
std::optional<std::size_t> piece_named(const Segmentation& segmentation, const std::string& name);
// The same. Throws InputError (use) if no piece has that name.
std::size_t index_of_piece(const Segmentation& segmentation, const std::string& name);

// Gives the pieces of a scan its stress; null: none.
void set_stress(std::span<Piece> pieces, const std::shared_ptr<const StressedModel>& stress);

// Throws InputError (use) if structure has a weight without a load.
void check_load(const std::optional<StructureOptions>& load, const Weights& weights);

// Throws InputError (use) if symmetry has a weight without the symmetry plane of the scan.
void check_symmetry(const std::optional<SymmetryPlane>& plane, const Weights& weights);

// Where the search of a project goes on: at its beam if it has one and is wider than 1. `committed` is the segmentation
// of its cuts; `scan` is called only if the root of the beam has fewer.
BeamProgress beam_progress(const Project& project, const Segmentation& committed,
                           const std::function<const TriangleMesh&()>& scan, const std::filesystem::path& cache = {});

}  // namespace qchopper
