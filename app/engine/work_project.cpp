// Items are read one by one, and each again when its turn comes: of a project of 50 pieces they have some 100 MB. The
// cost is that of their programs.

#include "app/engine/work_project.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <utility>

#include "app/engine/loop.h"
#include "app/engine/outputs.h"
#include "app/engine/prepare_project.h"
#include "app/jobs/ordered_job.h"
#include "app/jobs/piece_jobs.h"
#include "app/jobs/piece_program.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/shared_progress.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

WorkItem read_item(const fs::path& file, const std::string& program_version) {
    return item_from(read_file(file), file, program_version);
}

fs::path results_of(const fs::path& item) {
    return fs::absolute(item).parent_path().parent_path() / "results";
}

Sentence write_items(const fs::path& project) {
    return Sentence::with_key("write_items", {project.string()}, "write the items of the project");
}

// By name.
std::vector<fs::path> items_in(const fs::path& project) {
    std::vector<fs::path> items;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(items_folder(project), error)) {
        if (entry.path().extension() == item_ending) items.push_back(entry.path());
    }
    if (items.empty()) {
        throw InputError(InputFault::missing, project.string() + " has no items to work on", write_items(project));
    }
    std::sort(items.begin(), items.end());
    return items;
}

std::vector<fs::path> items_of_inputs(const std::vector<fs::path>& inputs) {
    std::vector<fs::path> items;
    for (const fs::path& input : inputs) {
        if (input.extension() == item_ending) {
            items.push_back(input);
            continue;
        }
        const std::vector<fs::path> own = items_in(input);
        items.insert(items.end(), own.begin(), own.end());
    }
    return items;
}

fs::path attempts_of(const fs::path& item) {
    return results_of(item).parent_path() / "attempts";
}

UnmadePiece unmade_piece(const WorkItem& item, const std::vector<SeenAttempt>& attempts) {
    UnmadePiece unmade;
    unmade.piece = item.job.piece.name;
    unmade.failures = failures(attempts);
    for (const SeenAttempt& own : attempts) {
        unmade.bytes = std::max(unmade.bytes, own.attempt.process_bytes);
        if (!unmade.last || own.age_s < unmade.last->age_s) unmade.last = own;
    }
    return unmade;
}

// The items of all pieces of a project, in their order.
std::vector<WorkItem> items_of_project(OpenProject& project, const std::string& program_version,
                                       const ProjectContext& context) {
    const Sentence write_again = write_items(project.folder());
    const std::vector<fs::path> files = items_in(project.folder());
    const Bytes cell = read_file(project.folder() / "cell.toml", settings_limit);
    std::vector<WorkItem> items;
    for (const fs::path& file : files) {
        context.check_cancelled();
        context.progress("items read", items.size(), files.size());
        items.push_back(read_item(file, program_version));
        if (items.back().cell_file != cell) {
            throw InputError(InputFault::use, file.string() + " is of another cell file than the project has now",
                             write_again);
        }
    }
    std::ranges::sort(items, {}, [](const WorkItem& item) { return item.job.piece_no; });
    const Uuid id = project_id(project.project());
    const auto is_of = [&](const WorkItem& item, const SolidRecord& piece) {
        return item.job.piece.name == piece.name && item.job.project_id == id;
    };
    if (!std::ranges::equal(items, project.project().pieces, is_of)) {
        throw InputError(InputFault::missing,
                         "the items in " + items_folder(project.folder()).string() + " are not those of its pieces",
                         write_again);
    }
    return items;
}

