// O(entries of the folder).

#include "app/console/console_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>

#include "app/console/worker/resident_project.h"
#include "app/store/decisions.h"
#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 1000;
constexpr std::size_t id_digits = 16;
constexpr std::size_t longest_name = 80;         // characters
constexpr std::size_t longest_name_bytes = 200;  // of the 255 of a file name
constexpr std::array scan_endings{".ply", ".stl", ".obj", ".off", ".glb", ".gltf", ".3mf"};

// First and last code of what is no letter of a name beyond ASCII, by the blocks of Unicode 15: controls and signs of
// Latin-1, soft hyphen among them; characters that fill without being seen; spaces, marks of direction and punctuation;
// private use; forms that look like ASCII, and what only changes the look of others.
constexpr std::pair<std::uint32_t, std::uint32_t> no_letters[] = {
    {0x0080, 0x00A9}, {0x00AB, 0x00B1}, {0x00B4, 0x00B4}, {0x00B6, 0x00B8},   {0x00BB, 0x00BB},   {0x00BF, 0x00BF},
    {0x034F, 0x034F}, {0x061C, 0x061C}, {0x115F, 0x1160}, {0x1680, 0x1680},   {0x17B4, 0x17B5},   {0x180B, 0x180F},
    {0x2000, 0x206F}, {0x2E00, 0x2E2E}, {0x2E30, 0x2E7F}, {0x3000, 0x3004},   {0x3008, 0x3020},   {0x3164, 0x3164},
    {0xD800, 0xF8FF}, {0xFE00, 0xFE1F}, {0xFE30, 0xFE6F}, {0xFEFF, 0xFF0F},   {0xFF1A, 0xFF20},   {0xFF3B, 0xFF40},
    {0xFF5B, 0xFF65}, {0xFFA0, 0xFFA0}, {0xFFE0, 0xFFFF}, {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0x10FFFF}};

bool is_letter(std::uint32_t code) {
    if (code < 0x80) return std::isalnum(static_cast<unsigned char>(code)) != 0;
    return std::ranges::none_of(no_letters, [&](const auto& row) { return code >= row.first && code <= row.second; });
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_scan(const fs::directory_entry& entry) {
    std::error_code error;
    const std::string ending = lower(entry.path().extension().string());
    return entry.is_regular_file(error) && std::ranges::find(scan_endings, ending) != scan_endings.end();
}

bool is_project(const fs::directory_entry& entry) {
    std::error_code error;
    return fs::is_regular_file(entry.path() / "project.json", error);
}

std::vector<fs::path> entries_of(const fs::path& folder,
                                 const std::function<bool(const fs::directory_entry&)>& wanted) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (wanted(*entry)) found.push_back(entry->path());
    }
    std::ranges::sort(found);
    return found;
}

std::optional<fs::path> of_id(const std::vector<fs::path>& paths, const std::string& id) {
    const auto found = std::ranges::find_if(paths, [&](const fs::path& p) { return id_of_name(p.filename()) == id; });
    return found == paths.end() ? std::nullopt : std::optional(*found);
}

ListedProject listed(const fs::path& path) {
    ListedProject entry{id_of_name(path.filename()), path.filename(), {}, 0, 0, {}, {}};
    try {
        const Project project = load_project(path);
        entry.stage = names_of(project.stage)(project.stage);
        entry.cuts = project.cuts.size();
        entry.pieces = project.pieces.size();
        entry.scan = project.scan.path.filename();
    } catch (const InputError& e) {
        entry.problem = e.what();
    }
    return entry;
}

}  // namespace

std::string id_of_name(const std::string& name) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(name.data());
    return to_hex(sha256({bytes, name.size()})).substr(0, id_digits);
}

std::vector<fs::path> projects_in(const fs::path& folder) {
    return entries_of(folder, is_project);
}

FolderList list_folder(const fs::path& folder) {
    FolderList list;
    list.folder = folder.filename().string();
    std::vector<fs::path> scans = entries_of(folder, is_scan);
    std::vector<fs::path> projects = projects_in(folder);
    list.is_cut_off = scans.size() > most_listed || projects.size() > most_listed;
    scans.resize(std::min(scans.size(), most_listed));
    projects.resize(std::min(projects.size(), most_listed));
    for (const fs::path& scan : scans) {
        std::error_code error;
        const std::uintmax_t bytes = fs::file_size(scan, error);
        list.scans.push_back({id_of_name(scan.filename()), scan.filename(), error ? 0 : bytes});
    }
    for (const fs::path& project : projects) list.projects.push_back(listed(project));
    return list;
}

std::optional<fs::path> scan_of_id(const fs::path& folder, const std::string& id) {
    return of_id(entries_of(folder, is_scan), id);
}

std::optional<fs::path> project_of_id(const fs::path& folder, const std::string& id) {
    return of_id(projects_in(folder), id);
}

ProjectSummary summary_of(const fs::path& folder) {
    ProjectSummary summary;
    summary.id = id_of_name(folder.filename());
    summary.name = folder.filename();
    summary.revision = revision_of_project(folder);
    const Project project = load_project(folder);
    summary.stage = names_of(project.stage)(project.stage);
    summary.undo = undo_text(project.history);
    summary.redo = redo_text(project.history);
    summary.writer = writer_of(folder);
    // Only while it decides something that the page has asked for.
    if (summary.writer && summary.writer->starts_with("console-worker,")) summary.writer.reset();
    return summary;
}

std::uint64_t stamp_of(const fs::path& project) {
    struct stat file {};
    if (::stat((project / "project.json").c_str(), &file) != 0) return 0;
    // The file is replaced as a whole, so that its number changes with each writing.
    const auto number = static_cast<std::uint64_t>(file.st_ino) * 1'000'003;
    return number + static_cast<std::uint64_t>(file.st_mtim.tv_nsec) + static_cast<std::uint64_t>(file.st_mtim.tv_sec) +
           static_cast<std::uint64_t>(file.st_size) + 1;
}

bool is_project_name(const std::string& name) {
    if (name.size() > longest_name_bytes) return false;
    std::size_t characters = 0;
    std::string_view rest = name;
    while (!rest.empty()) {
        const Utf8Character next = first_character(rest);
        const bool is_sign = characters > 0 && std::string_view(" ._-").find(rest.front()) != std::string_view::npos;
        if (next.bytes == 0 || !(is_letter(next.code) || is_sign)) return false;
        rest.remove_prefix(next.bytes);
        ++characters;
    }
    return characters > 0 && characters <= longest_name;
}

}  // namespace qchopper
