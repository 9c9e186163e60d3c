// What the page shows beside the documents of the command line, as values and as JSON.
//
// docs/developer/console.md is the grammar; keys stand in console_state.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/console/cells/dispatch_queue.h"
#include "app/console/worker/console_requests.h"
#include "app/console/worker/json_text.h"
#include "app/console/worker/project_answer.h"

namespace qchopper {

// Stop asks nothing and keeps what is saved. lost: the process ended without an answer.
enum class WorkState { queued, running, stopping, stopped, done, failed, lost };
bool is_over(WorkState state);

struct Work {
    std::string id;
    WorkKind kind = WorkKind::check;
    std::string of;  // the id of a project or check; empty: none yet
    WorkState state = WorkState::queued;
    std::string what;  // "planes evaluated"
    std::size_t done = 0;
    std::size_t total = 0;  // 0: not known
    double elapsed_s = 0;
    std::optional<double> remaining_s;
    std::vector<std::string> messages;  // the newest ones
    JsonText result;
    JsonText error;
};

struct ProjectSummary {
    std::string id;
    std::string name;
    std::string stage;  // cutting, cut, done
    std::string revision;
    std::string undo;  // "Undo cut 3 on piece C", or empty
    std::string redo;
    std::optional<std::string> writer;  // who writes it now
    bool operator==(const ProjectSummary&) const = default;
};

// A change of a project, and whose it is.
struct ProjectChange {
    ProjectSummary project;
    std::string by;        // "page" or "command line"
    std::string sentence;  // what was decided
};

struct ListedScan {
    std::string id;
    std::string name;
    std::uint64_t bytes = 0;
};

struct ListedProject {
    std::string id;
    std::string name;
    std::string stage;
    std::size_t cuts = 0;
    std::size_t pieces = 0;
    std::string scan;
    std::string problem;  // why it cannot be read; empty: it can
};

struct FolderList {
    std::string folder;
    std::vector<ListedScan> scans;
    std::vector<ListedProject> projects;
    bool is_cut_off = false;  // there are more
};

struct NamedChoice {
    std::string name;
    std::string sentence;
};

struct ConsoleChoices {
    std::vector<std::string> units;
    std::vector<NamedChoice> presets;
    std::vector<NamedChoice> cells;
};

struct ConsoleHello {
    std::string server;
    std::string version;
    std::string page;  // SHA-256 of its script
};

struct ConsoleState {
    std::string event;  // the id of the newest one
    bool is_read_only = false;
    std::string dispatch;  // none, simulated or real
    bool has_simulator = false;
    std::string folder;
    std::vector<ProjectSummary> projects;
    std::vector<Work> work;
    std::vector<CellView> cells;
    std::vector<QueueEntry> queue;
    bool is_paused = false;
};

// The whole of a project, of which the figures are those of the worker.
struct ShownProject {
    ProjectSummary summary;
    std::size_t decisions = 0;         // in force
    std::vector<std::string> history;  // these as sentences, the oldest first
    JsonText segment;                  // null while another program writes the project
};

// Results of work.
struct CheckedScan {
    std::string check;
    JsonText inspect;
    std::string mesh;  // empty: it cannot be drawn
};
struct ShownRepair {
    JsonText repair;
    std::string before;  // meshes
    std::string after;
};
struct MadeProject {
    std::string project;  // its id; empty: none was made
    JsonText segment;
};

struct BegunWork {
    std::string work;
};

struct TicketAddress {
    std::string path;
};

// A plan as a person sees it before deciding.
struct OfferedPlan {
    DispatchPlan plan;
    std::string id;
    CellKind kind = CellKind::unknown;
    double expires_s = 0;
};

struct ShownQueue {
    std::vector<QueueEntry> queue;
};

// As they are sent; changes and work, which are data of events, as one line.
std::string to_json(const Work& work);
std::string to_json(const ProjectChange& change);
std::string to_json(const FolderList& list);
std::string to_json(const ConsoleChoices& choices);
std::string to_json(const ConsoleHello& hello);
std::string to_json(const ConsoleState& state);

std::string to_json(const ShownProject& project);
std::string to_json(const CheckedScan& checked);
std::string to_json(const ShownRepair& repaired);
std::string to_json(const MadeProject& made);
std::string to_json(const BegunWork& begun);
std::string to_json(const TicketAddress& address);
std::string to_json(const OfferedPlan& plan);
std::string to_json(const ShownQueue& queue);

}  // namespace qchopper