// Copies whole results into the cache, where write_jobs() finds them, and tells of the others.
void take_results(const fs::path& folder, const std::vector<WorkItem>& items, const ProjectContext& context,
                  GatherAnswer& answer) {
    const fs::path results = folder / "work" / "results";
    std::set<std::string> libraries;
    for (std::size_t i = 0; i < items.size(); ++i) {
        context.check_cancelled();
        context.progress("results checked", i, items.size());
        const WorkItem& item = items[i];
        if (!item.has_program()) continue;
        const std::optional<WorkedPiece> result = result_of(item, results);
        const std::vector<SeenAttempt> attempts = attempts_at(item.result, folder / "work" / "attempts");
        if (!result) {
            answer.unmade.push_back(unmade_piece(item, attempts));
            continue;
        }
        for (const SeenAttempt& own : attempts) {
            if (own.attempt.state == AttemptState::made) libraries.insert(own.attempt.libraries);
        }
        copy_result(item, results, folder / "cache");
        if (result->is_machine_refusing && !item.is_settled) answer.refused.push_back(*result);
    }
    std::ranges::sort(answer.unmade, {}, &UnmadePiece::piece);
    if (libraries.size() < 2) return;
    std::string all;
    for (const std::string& own : libraries) all += (all.empty() ? "" : "; ") + printable(own);
    context.warn("machines have other libraries, by which pictures in jobs may have other bytes: " + all);
}

// The project that all items are of; empty: of several, or of none.
fs::path project_of(const std::vector<fs::path>& inputs) {
    return inputs.size() == 1 && inputs.front().extension() != item_ending ? inputs.front() : fs::path();
}

// Of an item that is not to be tried again: nothing else is.
std::optional<UnmadePiece> given_up(const WorkItem& item, const fs::path& file) {
    const std::vector<SeenAttempt> attempts = attempts_at(item.result, attempts_of(file));
    if (failures(attempts) < most_failures || result_of(item, results_of(file))) return std::nullopt;
    return unmade_piece(item, attempts);
}

// work_on() with a record of the attempt, unless the result is there.
WorkedPiece work_recorded(const WorkItem& item, const fs::path& file, const Context& context) {
    if (std::optional<WorkedPiece> known = result_of(item, results_of(file))) return *std::move(known);
    AttemptRecord record(item.job.piece.name, item.result, attempts_of(file));
    try {
        WorkedPiece piece = work_on(item, results_of(file), record.watched(context));
        record.end(AttemptState::made);
        return piece;
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        record.end(AttemptState::failed, error.what());
        throw;
    }
}

}  // namespace

std::vector<std::size_t> items_of(const Shard& shard, std::span<const double> efforts) {
    std::vector<std::size_t> order(efforts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return efforts[a] > efforts[b]; });
    std::vector<double> loads(shard.count, 0);
    std::vector<std::size_t> own;
    for (const std::size_t item : order) {
        const auto least = std::min_element(loads.begin(), loads.end());
        *least += efforts[item];
        if (static_cast<std::size_t>(least - loads.begin()) == shard.number) own.push_back(item);
    }
    return own;
}

WorkAnswer work_items(const std::vector<fs::path>& inputs, const WorkOptions& options,
                      const std::string& program_version, const std::function<void(const WorkedPiece&)>& on_piece,
                      const ProjectContext& context) {
    std::vector<fs::path> items;
    std::vector<double> efforts;
    for (const fs::path& file : items_of_inputs(inputs)) {
        const WorkItem item = read_item(file, program_version);
        if (!item.has_program()) continue;
        items.push_back(file);
        efforts.push_back(item.effort);
    }
    WorkAnswer answer{project_of(inputs), options.shard, items.size(), {}};
    std::vector<std::size_t> own = items_of(options.shard, efforts);
    std::erase_if(own, [&](std::size_t i) {
        if (options.has_retry) return false;
        const std::optional<UnmadePiece> piece = given_up(read_item(items[i], program_version), items[i]);
        if (piece) answer.unmade.push_back(*piece);
        return piece.has_value();
    });
    std::ranges::sort(answer.unmade, {}, &UnmadePiece::piece);
    context.saved("Programs that are made are kept, and the same command makes the rest.");
    answer.pieces.resize(own.size());
    SharedProgress progress(context, "programs made", own.size());
    std::mutex telling;
    std::exception_ptr failure;
    std::atomic<std::size_t> next = 0;
    parallel_for(0, own.size(), [&](std::size_t) {  // the largest first, whatever the order of the loop
        context.check_cancelled();
        const std::size_t k = next++;
        const fs::path& file = items[own[k]];
        Context quiet;
        quiet.cancelled = context.cancelled;
        quiet.on_message = [&](const std::string& text) {
            const std::lock_guard lock(telling);
            context.message(text);
        };
        const WorkItem item = read_item(file, program_version);
        try {
            answer.pieces[k] = work_recorded(item, file, quiet);
        } catch (const Cancelled&) {
            throw;
        } catch (const InputError&) {  // what one piece cannot write no other can
            throw;
        } catch (const std::exception& error) {
            const std::lock_guard lock(telling);
            context.message("piece " + item.job.piece.name + " failed: " + error.what());
            if (!failure) failure = std::current_exception();
            return;
        }
        {
            const std::lock_guard lock(telling);
            if (on_piece) on_piece(answer.pieces[k]);
        }
        progress.add(1);
    });
    if (failure) std::rethrow_exception(failure);
    std::sort(answer.pieces.begin(), answer.pieces.end(),
              [](const WorkedPiece& a, const WorkedPiece& b) { return a.name < b.name; });
    return answer;
}

