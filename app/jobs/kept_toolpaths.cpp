// Moves are written in columns: a struct of theirs has bytes that nobody sets. O(bytes).

#include "app/jobs/kept_toolpaths.h"

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "app/store/caches/cache_file.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

void put(CacheWriter& out, const PathRun& run) {
    out.put(run.start);
    out.put(run.hole);
    std::vector<double> numbers;
    std::vector<std::uint8_t> kinds;
    numbers.reserve(5 * run.moves.size());
    kinds.reserve(run.moves.size());
    for (const PathMove& move : run.moves) {
        numbers.insert(numbers.end(), {move.tip.x, move.tip.y, move.tip.z, move.rounding, move.feed});
        kinds.push_back(static_cast<std::uint8_t>(move.kind));
    }
    out.put_all(numbers);
    out.put_all(kinds);
}

PathRun run_from(CacheReader& in) {
    PathRun run;
    run.start = in.vec3();
    run.hole = in.get<std::size_t>();
    const std::vector<double> numbers = in.get_all<double>();
    const std::vector<std::uint8_t> kinds = in.get_all<std::uint8_t>();
    if (numbers.size() != 5 * kinds.size()) throw std::runtime_error("moves that are cut short");
    run.moves.reserve(kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] > static_cast<std::uint8_t>(MoveKind::retract)) throw std::runtime_error("a move of no kind");
        const double* own = &numbers[5 * i];
        run.moves.push_back({{own[0], own[1], own[2]}, static_cast<MoveKind>(kinds[i]), own[3], own[4]});
    }
    return run;
}

void put(CacheWriter& out, const Operation& operation) {
    out.put(static_cast<std::uint8_t>(operation.kind));
    out.put(operation.tool);
    out.put(operation.orientation);
    for (const double value :
         {operation.feed, operation.approach_feed, operation.link_feed, operation.rpm, operation.rounding,
          operation.stepover, operation.stepdown, operation.allowance, operation.scallop, operation.retract}) {
        out.put(value);
    }
    out.put(operation.runs.size());
    for (const PathRun& run : operation.runs) put(out, run);
}

Operation operation_from(CacheReader& in) {
    Operation operation;
    operation.kind = in.one_of(OperationKind::drilling);
    operation.tool = in.get<std::size_t>();
    operation.orientation = in.get<std::size_t>();
    for (double* value :
         {&operation.feed, &operation.approach_feed, &operation.link_feed, &operation.rpm, &operation.rounding,
          &operation.stepover, &operation.stepdown, &operation.allowance, &operation.scallop, &operation.retract}) {
        *value = in.get<double>();
    }
    for (std::size_t runs = in.count(); runs > 0; --runs) operation.runs.push_back(run_from(in));
    return operation;
}

void put(CacheWriter& out, const std::optional<std::size_t>& index) {
    out.put(static_cast<std::uint8_t>(index.has_value()));
    out.put(index.value_or(0));
}

std::optional<std::size_t> index_from(CacheReader& in) {
    const bool has_index = in.get<std::uint8_t>() != 0;
    const auto index = in.get<std::size_t>();
    return has_index ? std::optional(index) : std::nullopt;
}

void put(CacheWriter& out, const Toolpath& path) {
    out.put(path.cell);
    out.put(path.path_tolerance);
    out.put(path.operations.size());
    for (const Operation& operation : path.operations) put(out, operation);
    out.put(path.unused.size());
    for (const UnusedTool& unused : path.unused) {
        put(out, unused.tool);
        put(out, unused.orientation);
        out.put(unused.because);
    }
}

Toolpath toolpath_from(CacheReader& in) {
    Toolpath path;
    path.cell = in.get<double>();
    path.path_tolerance = in.get<double>();
    for (std::size_t operations = in.count(); operations > 0; --operations) {
        path.operations.push_back(operation_from(in));
    }
    for (std::size_t unused = in.count(); unused > 0; --unused) {
        UnusedTool tool;
        tool.tool = index_from(in);
        tool.orientation = index_from(in);
        tool.because = in.text();
        path.unused.push_back(std::move(tool));
    }
    return path;
}

void put(CacheWriter& out, const HeightField& map) {
    for (const Vec3& row : map.piece_in_field.row) out.put(row);
    out.put(map.piece_in_field.shift);
    out.put(map.cell);
    out.put(map.columns);
    out.put(map.rows);
    out.put_all(map.height);
}

HeightField map_from(CacheReader& in) {
    HeightField map;
    for (Vec3& row : map.piece_in_field.row) row = in.vec3();
    map.piece_in_field.shift = in.vec3();
    map.cell = in.get<double>();
    map.columns = in.get<std::size_t>();
    map.rows = in.get<std::size_t>();
    map.height = in.get_all<float>();
    const bool is_of_size =
        map.columns > 0 && map.height.size() % map.columns == 0 && map.height.size() / map.columns == map.rows;
    if (!is_of_size) throw std::runtime_error("a map of another size");
    return map;
}

FollowedToolpath followed_from(CacheReader& in) {
    FollowedToolpath followed;
    followed.none_because = in.text();
    followed.is_machine_refusing = in.get<std::uint8_t>() != 0;
    if (in.get<std::uint8_t>() != 0) followed.place = block_placement_from(in);
    followed.toolpath = toolpath_from(in);
    for (std::size_t maps = in.count(); maps > 0; --maps) {
        RemovedFoam removed;
        removed.orientation = in.get<std::size_t>();
        removed.down_to = map_from(in);
        followed.removed.push_back(std::move(removed));
    }
    return followed;
}

}  // namespace

fs::path toolpath_file(const fs::path& folder, const ProgramSource& source) {
    return cache_file(folder, toolpath_source(source), toolpaths_ending);
}

std::optional<FollowedToolpath> kept_toolpath(const fs::path& file) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    try {
        FollowedToolpath followed = followed_from(in);
        return in.is_whole() ? std::optional(std::move(followed)) : std::nullopt;
    } catch (const std::runtime_error&) {
        return std::nullopt;  // of another schema: made again
    }
}

void keep_toolpath(const fs::path& file, const FollowedToolpath& followed) {
    CacheWriter out;
    out.put(followed.none_because);
    out.put(static_cast<std::uint8_t>(followed.is_machine_refusing));
    out.put(static_cast<std::uint8_t>(followed.place.has_value()));
    if (followed.place) put(out, *followed.place);
    put(out, followed.toolpath);
    out.put(followed.removed.size());
    for (const RemovedFoam& removed : followed.removed) {
        out.put(removed.orientation);
        put(out, removed.down_to);
    }
    keep(file, out);
}

}  // namespace qchopper
