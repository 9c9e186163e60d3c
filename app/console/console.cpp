// A table of handlers. Answers to what changes something are kept by the ids of the requests. What a request costs
// beside its work: O(entries of the folder), and a SHA-256 of project.json.

#include "app/console/console.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "app/console/console_answers.h"
#include "app/console/console_folder.h"
#include "app/console/page_files.h"
#include "app/console/random_digits.h"
#include "app/console/worker/console_requests.h"
#include "app/console/worker/resident_project.h"
#include "app/store/project_folder.h"
#include "app/store/ready_cells.h"
#include "base/error.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int most_streams = 8;
constexpr int free_wrong_keys = 10;
constexpr int most_wrong_keys_waiting = 8;
constexpr Clock::duration ticket_life = 30s;
constexpr Clock::duration idle_worker = 15min;
constexpr auto look_pause = 100ms;  // at least, between two looks at all projects

}  // namespace

Console::Console(ConsoleOptions options)
    : options_(std::move(options)),
      events_(options_.server),
      workers_([this](const fs::path& folder) { return words(worker_words(folder)); }),
      works_([this](const Work& work) { events_.publish("work", to_json(work), work.id); }),
      queue_(
          options_.queue,
          // Also the cell of a job that an earlier server has handed over.
          [this](const QueueEntry& entry) { return cell_at(entry.address, entry.address, {})->view(); },
          [this] { events_.publish("queue", to_json(ShownQueue{queue_.all()}), "queue"); }),
      changes_(options_.folder),
      watcher_([this](const std::stop_token& stop) { watch(stop); }) {}

Console::~Console() {
    end();
    watcher_.request_stop();
    watcher_.join();
    workers_.end();
}

void Console::end() {
    {
        const std::lock_guard lock(changing_);
        has_ended_ = true;
    }
    ended_.notify_all();
    events_.end();
    workers_.end();
}

std::vector<std::string> Console::words(CommandWords command) const {
    command.insert(command.begin(), options_.program);
    return command;
}

HttpAnswer Console::fault(unsigned status) {
    struct Row {
        unsigned status;
        const char* why;
    };
    constexpr Row rows[] = {{400, "this is no request of HTTP/1.1"},
                            {413, "the body is too long"},
                            {431, "the head of the request is too long"},
                            {503, "too many connections are open"}};
    const auto* const row = std::ranges::find(rows, status, &Row::status);
    HttpAnswer answer = refusal(status, row == std::end(rows) ? "the request cannot be answered" : row->why);
    add_guards(answer);
    return answer;
}

std::variant<HttpAnswer, HttpAdmission> Console::admit(const HttpRequest& head) {
    const RouteMatch match = match_route(head.method, head.path());
    const std::optional<RequestRefusal> refused = refusal_of(head, match, options_.rules);
    if (!refused) return HttpAdmission{match.row->body_bytes, match.row->access != RouteAccess::open};
    const bool is_answered = !refused->is_of_key || awaits_turn_of_wrong_key();
    HttpAnswer answer = is_answered ? refusal(refused->status, refused->why) : refusal(503, "too many keys are tried");
    add_guards(answer);
    return answer;
}

// From the eleventh wrong key on one is answered a second, so that none is found by trying. False: too many wait for
// that, each with a thread.
bool Console::awaits_turn_of_wrong_key() {
    std::unique_lock lock(changing_);
    if (++wrong_keys_ <= free_wrong_keys) return true;
    const Clock::time_point turn = std::max(Clock::now(), last_wrong_key_ + 1s);
    if (turn > Clock::now() + most_wrong_keys_waiting * 1s) return false;
    last_wrong_key_ = turn;
    ended_.wait_until(lock, turn, [&] { return has_ended_; });
    return true;
}

HttpAnswer Console::answer(const HttpRequest& request) {
    const RouteMatch match = match_route(request.method, request.path());
    if (match.row == nullptr) return fault(404);
    const auto make = [&] {
        try {
            return route(*match.row, match.ids, request);
        } catch (const InputError& e) {
            return http_answer(answer_to(e));
        } catch (const std::exception& e) {
            return refusal(500, std::string("internal error: ") + e.what());
        }
    };
    HttpAnswer answer;
    if (request.method == "GET" || match.row->route == Route::ask) {
        answer = make();
    } else {
        const std::string bytes = request.method + request.target + "\n" + revision_of(request) + "\n" + request.body;
        const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
        answer = kept_.answer(std::string(request.value("X-Request-Id").value_or("")), sha256({data, bytes.size()}),
                              make, refusal(409, "this X-Request-Id was given to another request"));
    }
    add_guards(answer);
    return answer;
}

// What answers each route; `ids` are those of its path.
struct Console::Handler {
    Route route;
    HttpAnswer (*answer)(Console& console, const Ids& ids, const HttpRequest& request);
};