std::vector<ItemEstimate> item_estimates(const fs::path& folder, const std::string& program_version) {
    constexpr double at_least = 0.3e9;
    constexpr double per_m2 = 0.6e9;  // of the box's surface: maps have cells of a quarter of a millimetre
    std::vector<ItemEstimate> estimates;
    for (const fs::path& file : items_in(folder)) {
        const WorkItem item = read_item(file, program_version);
        if (!item.has_program()) continue;
        const Vec3 size = item.job.setup.block.size;
        const double m2 = 2e-6 * (size.x * size.y + size.y * size.z + size.z * size.x);
        estimates.push_back({item.job.piece.name, item.effort, at_least + per_m2 * m2,
                             result_of(item, results_of(file)).has_value(),
                             failures(attempts_at(item.result, attempts_of(file)))});
    }
    return estimates;
}

WorkAnswer work_done(const std::vector<fs::path>& inputs, const std::string& program_version) {
    WorkAnswer answer{project_of(inputs), {}, 0, {}};
    std::map<std::pair<std::string, std::uint64_t>, double> processes;  // by host and number
    for (const fs::path& file : items_of_inputs(inputs)) {
        const WorkItem item = read_item(file, program_version);
        if (!item.has_program()) continue;
        ++answer.piece_count;
        const std::vector<SeenAttempt> attempts = attempts_at(item.result, attempts_of(file));
        for (const SeenAttempt& own : attempts) {
            double& spent = processes[{own.attempt.host, own.attempt.process}];
            spent = std::max(spent, own.attempt.process_cpu_s);
        }
        if (const auto result = result_of(item, results_of(file))) {
            answer.pieces.push_back(*result);
        } else {
            answer.unmade.push_back(unmade_piece(item, attempts));
            answer.left_s += item.effort;
        }
    }
    for (const auto& process : processes) answer.spent_s += process.second;
    return answer;
}

GatherAnswer gather_project(const fs::path& folder, bool makes_missing, const std::string& program_version,
                            const ProjectContext& context) {
    GatherAnswer answer;
    {
        LockedProject open(folder, {}, context);
        std::vector<WorkItem> items = items_of_project(open.project, program_version, context);
        take_results(folder, items, context, answer);
        context.saved("Programs that are made are kept, and the same command goes on with them.");
        if (answer.unmade.empty() && answer.refused.empty()) {
            std::vector<Piece> pieces;
            std::vector<PlacedSetup> setups;
            for (WorkItem& item : items) {
                pieces.push_back(std::move(item.job.piece));
                setups.push_back(std::move(item.piece_setup));
            }
            open.project.set_has_programs(true);
            open.project.take_pieces(std::move(pieces), std::move(setups));
            answer.prepared = open.project.write_outputs({}, program_version, {}, context);
            return answer;
        }
    }
    if (!makes_missing) return answer;
    PrepareOptions options{program_version, {}};
    options.has_programs = true;
    answer.prepared = prepare_project(folder, {}, options, context);
    return answer;
}

}  // namespace qchopper
