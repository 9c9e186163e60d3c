// The document is kept under the hashes of job and cell file, and is taken while all that it names is there. The cost
// is that of the replay.

#include "app/console/worker/shown_replay.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/display/display_format.h"
#include "app/display/display_path.h"
#include "app/display/make_display.h"
#include "app/pictures/deviation_colours.h"
#include "app/store/caches/cache_file.h"
#include "base/files/gzip.h"
#include "base/json_fields.h"
#include "base/timings.h"
#include "sim/replay/stages/stock_surface.h"

namespace qchopper {

using namespace json_values;

template <class V, Of<ShownStage> T>
void fields(V& v, T& stage) {
    v("mesh", stage.mesh);
    v("points", stage.points);
    v("seconds", stage.seconds);
    v("removed_mm3", stage.removed_mm3);
}

template <class V, Of<ShownSection> T>
void fields(V& v, T& section) {
    v("file", section.file);
    v("tool", section.tool);
    v("orientation", section.orientation);
    v("points", section.points);
}

template <class V, Of<ShownTool> T>
void fields(V& v, T& tool) {
    v("number", tool.number);
    v("name", tool.name);
}

template <class V, Of<ShownDeviation> T>
void fields(V& v, T& deviation) {
    v("mesh", deviation.mesh);
    v("classes", deviation.classes);
}

template <class V, Of<ShownReplay> T>
void fields(V& v, T& replay) {
    v("piece", replay.piece);
    v("part", replay.part);
    v("parts", replay.parts);
    v("job", replay.job);
    v("positive", replay.is_positive);
    v("cell_mm", replay.cell_mm);
    v("stock_off_mm", replay.stock_off_mm);
    v("time_s", replay.time_s);
    v("removed_mm3", replay.removed_mm3);
    v("path", replay.path);
    v("sections", replay.sections);
    v("tools", replay.tools);
    v("tool_axes", replay.tool_axes);
    v("stages", replay.stages);
    v("deviation", replay.deviation);
}

namespace {

namespace fs = std::filesystem;

// To be raised whenever another replay is made of the same job.
constexpr std::uint32_t version_of_replay = 1;

constexpr const char* replay_ending = ".replay";
constexpr std::size_t stage_faces = 100'000;  // of a stage, about
constexpr std::size_t kept_replays = 16;
constexpr std::size_t kept_files = 32 * kept_replays;  // of each kind

CacheWriter key_of(const ReplayedJob& about, const StageOptions& options, const std::string& what) {
    CacheWriter key;
    key.put(version_of_replay);
    key.put(what);
    key.put(to_hex(about.job));
    key.put(to_hex(about.cell));
    key.put(options.cell);
    key.put(options.stages);
    return key;
}

bool is_there(const ShownReplay& replay, const fs::path& folder) {
    const auto has = [&](DisplayKind kind, const std::string& id) {
        return kept_display(folder, kind, id).has_value();
    };
    const bool has_deviation = !replay.deviation || (has(DisplayKind::mesh, replay.deviation->mesh) &&
                                                     has(DisplayKind::states, replay.deviation->classes));
    return has_deviation && has(DisplayKind::path, replay.path) &&
           std::ranges::all_of(replay.stages,
                               [&](const ShownStage& stage) { return has(DisplayKind::mesh, stage.mesh); });
}

std::optional<ShownReplay> kept_replay(const fs::path& folder, const fs::path& file) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    const std::string json = in.text();
    if (!in.is_whole()) return std::nullopt;
    try {
        ShownReplay replay;
        from_document(json, replay);
        if (is_there(replay, folder)) return replay;
    } catch (const std::runtime_error&) {  // it is made again
    }
    return std::nullopt;
}

DisplayPath display_path(const std::vector<WayPoint>& way, const Box& block) {
    constexpr double ms_per_s = 1000;
    Box box = block;
    for (const WayPoint& point : way) extend(box, point.tip);
    DisplayPath path;
    path.grid = display_grid(box);
    for (const WayPoint& point : way) {
        path.points.push_back(nearest_point(path.grid, point.tip));
        path.ms.push_back(static_cast<std::uint32_t>(std::llround(ms_per_s * point.seconds)));
        path.lines.push_back(point.place.line);
        path.kinds.push_back(static_cast<std::uint8_t>(point.kind));
    }
    return path;
}

std::vector<ShownSection> sections_of(const std::vector<WayPoint>& way, const std::vector<std::string>& files) {
    std::vector<ShownSection> sections;
    for (const WayPoint& point : way) {
        ShownSection own{files.at(point.place.file), point.tool, point.orientation + 1, 0};
        if (!sections.empty()) own.points = sections.back().points;
        if (sections.empty() || own != sections.back()) {
            own.points = 0;
            sections.push_back(std::move(own));
        }
        ++sections.back().points;
    }
    return sections;
}

std::vector<ShownTool> tools_of(const std::vector<ShownSection>& sections, const ReplayedJob& about) {
    std::vector<ShownTool> tools;
    for (const auto& [number, name] : about.tools) {
        if (std::ranges::find(sections, number, &ShownSection::tool) != sections.end()) tools.push_back({number, name});
    }
    return tools;
}

std::optional<ShownDeviation> shown_deviation(const JobToReplay& job, const fs::path& folder, const Context& context) {
    const std::optional<JobDeviation> found = job.deviation(context);
    const TriangleMesh& mesh = job.about().mesh;
    if (!found || found->mm.size() != mesh.triangles.size()) return std::nullopt;
    const StageTimer stage(context, "deviation made ready for display");
    const ClassedDisplay shown = display_classes(mesh, deviation_classes(found->mm, found->is_given_up),
                                                 display_grid(job.about().block), folder, context);
    return ShownDeviation{shown.mesh.id, shown.classes.id};
}

ShownReplay made_replay(const JobToReplay& job, const StageOptions& options, const fs::path& folder,
                        const Context& context) {
    const ReplayedJob& about = job.about();
    const double spacing = surface_spacing(about.block, stage_faces, options.cell);
    const DisplayGrid grid = display_grid(about.block);
    ShownReplay shown;
    shown.piece = about.piece;
    shown.part = about.part;
    shown.parts = about.parts;
    shown.job = to_hex(about.job);
    shown.is_positive = about.is_positive;
    shown.cell_mm = options.cell;
    const auto take = [&](const ReplayStage& stage, const StockModel& stock_model) {
        const CacheWriter key = key_of(about, options, "stage " + std::to_string(shown.stages.size()));
        const DisplayFile file =
            display_surface(stock_surface(stock_model, spacing, context), std::sqrt(3.0) * spacing, grid, key, folder);
        shown.stock_off_mm = file.deviation_mm;
        shown.stages.push_back({file.id, stage.points, stage.seconds, stage.removed_mm3});
    };
    const StagedReplay replay = job.replay(options, take, context);
    shown.time_s = replay.seconds;
    shown.removed_mm3 = replay.removed_mm3;
    const auto make_path = [&] {
        const Bytes encoded = encode_display_path(display_path(replay.way, about.block));
        return DisplayFile{display_id(encoded), 0, gzip(encoded)};
    };
    shown.path = kept_or_made(folder, DisplayKind::path, key_of(about, options, "path"), make_path).id;
    shown.sections = sections_of(replay.way, about.files);
    shown.tools = tools_of(shown.sections, about);
    shown.tool_axes = about.tool_axes;
    shown.deviation = shown_deviation(job, folder, context);
    return shown;
}

}  // namespace

fs::path replay_folder(const fs::path& project) {
    return project / "cache" / "replay";
}

ShownReplay shown_replay(const ReplayOrder& order, const Context& context) {
    const JobToReplay job(order, context);
    const StageOptions options;
    const fs::path folder = replay_folder(order.project);
    const fs::path file = cache_file(folder, key_of(job.about(), options, "replay"), replay_ending);
    if (std::optional<ShownReplay> kept = kept_replay(folder, file)) {
        kept->is_positive = job.about().is_positive;
        return *std::move(kept);
    }
    ShownReplay replay = made_replay(job, options, folder, context);
    CacheWriter content;
    content.put(to_document(replay));
    keep(file, content);
    remove_oldest(folder, replay_ending, kept_replays);
    remove_oldest_display(folder, kept_files);
    return replay;
}

Document document(const ShownReplay& replay) {
    return compose_line(nlohmann::ordered_json::parse(to_document(replay)));
}

}  // namespace qchopper