const std::span<const Console::Handler> Console::handlers = [] {
    using C = Console&;
    using I = const Ids&;
    using R = const HttpRequest&;
    static constexpr Handler rows[] = {
        {Route::hello, [](C c, I, R) { return c.hello(); }},
        {Route::state, [](C c, I, R) { return c.state(); }},
        {Route::files, [](C c, I, R) { return json_answer(200, to_json(list_folder(c.options_.folder))); }},
        {Route::choices, [](C c, I, R) { return c.choices(); }},
        {Route::begin_check, [](C c, I, R r) { return c.begin_check(r); }},
        {Route::check, [](C c, I i, R) { return c.show_check(i[0]); }},
        {Route::begin_repair, [](C c, I i, R r) { return c.begin_repair(i[0], r); }},
        {Route::make_project, [](C c, I, R r) { return c.make_project(r); }},
        {Route::project, [](C c, I i, R) { return c.show_project(i[0]); }},
        {Route::decide, [](C c, I i, R r) { return c.decide(i[0], r); }},
        {Route::ask, [](C c, I i, R r) { return c.ask(i[0], r); }},
        {Route::begin_work, [](C c, I i, R r) { return c.begin_work(i[0], r); }},
        {Route::stop_work, [](C c, I i, R) { return c.stop_work(i[0]); }},
        {Route::job_file, [](C c, I i, R) { return c.job_file(i[0], i[1], i[2]); }},
        {Route::output, [](C c, I i, R) { return c.output(i[0], i[1]); }},
        {Route::mesh, [](C c, I i, R) { return c.display(i[0], DisplayKind::mesh); }},
        {Route::surface_states, [](C c, I i, R) { return c.display(i[1], DisplayKind::states); }},
        {Route::tool_way, [](C c, I i, R) { return c.display(i[0], DisplayKind::path); }},
        {Route::make_ticket, [](C c, I, R r) { return c.make_ticket(r); }},
        {Route::use_ticket, [](C c, I i, R) { return c.use_ticket(i[0]); }},
        {Route::events, [](C c, I, R r) { return c.events(r); }},
        {Route::plan, [](C c, I i, R r) { return c.plan(i[0], r); }},
        {Route::hand_over, [](C c, I, R r) { return c.hand_over(r); }},
        {Route::change_queue, [](C c, I, R r) { return c.change_queue(r); }},
        {Route::command_cell, [](C c, I i, R r) { return c.command_cell(i[0], r); }},
        {Route::change_simulator, [](C c, I, R r) { return c.change_simulator(r); }},
        {Route::journal, [](C, I, R) { return journal(); }},
        {Route::page, [](C, I i, R) { return show_page_file(i.empty() ? "" : i[0]); }}};
    return std::span(rows);
}();

HttpAnswer Console::route(const RouteRow& row, const Ids& ids, const HttpRequest& request) {
    const auto handler = std::ranges::find(handlers, row.route, &Handler::route);
    assert(handler != handlers.end());
    return handler->answer(*this, ids, request);
}

HttpAnswer Console::show_page_file(const std::string& name) {
    const std::optional<PageFile> file = page_file(name);
    if (!file) return refusal(404, "the page has no file " + name);
    return {200,
            {{"Content-Type", std::string(file->type)}, {"Content-Encoding", "gzip"}, {"Cache-Control", "no-cache"}},
            std::string(file->gzip.begin(), file->gzip.end())};
}

HttpAnswer Console::hello() const {
    return json_answer(200, to_json(ConsoleHello{options_.server, options_.version, std::string(page_hash())}));
}

HttpAnswer Console::stop_work(const std::string& id) {
    return works_.stop(id) ? json_answer(202, "{}") : refusal(404, "there is no work " + id);
}

HttpAnswer Console::state() const {
    constexpr std::array modes{"none", "simulated", "real"};  // in the order of DispatchMode
    ConsoleState state;
    state.event = events_.newest();
    state.is_read_only = options_.rules.is_read_only;
    state.dispatch = modes[static_cast<std::size_t>(options_.dispatch)];
    state.folder = options_.folder.filename().string();
    state.work = works_.all();
    state.queue = queue_.all();
    state.is_paused = queue_.is_paused();
    state.has_simulator = options_.tell_simulator != nullptr;
    const std::lock_guard lock(changing_);
    for (const auto& [id, known] : known_) state.projects.push_back(known.summary);
    for (const auto& [id, line] : cells_) state.cells.push_back(line->view());
    return json_answer(200, to_json(state));
}

