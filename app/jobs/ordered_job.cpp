// Comparisons, most specific difference first; the project id is a SHA-256 over a text of exact hexadecimal numbers.

#include "app/jobs/ordered_job.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iterator>

#include "base/error.h"
#include "base/hex.h"
#include "base/printable.h"
#include "cam/job/read_job.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& what) {
    throw InputError(InputFault::mesh, what, "write the jobs again: qchopper prepare " + shell_word(folder));
}

}  // namespace

Uuid project_id(const Project& project) {
    std::string text = to_hex(project.scan.sha256);
    char line[128];
    for (const Cut& cut : project.cuts) {
        const Plane& p = cut.chosen.plane;
        std::snprintf(line, sizeof line, "\n%s %a %a %a %a", cut.piece.c_str(), p.normal.x, p.normal.y, p.normal.z,
                      p.offset);
        text += line;
    }
    for (const Discard& discard : project.discards) {
        text += "\ndiscard " + discard.piece + " " + std::to_string(discard.after);
    }
    std::snprintf(line, sizeof line, "\n%a %s", project.scan.scale, name_of(project.scan.unit).c_str());
    text += line;
    const Sha256 digest = sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    Uuid id{};
    std::copy_n(digest.bytes.begin(), id.size(), id.begin());
    return id;
}

WrittenJob written_job(const std::string& piece, const Bytes& file, const Uuid& project_id, std::uint16_t part) {
    return {piece, sha256(file), to_hex(project_id), part};
}

std::map<std::string, BlockPlacement> recorded_places(const Project& project) {
    std::map<std::string, BlockPlacement> places;
    for (const WrittenJob& job : project.jobs) {
        if (job.place) places[job.piece] = *job.place;
    }
    return places;
}

std::vector<WrittenJob> written_jobs_of(const Project& project, const std::string& piece) {
    std::vector<WrittenJob> jobs;
    std::copy_if(project.jobs.begin(), project.jobs.end(), std::back_inserter(jobs),
                 [&](const WrittenJob& job) { return job.piece == piece; });
    return jobs;
}

std::vector<std::filesystem::path> restart_files(const std::filesystem::path& folder, const std::string& piece,
                                                 std::uint16_t part) {
    std::map<std::uint32_t, std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "jobs", error)) {
        const std::string name = entry.path().filename().string();
        const std::size_t at = name.rfind(".r");
        if (at == std::string::npos) continue;
        std::uint32_t chunk = 0;
        std::from_chars(name.data() + at + 2, name.data() + name.size(), chunk);
        if (chunk > 0 && name == job_file_name(piece, part, chunk)) files[chunk] = entry.path();
    }
    std::vector<std::filesystem::path> sorted;
    sorted.reserve(files.size());
    for (const auto& [chunk, file] : files) sorted.push_back(file);
    return sorted;
}

void check_ordered(const ReadJob& job, const JobOrder& order) {
    const std::string file = order.file.string();
    const std::uint16_t part = job.program ? job.program->part.number : std::uint16_t{1};
    // Compared with the decisions too: a record that was copied with the jobs of another project would agree with them.
    const bool is_of_project =
        to_hex(job.project_id) == order.written.project_id && job.project_id == project_id(order.project);
    const std::pair<bool, std::string> faults[] = {
        {job.piece != order.piece, " is the job of piece " + job.piece + ", not of piece " + order.piece},
        {part != order.written.part,
         " is part " + std::to_string(part) + " of its piece, not part " + std::to_string(order.written.part)},
        {!is_of_project, " is a job of another project, or of other cuts"},
        {job.cell_id != order.cell.id, " is made for cell " + std::to_string(job.cell_id) + ", and the cell here is " +
                                           std::to_string(order.cell.id) + " (" + order.cell.name + ")"},
        {!job.stock_fit.fits() || !job.holds_poses, " states that its piece does not fit the cell"},
        {job.file_sha256 != order.written.sha256,
         " is not the file that prepare wrote: its SHA-256 is not the one in project.json"}};
    for (const auto& [is_wrong, what] : faults) {
        if (is_wrong) refuse(order.folder, file + what);
    }
}

void refuse_unrecorded(const std::filesystem::path& folder, const std::filesystem::path& file) {
    refuse(folder, "project.json keeps no record of " + file.string() +
                       " (older programs kept none), so it cannot be checked whether it is the job that was ordered");
}

}  // namespace qchopper
