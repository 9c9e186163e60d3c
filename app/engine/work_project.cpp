// Items are read one by one, and each again when its turn comes: of a project of 50 pieces they have some 100 MB. The
// cost is that of their programs.

#include "app/engine/work_project.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

#include "app/jobs/piece_jobs.h"
#include "app/jobs/piece_program.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/shared_progress.h"
#include "segment/joint/piece_joints.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

WorkItem read_item(const fs::path& file, const std::string& program_version) {
    return item_from(read_file(file), file, program_version);
}

fs::path items_folder(const fs::path& project) {
    return project / "work" / "items";
}

fs::path results_of(const fs::path& item) {
    return fs::absolute(item).parent_path().parent_path() / "results";
}

// By name.
std::vector<fs::path> items_in(const fs::path& project) {
    std::vector<fs::path> items;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(items_folder(project), error)) {
        if (entry.path().extension() == item_ending) items.push_back(entry.path());
    }
    if (items.empty()) {
        throw InputError(InputFault::missing, project.string() + " has no items to work on",
                         "qchopper prepare " + shell_word(project) + " --items");
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

// The project that all items are of; empty: of several, or of none.
fs::path project_of(const std::vector<fs::path>& inputs) {
    return inputs.size() == 1 && inputs.front().extension() != item_ending ? inputs.front() : fs::path();
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

WrittenItems write_items(OpenProject& project, const std::string& program_version, const ProjectContext& context) {
    const Cell& cell = project.setups()->cell();
    const std::string because = no_programs_for(cell);
    if (!because.empty()) throw InputError(InputFault::use, "no programs are made for " + cell.name + ": " + because);
    const Segmentation& segmentation = project.segmentation();
    const std::vector<PieceJoint> joints = piece_joints(segmentation.pieces, joint_settings(&cell), context);
    fs::remove_all(project.folder() / "work");
    fs::create_directories(items_folder(project.folder()));
    WrittenItems written;
    for (std::size_t i = 0; i < segmentation.pieces.size(); ++i) {
        context.check_cancelled();
        context.progress("items written", i, segmentation.pieces.size());
        const std::optional<WorkItem> item =
            item_of(project.folder(), project.project(), segmentation, i, *project.setups(), joints, program_version);
        if (!item) continue;
        write_file(items_folder(project.folder()) / (segmentation.pieces[i].name + item_ending), to_bytes(*item));
        ++written.count;
        written.all_s += item->effort;
        written.largest_s = std::max(written.largest_s, item->effort);
    }
    return written;
}

WorkAnswer work_items(const std::vector<fs::path>& inputs, const Shard& shard, const std::string& program_version,
                      const std::function<void(const WorkedPiece&)>& on_piece, const ProjectContext& context) {
    const std::vector<fs::path> items = items_of_inputs(inputs);
    std::vector<double> efforts;
    efforts.reserve(items.size());
    for (const fs::path& item : items) efforts.push_back(read_item(item, program_version).effort);
    const std::vector<std::size_t> own = items_of(shard, efforts);
    context.saved("Programs that are made are kept, and the same command makes the rest.");
    WorkAnswer answer{project_of(inputs), shard, items.size(), {}};
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
        const Vec3 size = item.job.setup.block.size;
        const double m2 = 2e-6 * (size.x * size.y + size.y * size.z + size.z * size.x);
        estimates.push_back({item.job.piece.name, item.effort, at_least + per_m2 * m2,
                             result_of(item, results_of(file)).has_value(),
                             failures(attempts_at(item.result, attempts_of(file)))});
    }
    return estimates;
}

WorkAnswer work_done(const std::vector<fs::path>& inputs, const std::string& program_version) {
    const std::vector<fs::path> items = items_of_inputs(inputs);
    WorkAnswer answer{project_of(inputs), {}, items.size(), {}};
    std::map<std::pair<std::string, std::uint64_t>, double> processes;  // by host and number
    for (const fs::path& file : items) {
        const WorkItem item = read_item(file, program_version);
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

std::vector<UnmadePiece> take_results(const fs::path& folder, const std::string& program_version,
                                      const ProjectContext& context) {
    std::vector<UnmadePiece> unmade;
    fs::create_directories(folder / "cache");
    const std::vector<fs::path> items = items_in(folder);
    for (std::size_t i = 0; i < items.size(); ++i) {
        context.check_cancelled();
        context.progress("results checked", i, items.size());
        const WorkItem item = read_item(items[i], program_version);
        const fs::path result = results_of(items[i]) / item.result;
        if (result_of(item, results_of(items[i]))) {
            write_file(folder / "cache" / item.result, read_file(result));
        } else {
            unmade.push_back(unmade_piece(item, attempts_at(item.result, attempts_of(items[i]))));
        }
    }
    return unmade;
}

}  // namespace qchopper
