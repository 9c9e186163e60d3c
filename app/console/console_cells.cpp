// Cells, plans, and the queue: what of the console may set a machine in motion. Nothing here starts a job: the hand-off
// does (app/dispatch), in a process of its own, after all that a plan has checked was checked again. A plan costs
// reading the jobs: O(their bytes).

#include <algorithm>
#include <array>

#include "app/console/console.h"
#include "app/console/console_answers.h"
#include "app/console/console_folder.h"
#include "app/console/random_digits.h"
#include "app/console/worker/console_requests.h"
#include "app/console/worker/resident_project.h"
#include "app/dispatch/state_folder.h"
#include "app/report/cell/journal_report.h"
#include "base/error.h"
#include "base/files/file.h"
#include "cam/cell/cell.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr Clock::duration plan_life = 120s;
constexpr std::array commands{"unhold", "stop", "abort", "clear", "reset"};

}  // namespace

std::shared_ptr<CellLine> Console::cell(const std::string& id) const {
    const std::lock_guard lock(changing_);
    const auto found = cells_.find(id);
    return found == cells_.end() ? nullptr : found->second;
}

std::shared_ptr<CellLine> Console::cell_at(const std::string& address, const std::string& name,
                                           const std::optional<fs::path>& cell_file) {
    const std::lock_guard lock(changing_);
    std::shared_ptr<CellLine>& line = cells_[id_of_name(address)];
    if (line == nullptr) {
        line = std::make_shared<CellLine>(id_of_name(address), address, name, cell_file, [this](const CellView& view) {
            events_.publish("cell", to_json(view), view.id);
        });
    }
    return line;
}

std::shared_ptr<CellLine> Console::cell_of_project(const fs::path& project) {
    if (options_.to) return cell_at(*options_.to, options_.tell_simulator ? "cell of this server" : *options_.to, {});
    const fs::path file = project / "cell.toml";
    std::error_code error;
    if (!fs::exists(file, error)) return {};
    const Cell described = read_cell(file);
    if (!described.link.to) return {};
    const std::string& address = *described.link.to;
    // A copy, because the cell stays where a project goes.
    const fs::path kept = options_.scratch / (id_of_name(address) + ".toml");
    {
        const std::lock_guard lock(changing_);
        const auto [known, is_new] = described_cells_.try_emplace(address, described.name, described.id);
        const auto& [name, id] = known->second;
        if (name != described.name || id != described.id) {
            throw InputError(InputFault::config,
                             "the cell at " + address + " is cell " + std::to_string(described.id) + ", " +
                                 described.name + ", by the cell file of this project, and cell " + std::to_string(id) +
                                 ", " + name + ", by that of another one",
                             "correct the cell file that is wrong, then start the server again");
        }
        if (is_new) write_file(kept, read_file(file, settings_limit));
    }
    return cell_at(address, described.name, kept);
}

HttpAnswer Console::plan(const std::string& id, const HttpRequest& request) {
    const fs::path folder = project_folder(id);
    if (options_.dispatch == DispatchMode::none) return refusal(409, "this server hands no jobs over");
    if (works_.is_busy(id))
        return refusal(423, "work on this project is under way", "wait until it is done, or stop it");
    PlanOrder order = read_plan(request.body);
    const std::shared_ptr<CellLine> line = cell_of_project(folder);
    if (line == nullptr) return refusal(409, "the cell file of this project names no address", "add the address to it");
    const CellView view = line->view();
    if (view.link != CellLinkState::connected) {
        return refusal(502, "the cell at " + view.address + " does not answer", "look at the cell and its network");
    }
    order.is_for_real_cell = view.kind == CellKind::real;
    if (order.is_for_real_cell && options_.dispatch != DispatchMode::real) {
        return refusal(409, "this server hands jobs to simulated cells only", "start it for real cells");
    }
    const std::string revision = revision_of(request);
    const WorkerAnswer answer = workers_.ask(folder, {WorkerTask::plan, revision, to_json(order)});
    if (answer.status != 200) return http_answer(answer);
    const DispatchPlan jobs = read_dispatch_plan(read_project_answer(answer.document).document);
    if (!jobs.refused.empty()) return refusal(409, jobs.refused.front(), "see the jobs of this project");
    const std::string plan_id = random_digits();
    {
        const std::lock_guard lock(changing_);
        std::erase_if(plans_, [](const auto& entry) { return entry.second.until < Clock::now(); });
        plans_[plan_id] = {folder, revision, view.id, order, jobs, Clock::now() + plan_life};
    }
    const double seconds = std::chrono::duration<double>(plan_life).count();
    return json_answer(201, to_json(OfferedPlan{jobs, plan_id, view.kind, seconds}));
}

