// A row of options per command.

#include "app/console/command_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

namespace qchopper {
namespace {

// The shortest text that is read as the same number.
std::string json_number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
    return {text.begin(), end};
}

void add_option(CommandWords& words, const char* option, const std::optional<std::string>& value) {
    if (value) words.insert(words.end(), {option, *value});
}

std::optional<std::string> number_text(const std::optional<double>& value) {
    if (!value) return {};
    return json_number(*value);
}

// The options of repair and segment.
void add_repair(CommandWords& words, const RepairBody& repair) {
    add_option(words, "--fill", repair.fill);
    add_option(words, "--snap-borders", number_text(repair.snap_borders_mm));
    add_option(words, "--alpha-wrap", number_text(repair.alpha_wrap_mm));
    if (repair.resolve_self_intersections) words.emplace_back("--resolve-self-intersections");
    if (repair.smooth_pen_grooves) words.emplace_back("--smooth-pen-grooves");
}

// What each kind of work of a project runs, before the folder and after it.
struct WorkRow {
    WorkKind kind;
    const char* command;
    const char* option;
};
constexpr WorkRow work_rows[] = {{WorkKind::search, "segment", "--auto"},  {WorkKind::prepare, "prepare", ""},
                                 {WorkKind::setups, "setup", ""},          {WorkKind::verify, "verify", ""},
                                 {WorkKind::replay, "console-replay", ""}, {WorkKind::dry_run, "dry-run", ""},
                                 {WorkKind::export_pieces, "export", ""},  {WorkKind::guide, "guide", ""}};

struct PaintedRow {
    const char* file;
    const char* option;
};
constexpr PaintedRow painted_rows[] = {{"ignore.ply", "--ignore-surface"}, {"no_cut.ply", "--no-cut"}};

CommandWords printing_json(CommandWords words) {
    words.insert(words.end(), {"--json", "--progress", "json"});
    return words;
}

}  // namespace

CommandWords worker_words(const std::filesystem::path& project) {
    return printing_json({"console-worker", project.string()});
}

CommandWords mesh_words(const std::filesystem::path& scan, const std::filesystem::path& folder) {
    return printing_json({"console-mesh", scan.string(), folder.string()});
}

CommandWords paint_words(const std::filesystem::path& scan, const std::filesystem::path& file,
                         const std::filesystem::path& folder, const std::optional<std::string>& units) {
    CommandWords words{"console-paint", scan.string(), file.string(), folder.string()};
    add_option(words, "--units", units);
    return printing_json(std::move(words));
}

CommandWords check_words(const std::filesystem::path& scan, const CheckBody& body) {
    CommandWords words{"inspect", scan.string()};
    add_option(words, "--units", body.units);
    if (body.deep) words.emplace_back("--deep");
    return printing_json(std::move(words));
}

CommandWords repair_words(const std::filesystem::path& scan, const std::filesystem::path& out, const RepairBody& body,
                          const std::optional<std::string>& units) {
    CommandWords words{"repair", scan.string(), "--out", out.string()};
    add_option(words, "--units", units);
    add_repair(words, body);
    return printing_json(std::move(words));
}

CommandWords project_words(const std::filesystem::path& scan, const std::filesystem::path& project,
                           const NewProjectBody& body, const ProjectFiles& files) {
    CommandWords words{"segment", scan.string(), "--out", project.string()};
    add_option(words, "--units", body.units);
    add_option(words, "--scale", number_text(body.scale));
    add_option(words, "--preset", body.preset);
    add_option(words, "--fragment-volume", number_text(body.fragment_volume_mm3));
    if (body.size_ok) words.emplace_back("--size-ok");
    if (files.cell) words.insert(words.end(), {"--cell", files.cell->string()});
    if (files.plan) words.insert(words.end(), {"--replay", files.plan->string()});
    std::error_code error;
    for (const PaintedRow& row : painted_rows) {
        if (!files.painted || !std::filesystem::exists(*files.painted / row.file, error)) continue;
        words.insert(words.end(), {row.option, (*files.painted / row.file).string()});
    }
    add_repair(words, body.repair);
    return printing_json(std::move(words));
}

CommandWords plan_words(const std::filesystem::path& project, const std::filesystem::path& file) {
    return printing_json({"segment", project.string(), "--plan", file.string()});
}

std::optional<CommandWords> work_words(const std::filesystem::path& project, const WorkBody& body) {
    const auto* const row = std::ranges::find(work_rows, body.kind, &WorkRow::kind);
    if (row == std::end(work_rows)) return {};
    CommandWords words{row->command, project.string()};
    if (*row->option != '\0') words.emplace_back(row->option);
    add_option(words, "--piece", body.piece);
    if (body.part) words.insert(words.end(), {"--part", std::to_string(*body.part)});
    return printing_json(std::move(words));
}

CommandWords dispatch_words(const DispatchWords& what) {
    const char* const kind = what.order.is_for_real_cell ? "real" : "simulated";
    CommandWords words{"dispatch", what.project.string(), "--job", what.job, "--expect", kind};
    add_option(words, "--to", what.to);
    if (what.to && what.drop) words.insert(words.end(), {"--drop", what.drop->string()});
    if (what.to && !what.drop) words.emplace_back("--chunks");
    if (what.order.is_for_real_cell) words.emplace_back("--yes");
    if (what.order.is_again) words.emplace_back("--again");
    if (what.order.accept_unreachable) words.emplace_back("--accept-unreachable");
    return printing_json(std::move(words));
}

}  // namespace qchopper
