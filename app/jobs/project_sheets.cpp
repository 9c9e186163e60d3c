// O(bytes of the jobs), of which one is in memory at a time.

#include "app/jobs/project_sheets.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "app/jobs/job_verdict.h"
#include "base/files/file.h"
#include "base/timings.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* sheets_file = sheet_files[0];
constexpr const char* saw_list_page = sheet_files[1];
constexpr const char* saw_list_document = sheet_files[2];

std::string state_of(const ReadJob& job, const fs::path& file) {
    if (!job.program) return "no program";
    const std::optional<JobVerdict> verdict = read_verdict(file);
    if (!verdict || !verdict->is_positive) return "DO NOT START: not proven";
    return is_unreachable(job.setup, job.max_unreachable) ? "unreachable" : "ready";
}

// Whether a piece may be one that the saw alone makes, before its setup is asked for.
bool is_all_caps(const TriangleMesh& mesh) {
    return !mesh.cap_of.empty() && std::find(mesh.cap_of.begin(), mesh.cap_of.end(), no_cap) == mesh.cap_of.end();
}

// What the saw list has of a piece without a job; nothing if it is not the saw that makes it.
std::optional<SawnBlock> only_sawn(const Segmentation& segmentation, std::size_t index, Setups& setups,
                                   std::span<const PieceJoint> joints) {
    const Piece& piece = segmentation.pieces[index];
    if (!is_all_caps(*piece.mesh)) return std::nullopt;
    const Setup& setup = setups.placed(piece).setup();
    if (!is_only_sawn(setup, *piece.mesh)) return std::nullopt;
    std::vector<JobCap> caps;
    for (const DrawnCap& drawn : caps_of(segmentation.pieces, index, joints, setup, setups.cell())) {
        caps.push_back(drawn.cap);
    }
    return sawn_block(piece.name, std::nullopt, setup, caps, setups.cell());
}

void write_saw_list(const fs::path& folder, const SawList& list) {
    if (list.blocks.empty()) return;
    write_file(folder / saw_list_page, saw_list_html(list));
    write_file(folder / saw_list_document, saw_list_json(list));
}

}  // namespace

OrderContent order_content(const fs::path& folder, const Project& project, const Segmentation& segmentation,
                           Setups& setups, std::span<const PieceJoint> joints) {
    OrderContent content;
    auto& [sheets, blocks, without, setups_of_jobs] = content;
    for (const WrittenJob& written : project.jobs) {
        const fs::path file = folder / "jobs" / job_file_name(written.piece, written.part);
        const ReadJob job = parse_job(read_job(file), file.string());
        sheets.push_back(sheet_of(job, file.filename().string(), state_of(job, file)));
        if (written.part > 1) continue;
        auto block = sawn_block(job.piece, file.filename().string(), job.setup, job.caps, setups.cell());
        if (block) blocks.push_back(*std::move(block));
        setups_of_jobs.emplace(job.piece, job.setup);
    }
    for (std::size_t i = 0; i < segmentation.pieces.size(); ++i) {
        const std::string& name = segmentation.pieces[i].name;
        const bool has_job =
            std::any_of(sheets.begin(), sheets.end(), [&](const SheetOfOrder& sheet) { return sheet.piece == name; });
        if (has_job) continue;
        std::optional<SawnBlock> block = only_sawn(segmentation, i, setups, joints);
        (block ? without.only_sawn : without.others).push_back(name);
        if (block) blocks.push_back(*std::move(block));
    }
    return content;
}

void write_sheets(const fs::path& folder, const Project& project, const Segmentation& segmentation, Setups& setups,
                  std::span<const PieceJoint> joints, const Context& context) {
    const StageTimer stage(context, "sheets written");
    OrderContent content = order_content(folder, project, segmentation, setups, joints);
    const std::string order = project.scan.path.filename().string();
    remove_sheets(folder);
    write_file(folder / sheets_file, order_sheets(order, content.sheets, content.without_job));
    write_saw_list(folder, saw_list(order, setups.cell().saw.accuracy, std::move(content.blocks)));
}

void remove_sheets(const fs::path& folder) {
    std::error_code error;
    for (const char* name : sheet_files) fs::remove(folder / name, error);
}

}  // namespace qchopper