HttpAnswer Console::hand_over(const HttpRequest& request) {
    const HandOverBody body = read_hand_over(request.body);
    Plan plan;
    {
        const std::lock_guard lock(changing_);
        const auto found = plans_.find(body.plan);
        if (found == plans_.end() || found->second.until < Clock::now()) {
            return refusal(409, "this plan was used already, or is too old", "look at the jobs again");
        }
        if (found->second.order.is_for_real_cell && body.typed != found->second.jobs.cell) {
            return refusal(409, "the name of the real cell was not typed", "type " + found->second.jobs.cell);
        }
        plan = std::move(found->second);
        plans_.erase(found);
    }
    const std::shared_ptr<CellLine> line = cell(plan.cell);
    const CellView view = line == nullptr ? CellView{} : line->view();
    const CellKind wanted = plan.order.is_for_real_cell ? CellKind::real : CellKind::simulated;
    if (view.link != CellLinkState::connected || view.kind != wanted) {
        return refusal(409, "the cell is not the one of the plan any more", "look at the cell, then make a plan again");
    }
    if (revision_of_project(plan.project) != plan.revision) {
        return refusal(412, "the project has changed since the plan was made", "make a plan again");
    }
    std::vector<QueueEntry> entries;
    for (const PlannedJob& job : plan.jobs.jobs) {
        QueueEntry entry;
        {
            const std::lock_guard lock(changing_);
            entry.id = options_.server + "-" + std::to_string(++handed_over_);
        }
        entry.project = id_of_name(plan.project.filename());
        entry.piece = job.piece;
        entry.part = job.part;
        entry.job = job.job;
        entry.cell = plan.cell;
        entry.address = view.address;
        entry.words = words(dispatch_words({plan.project, job.job, plan.order, options_.to, options_.drop}));
        entries.push_back(std::move(entry));
    }
    queue_.add(std::move(entries));
    return json_answer(202, to_json(ShownQueue{queue_.all()}));
}

HttpAnswer Console::change_queue(const HttpRequest& request) {
    const QueueBody body = read_queue(request.body);
    if (body.action == QueueAction::pause) queue_.pause();
    if (body.action == QueueAction::go_on) queue_.go_on();
    if (body.action == QueueAction::remove && !queue_.remove(body.entry.value_or(""))) {
        return refusal(409, "this job does not wait any more", "look at the queue");
    }
    return json_answer(200, to_json(ShownQueue{queue_.all()}));
}

HttpAnswer Console::command_cell(const std::string& id, const HttpRequest& request) {
    const std::shared_ptr<CellLine> line = cell(id);
    if (line == nullptr) return refusal(404, "there is no cell " + id + " here", "look at the list of cells");
    const CellCommandBody body = read_cell_command(request.body);
    if (body.command == "hold") return http_answer(line->hold());
    if (std::ranges::find(commands, body.command) == commands.end()) {
        return refusal(400, body.command + " is no command of the page");
    }
    if (line->view().kind == CellKind::real && options_.dispatch != DispatchMode::real) {
        return refusal(409, "this server commands simulated cells only, but for Hold", "start it for real cells");
    }
    return http_answer(line->command(body.command, body.job.value_or("")));
}

HttpAnswer Console::change_simulator(const HttpRequest& request) {
    const SimulatorBody body = read_simulator(request.body);
    if (!options_.tell_simulator) return refusal(404, "this server has no simulated cell");
    if (body.line.find_first_of("\r\n") != std::string::npos) return refusal(400, "this is more than one line");
    options_.tell_simulator(body.line);
    return json_answer(202, "{}");
}

HttpAnswer Console::journal() {
    std::vector<JournalReport> reports;
    for (const fs::path& folder : journal_folders({}))
        reports.push_back({folder.string(), read_journal(folder), false});
    return json_answer(200, text_of(document(reports)));
}

}  // namespace qchopper