HttpAnswer Console::choices() const {
    ConsoleChoices choices{{"mm", "cm", "m", "in", "ft", "um"}, options_.presets, {}};
    for (const ReadyCell& cell : ready_cell_files(options_.folder)) choices.cells.push_back({cell.name, cell.sentence});
    return json_answer(200, to_json(choices));
}

HttpAnswer Console::begin(WorkOrder order) {
    const std::optional<std::string> id = works_.begin(std::move(order));
    if (!id) return refusal(503, "too much work waits", "wait until some of it is done, or stop it");
    return json_answer(202, to_json(BegunWork{*id}));
}

HttpAnswer Console::make_ticket(const HttpRequest& request) {
    const TicketBody body = read_ticket(request.body);
    const RouteMatch match = match_route("GET", body.path);
    if (match.row == nullptr || (match.row->route != Route::output && match.row->route != Route::job_file)) {
        return refusal(400, "no ticket is made for this address");
    }
    const std::string ticket = random_digits();
    const std::lock_guard lock(changing_);
    std::erase_if(tickets_, [](const auto& entry) { return entry.second.until < Clock::now(); });
    tickets_[ticket] = {body.path, Clock::now() + ticket_life};
    return json_answer(201, to_json(TicketAddress{"/api/t/" + ticket}));
}

HttpAnswer Console::use_ticket(const std::string& ticket) {
    std::string path;
    {
        const std::lock_guard lock(changing_);
        const auto found = tickets_.find(ticket);
        if (found == tickets_.end() || found->second.until < Clock::now()) {
            return refusal(404, "this address was used already, or is too old", "open it again from the page");
        }
        path = found->second.path;
        tickets_.erase(found);
    }
    const RouteMatch match = match_route("GET", path);
    return route(*match.row, match.ids, {});
}

HttpAnswer Console::events(const HttpRequest& request) {
    if (streams_.fetch_add(1) >= most_streams) {
        --streams_;
        return refusal(503, "too many pages are open", "close some of them");
    }
    const std::shared_ptr<std::atomic<int>> counted(&streams_, [](std::atomic<int>* streams) { --*streams; });
    constexpr std::string_view key = "after=";
    const std::string_view query = request.query();
    const std::string after = query.starts_with(key) ? std::string(query.substr(key.size())) : std::string();
    const std::shared_ptr<EventLog::Reader> reader = events_.reader(after);
    HttpAnswer answer{200, {{"Content-Type", "text/event-stream"}}, {}};
    answer.next_part = [reader, counted](std::chrono::milliseconds limit) { return reader->next(limit); };
    return answer;
}

void Console::set_known(const ProjectSummary& summary, const std::string& by, const std::string& sentence) {
    {
        const std::lock_guard lock(changing_);
        Known& known = known_[summary.id];
        if (known.summary == summary) return;
        known.summary = summary;
    }
    events_.publish("project", to_json(ProjectChange{summary, by, sentence}));
}

// Projects that other programs have changed, made or removed.
void Console::look_at_projects() {
    std::map<std::string, Known> before;
    std::map<std::string, PageRequests> requests;
    {
        const std::lock_guard lock(changing_);
        before = known_;
        requests = requests_;
    }
    std::set<std::string> there;
    const std::vector<fs::path> folders = projects_in(options_.folder);
    changes_.add(folders);
    for (const fs::path& folder : folders) {
        const std::string id = id_of_name(folder.filename());
        there.insert(id);
        const std::uint64_t stamp = stamp_of(folder);
        const auto found = before.find(id);
        const bool is_same = found != before.end() && found->second.stamp == stamp;
        if (is_same && (requests[id].open > 0 || found->second.summary.writer == writer_of(folder))) continue;
        try {
            const ProjectSummary summary = summary_of(folder);
            {
                const std::lock_guard lock(changing_);
                const PageRequests& now = requests_[id];
                if (now.deciding > 0 || now.decided != requests[id].decided) continue;
            }
            const bool is_changed = found == before.end() || found->second.summary.revision != summary.revision;
            set_known(summary, "command line", is_changed ? summary.undo : "");
        } catch (const std::exception&) {
            continue;  // the list of files says why
        }
        try {
            cell_of_project(folder);
        } catch (const InputError&) {
            continue;  // its cell file is wrong: who wants to hand jobs over is told
        }
        const std::lock_guard lock(changing_);
        known_[id].stamp = stamp;
    }
    const std::lock_guard lock(changing_);
    std::erase_if(known_, [&](const auto& known) { return !there.contains(known.first); });
}

void Console::watch(const std::stop_token& stop) {
    const std::stop_callback end(stop, [this] { changes_.stop(); });
    while (!stop.stop_requested()) {
        look_at_projects();
        workers_.end_idle(idle_worker);
        if (changes_.wait(options_.look_interval)) std::this_thread::sleep_for(look_pause);
    }
}

}  // namespace qchopper
