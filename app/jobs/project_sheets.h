// The setup sheets of a project's jobs as one document, sheets.html in its folder, and how its blocks are sawn:
// saw-list.html and saw-list.json, where at least one is.
//
// Never stale, as the jobs are: they are removed when one of them changes and written when those are
// (tests/app/cli/sheets_test.cpp).

#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/jobs/setups.h"
#include "app/store/project.h"
#include "base/context.h"
#include "cam/job/sheet/order_sheets.h"
#include "cam/job/sheet/saw_list.h"
#include "segment/joint/piece_joints.h"
#include "segment/search/segmentation.h"

namespace qchopper {

// What the jobs of a project say.
struct OrderContent {
    std::vector<SheetOfOrder> sheets;  // one per job
    std::vector<SawnBlock> blocks;
    PiecesWithoutJob without_job;
    std::map<std::string, Setup> setups = {};  // by piece, of those that have a job
};

// Reads the recorded jobs, one at a time; `joints` are those of all pieces, for those that have no job because the saw
// alone makes them. Throws what read_job, parse_job, read_verdict and Setups::placed throw.
OrderContent order_content(const std::filesystem::path& folder, const Project& project,
                           const Segmentation& segmentation, Setups& setups, std::span<const PieceJoint> joints);

// Throws what order_content and write_file throw.
void write_sheets(const std::filesystem::path& folder, const Project& project, const Segmentation& segmentation,
                  Setups& setups, std::span<const PieceJoint> joints, const Context& context);

// The files that write_sheets writes, each where there is something to write; then the assembly guide, which belongs to
// the same jobs (app/guide/write_guide.h).
inline constexpr std::array sheet_files{"sheets.html", "saw-list.html", "saw-list.json",
                                        "guide.html",  "guide.pdf",     "guide.glb"};

void remove_sheets(const std::filesystem::path& folder);

}  // namespace qchopper
