// Projects: shown, decided, asked, and the files that are made of them. A request costs what its worker takes, and a
// SHA-256 of project.json.

#include <algorithm>
#include <array>

#include "app/console/command_words.h"
#include "app/console/console.h"
#include "app/console/console_answers.h"
#include "app/console/console_folder.h"
#include "app/console/http/content_type.h"
#include "app/console/worker/console_requests.h"
#include "app/console/worker/resident_project.h"
#include "app/console/worker/shown_pieces.h"
#include "app/console/worker/shown_replay.h"
#include "app/display/display_store.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/files/zip.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Of sheets and guides, which hold their styles and pictures: they run no script and ask for nothing.
constexpr const char* sheet_policy =
    "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:";

// Files of a project that a page may ask for by name.
constexpr std::array outputs{"guide.html", "guide.pdf", "guide.glb"};

// A file that was made of a scan, with the policy of sheets.
HttpAnswer file_answer(const std::string& name, const Bytes& bytes) {
    return {200,
            {{"Content-Type", std::string(content_type(name))}, {"Content-Security-Policy", sheet_policy}},
            std::string(bytes.begin(), bytes.end())};
}

}  // namespace

fs::path Console::project_folder(const std::string& id) const {
    if (std::optional<fs::path> folder = project_of_id(options_.folder, id)) return std::move(*folder);
    throw InputError(InputFault::missing, "there is no project " + id + " any more", "look at the list again");
}

HttpAnswer Console::show_project(const std::string& id) {
    const fs::path folder = project_folder(id);
    ShownProject shown;
    shown.summary = summary_of(folder);
    if (!works_.is_busy(id)) {
        const WorkerAnswer answer = ask_worker(folder, {WorkerTask::show, {}, {}});
        if (answer.status == 200) {
            // All of one moment: a decision may have been taken since the summary.
            ProjectAnswer project = read_project_answer(answer.document);
            shown.summary.revision = project.revision;
            shown.summary.stage = project.stage;
            shown.summary.undo = project.undo.value_or("");
            shown.summary.redo = project.redo.value_or("");
            shown.decisions = project.decisions;
            shown.history = std::move(project.history);
            shown.segment = std::move(project.document);
        } else if (answer.status != 423) {
            return http_answer(answer);
        }
    }
    HttpAnswer answer = json_answer(200, to_json(shown));
    answer.fields.emplace_back("ETag", "\"" + shown.summary.revision + "\"");
    return answer;
}

HttpAnswer Console::decide(const std::string& id, const HttpRequest& request) {
    const fs::path folder = project_folder(id);
    if (works_.is_busy(id))
        return refusal(423, "work on this project is under way", "wait until it is done, or stop it");
    return http_answer(ask_worker(folder, {WorkerTask::decide, revision_of(request), request.body}));
}

// What the page decides is told here as the page's, and not by look_at_projects() as that of another program.
WorkerAnswer Console::ask_worker(const fs::path& folder, const WorkerRequest& request, const std::string& lane) {
    const int decides = request.task == WorkerTask::decide ? 1 : 0;
    const auto count = [&](int change) {
        const std::lock_guard lock(changing_);
        PageRequests& requests = requests_[id_of_name(folder.filename())];
        requests.open += change;
        requests.deciding += change * decides;
        requests.decided += static_cast<std::size_t>(decides);
    };
    count(1);
    WorkerAnswer answer = workers_.ask(folder, request, lane);
    try {
        if (decides != 0 && answer.status == 200) {
            set_known(summary_of(folder), "page", read_project_answer(answer.document).done.value_or(""));
        }
    } catch (const std::exception&) {  // it is decided all the same; the next look tells of it
    }
    count(-1);
    return answer;
}

HttpAnswer Console::ask(const std::string& id, const HttpRequest& request) {
    const fs::path folder = project_folder(id);
    const QuestionBody question = read_question(request.body);
    if (works_.is_busy(id))
        return refusal(423, "work on this project is under way", "wait until it is done, or stop it");
    return http_answer(ask_worker(folder, {WorkerTask::ask, {}, request.body}, question.lane));
}

HttpAnswer Console::begin_work(const std::string& id, const HttpRequest& request) {
    const WorkBody body = read_work(request.body);
    const fs::path folder = project_folder(id);
    const std::optional<CommandWords> command = work_words(folder, body);
    if (!command) return refusal(400, "this work is not one of a project");
    if (revision_of_project(folder) != revision_of(request)) {
        return refusal(412, "the project has changed", "look at it as it is now, then begin again");
    }
    return begin({body.kind, id, words(*command)});
}

HttpAnswer Console::job_file(const std::string& project, const std::string& job, const std::string& name) const {
    const fs::path file = project_folder(project) / "jobs" / (job + ".qjob");
    const std::map<std::string, Bytes> files = unzip(read_file(file, job_limit), file.filename().string());
    const auto found = files.find(name);
    if (found == files.end()) return refusal(404, "the job " + job + " has no file " + name);
    return file_answer(name, found->second);
}

HttpAnswer Console::output(const std::string& project, const std::string& name) const {
    if (std::ranges::find(outputs, name) == outputs.end()) {
        return refusal(404, "a project has no output " + name);
    }
    return file_answer(name, read_file(project_folder(project) / name, scan_limit));
}

HttpAnswer Console::display(const std::string& id, DisplayKind kind) const {
    std::vector<fs::path> folders{options_.scratch};
    for (const fs::path& project : projects_in(options_.folder)) {
        folders.push_back(display_folder(project));
        folders.push_back(replay_folder(project));
    }
    for (const fs::path& folder : folders) {
        const std::optional<Bytes> packed = kept_display(folder, kind, id);
        if (!packed) continue;
        return {200,
                {{"Content-Type", "application/octet-stream"},
                 {"Content-Encoding", "gzip"},
                 {"Cache-Control", "private, max-age=31536000, immutable"}},
                std::string(packed->begin(), packed->end())};
    }
    const char* const what = kind == DisplayKind::path ? "way of a tool" : "mesh";
    return refusal(404, std::string("there is no ") + what + " " + id, "load the project again");
}

}  // namespace qchopper
