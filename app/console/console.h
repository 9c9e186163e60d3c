// What the console answers to each request: the server without its sockets.
//
// State is the project folders and what the processes say that hold them (worker_process.h) or work on them (works.h);
// killing the server loses no decision. answer() may be called from any thread (tests/app/console/console_test.cpp).

#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "app/console/admission.h"
#include "app/console/cells/cell_line.h"
#include "app/console/cells/dispatch_queue.h"
#include "app/console/command_words.h"
#include "app/console/console_state.h"
#include "app/console/folder_watch.h"
#include "app/console/http/event_log.h"
#include "app/console/http/http_server.h"
#include "app/console/http/kept_answers.h"
#include "app/console/routes.h"
#include "app/console/worker/dispatch_plan.h"
#include "app/console/worker/worker_process.h"
#include "app/console/works.h"
#include "app/display/display_store.h"

namespace qchopper {

enum class DispatchMode { none, simulated, real };

struct ConsoleOptions {
    std::filesystem::path folder;  // of scans and projects; absolute
    ConsoleRules rules;
    DispatchMode dispatch = DispatchMode::simulated;
    std::string program;  // that runs as worker and for work
    std::string version;
    std::string server;                         // the id of this run
    std::filesystem::path scratch;              // a folder that is removed when the server ends
    std::vector<NamedChoice> presets;           // by name, with what they do
    std::filesystem::path queue;                // the folder of what is handed over, which stays
    std::optional<std::string> to;              // the address of the cell of all projects
    std::optional<std::filesystem::path> drop;  // where it fetches job files; nothing: they go over the link
    // A line of docs/user/cell-sim.md, to the simulated cell of this server; empty: it has none.
    std::function<void(const std::string&)> tell_simulator = {};
    // How often projects are looked at where nothing tells of their changes.
    std::chrono::milliseconds look_interval = std::chrono::seconds(2);
};

class Console {
 public:
    // Throws InputError (busy) where another server hands over jobs of this folder.
    explicit Console(ConsoleOptions options);
    ~Console();  // ends work and workers
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    // The answer of the first refusal, or how long the body may be.
    std::variant<HttpAnswer, HttpAdmission> admit(const HttpRequest& head);
    // Precondition: it was admitted.
    HttpAnswer answer(const HttpRequest& request);
    // Of a request that cannot be read.
    static HttpAnswer fault(unsigned status);

    // From now on event streams end.
    void end();

 private:
    using Ids = std::vector<std::string>;

    struct Handler;
    static const std::span<const Handler> handlers;

    HttpAnswer route(const RouteRow& row, const Ids& ids, const HttpRequest& request);
    static HttpAnswer show_page_file(const std::string& name);
    HttpAnswer hello() const;
    HttpAnswer show_check(const std::string& id) const;
    HttpAnswer stop_work(const std::string& id);
    HttpAnswer state() const;
    HttpAnswer choices() const;
    HttpAnswer begin_check(const HttpRequest& request);
    HttpAnswer begin_repair(const std::string& check, const HttpRequest& request);
    // The id of the display mesh of a file, which is made by a process of its own; empty if it cannot be.
    std::string mesh_of(const std::filesystem::path& scan) const;
    HttpAnswer make_project(const HttpRequest& request);
    // The refusal, where the cuts of a project cannot be written into the file.
    std::optional<HttpAnswer> write_plan(const std::string& project, const std::filesystem::path& file) const;
    HttpAnswer show_project(const std::string& id);
    HttpAnswer decide(const std::string& id, const HttpRequest& request);
    HttpAnswer ask(const std::string& id, const HttpRequest& request);
    HttpAnswer begin_work(const std::string& id, const HttpRequest& request);
    HttpAnswer begin(WorkOrder order);
    HttpAnswer job_file(const std::string& project, const std::string& job, const std::string& name) const;
    HttpAnswer output(const std::string& project, const std::string& name) const;
    // A display mesh, states of its faces or the way of a tool, from the caches of projects and checks.
    HttpAnswer display(const std::string& id, DisplayKind kind) const;
    HttpAnswer make_ticket(const HttpRequest& request);
    HttpAnswer use_ticket(const std::string& ticket);
    HttpAnswer events(const HttpRequest& request);
    HttpAnswer plan(const std::string& id, const HttpRequest& request);
    HttpAnswer hand_over(const HttpRequest& request);
    HttpAnswer change_queue(const HttpRequest& request);
    HttpAnswer command_cell(const std::string& id, const HttpRequest& request);
    HttpAnswer change_simulator(const HttpRequest& request);
    // Of all cells that this user has handed jobs to.
    static HttpAnswer journal();

    std::shared_ptr<CellLine> cell(const std::string& id) const;
    // The cell to which jobs of a project go: the simulated one of this server, or that of its cell file; nothing
    // without one.
    std::shared_ptr<CellLine> cell_of_project(const std::filesystem::path& project);
    std::shared_ptr<CellLine> cell_at(const std::string& address, const std::string& name,
                                      const std::optional<std::filesystem::path>& cell_file);

    std::filesystem::path project_folder(const std::string& id) const;  // throws InputError (missing)
    std::vector<std::string> words(CommandWords command) const;
    bool awaits_turn_of_wrong_key();
    void watch(const std::stop_token& stop);
    void look_at_projects();
    WorkerAnswer ask_worker(const std::filesystem::path& folder, const WorkerRequest& request,
                            const std::string& lane = {});
    void set_known(const ProjectSummary& summary, const std::string& by, const std::string& sentence);

    struct Check {
        std::filesystem::path scan;
        std::optional<std::string> units;
        std::string document;  // of GET /api/checks/C
    };
    struct Ticket {
        std::string path;
        std::chrono::steady_clock::time_point until;
    };
    struct Plan {
        std::filesystem::path project;
        std::string revision;
        std::string cell;  // its id
        PlanOrder order;
        DispatchPlan jobs;
        std::chrono::steady_clock::time_point until;
    };
    // Of one project, to the process that holds it.
    struct PageRequests {
        int open = 0;
        int deciding = 0;
        std::size_t decided = 0;
    };
    struct Known {
        ProjectSummary summary;
        std::uint64_t stamp = 0;
    };

    ConsoleOptions options_;
    EventLog events_;
    KeptAnswers kept_;
    std::atomic<int> streams_ = 0;

    mutable std::mutex changing_;
    std::map<std::string, Check> checks_;
    std::size_t checks_made_ = 0;
    std::map<std::string, Ticket> tickets_;
    std::map<std::string, Known> known_;            // projects by their ids
    std::map<std::string, PageRequests> requests_;  // by the ids of projects
    int wrong_keys_ = 0;
    std::chrono::steady_clock::time_point last_wrong_key_ = {};
    bool has_ended_ = false;
    std::condition_variable ended_;

    std::map<std::string, Plan> plans_;
    std::map<std::string, std::shared_ptr<CellLine>> cells_;  // by their ids
    // Name and id of the cell at an address, by the first cell file that has named it.
    std::map<std::string, std::pair<std::string, std::uint16_t>> described_cells_;
    std::size_t handed_over_ = 0;

    WorkerProcesses workers_;
    Works works_;
    DispatchQueue queue_;
    FolderWatch changes_;
    std::jthread watcher_;  // the last member: it ends before the others
};

}  // namespace qchopper
