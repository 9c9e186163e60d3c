// The data flow of one scan to its finished jobs, room by room, with the invariants checked at every door.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/job/job.h"
#include "segment/import/import_scan.h"
#include "segment/search/search.h"
#include "tests/folder.h"

namespace qchopper::walk {

using qchopper::Folder;

// The cell file that comes with the project.
Cell foam_cell();

// Cuts until the stop rules hold. Checks: every piece and fragment is closed, volumes add up to 1e-9, names are given
// once.
Segmentation cut_up(const TriangleMesh& scan, SearchSettings settings);

struct PieceJob {
    std::string piece;
    std::filesystem::path file;
};

// One job file per piece, in `folder`. Checks: the piece fits, the same bytes come twice, every hash in the manifest
// is that of its file, and the solid in the file is the piece.
std::vector<PieceJob> write_jobs(const Segmentation& segmentation, const ImportedScan& scan, const Cell& cell,
                                 const std::filesystem::path& folder);

// Hands every job to one simulated cell over TCP. Checks: each ends complete, and the cell counts one start for each.
void run_jobs(const std::vector<PieceJob>& jobs, const Cell& cell, const std::filesystem::path& folder);

}  // namespace qchopper::walk
