// Scans: looked at, repaired, and made projects, each by a command in a process of its own. A request costs
// O(entries of the folder), and painting O(faces).

#include <algorithm>

#include "app/console/command_words.h"
#include "app/console/console.h"
#include "app/console/console_answers.h"
#include "app/console/console_folder.h"
#include "app/console/random_digits.h"
#include "app/console/worker/console_requests.h"
#include "app/report/notices.h"
#include "app/store/ready_cells.h"
#include "base/child_process.h"
#include "base/files/file.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto mesh_limit = 120s;  // reading ten million faces takes a tenth of it
constexpr int busy_code = 75;      // of a command: another program holds the project

}  // namespace

HttpAnswer Console::show_check(const std::string& id) const {
    const std::lock_guard lock(changing_);
    const auto found = checks_.find(id);
    if (found == checks_.end()) return refusal(404, "there is no check " + id, "check the scan again");
    return json_answer(200, found->second.document);
}

HttpAnswer Console::begin_check(const HttpRequest& request) {
    const CheckBody body = read_check(request.body);
    const std::optional<fs::path> scan = scan_of_id(options_.folder, body.scan);
    if (!scan) return refusal(404, "the folder has no such scan any more", "look at the list again");
    WorkOrder order{WorkKind::check, {}, words(check_words(*scan, body))};
    {
        const std::lock_guard lock(changing_);
        order.of = "C" + std::to_string(++checks_made_);
    }
    order.result = [this, id = order.of, scan = *scan, units = body.units](const JsonText& inspected) {
        std::string text = to_json(CheckedScan{id, inspected, mesh_of(scan)});
        const std::lock_guard lock(changing_);
        checks_[id] = {scan, units, text};
        return JsonText{std::move(text)};
    };
    return begin(std::move(order));
}

HttpAnswer Console::begin_repair(const std::string& check, const HttpRequest& request) {
    const RepairBody body = read_repair(request.body);
    fs::path scan;
    std::optional<std::string> units;
    {
        const std::lock_guard lock(changing_);
        const auto found = checks_.find(check);
        if (found == checks_.end()) return refusal(404, "there is no check " + check, "check the scan again");
        scan = found->second.scan;
        units = found->second.units;
    }
    const fs::path out = options_.scratch / (random_digits() + ".ply");
    WorkOrder order{WorkKind::repair, check, words(repair_words(scan, out, body, units))};
    order.result = [this, scan, out](const JsonText& repaired) {
        return JsonText{to_json(ShownRepair{repaired, mesh_of(scan), mesh_of(out)})};
    };
    return begin(std::move(order));
}

std::string Console::mesh_of(const fs::path& scan) const {
    const ChildOutput made = run_child(words(mesh_words(scan, options_.scratch)), mesh_limit);
    return read_mesh_id(made.out);
}

HttpAnswer Console::make_project(const HttpRequest& request) {
    const NewProjectBody body = read_new_project(request.body);
    if (!is_project_name(body.name)) {
        return refusal(400, "a project cannot have this name", "take letters, digits, spaces, '.', '_' and '-'");
    }
    fs::path scan;
    {
        const std::lock_guard lock(changing_);
        const auto found = checks_.find(body.check);
        if (found == checks_.end()) return refusal(404, "there is no check " + body.check, "check the scan again");
        scan = found->second.scan;
    }
    const fs::path folder = options_.folder / (body.name + ".qch");
    ProjectFiles files;
    if (body.cell) {
        const std::vector<ReadyCell> cells = ready_cell_files(options_.folder);
        const auto cell = std::ranges::find(cells, *body.cell, &ReadyCell::name);
        if (cell == cells.end()) return refusal(404, "there is no cell file " + *body.cell, "choose one of the list");
        files.cell = cell->path;
    }
    if (body.cuts_of) {
        files.plan = options_.scratch / (random_digits() + ".plan.toml");
        if (std::optional<HttpAnswer> refused = write_plan(*body.cuts_of, *files.plan)) return *refused;
    }
    if (!body.strokes.empty()) {
        files.painted = options_.scratch / random_digits();
        fs::create_directory(*files.painted);
        const fs::path strokes = *files.painted / "strokes.json";
        write_file(strokes, to_json(body.strokes));
        const ChildOutput made = run_child(words(paint_words(scan, strokes, *files.painted, body.units)), mesh_limit);
        if (made.code != 0) return refusal(422, "the scan cannot be painted", "check the scan again");
    }
    WorkOrder order{WorkKind::project, body.check, words(project_words(scan, folder, body, files))};
    order.result = [this, folder](const JsonText& made) {
        look_at_projects();
        std::error_code error;  // without a folder the cuts do not fit the scan, as the document says
        const bool is_there = fs::exists(folder / "project.json", error);
        return JsonText{to_json(MadeProject{is_there ? id_of_name(folder.filename()) : std::string(), made})};
    };
    return begin(std::move(order));
}

std::optional<HttpAnswer> Console::write_plan(const std::string& project, const fs::path& file) const {
    const fs::path folder = project_folder(project);
    const ChildOutput made = run_child(words(plan_words(folder, file)), mesh_limit);
    if (made.code == 0) return {};
    if (made.out.empty()) return refusal(422, "the cuts of that project could not be read", "try again");
    return json_answer(made.code == busy_code ? 423 : 422, made.out);  // the error document of the command
}

}  // namespace qchopper
