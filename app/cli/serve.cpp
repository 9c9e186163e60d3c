// Serves the console until a signal ends the program; and the process that holds a project for it.

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <thread>

#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/console/console.h"
#include "app/console/console_folder.h"
#include "app/console/http/http_server.h"
#include "app/console/random_digits.h"
#include "app/console/worker/shown_replay.h"
#include "app/console/worker/strokes.h"
#include "app/console/worker/worker.h"
#include "app/dispatch/state_folder.h"
#include "app/display/make_display.h"
#include "app/engine/presets.h"
#include "app/report/notices.h"
#include "app/store/project_folder.h"
#include "base/child_process.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "devices/wire/modbus_tcp.h"
#include "segment/import/import_scan.h"
#include "segment/io/read_mesh.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// The key of a file that only its owner may read.
std::string key_of_file(const fs::path& path) {
    constexpr std::size_t digits = 32;
    std::error_code error;
    const fs::perms others = fs::status(path, error).permissions() & (fs::perms::group_all | fs::perms::others_all);
    if (!error && others != fs::perms::none) {
        throw InputError(InputFault::use, path.string() + " can be read by others",
                         "make it yours alone: chmod 600 " + path.string());
    }
    const Bytes bytes = read_file(path, settings_limit);
    std::string key(bytes.begin(), bytes.end());
    while (!key.empty() && (key.back() == '\n' || key.back() == '\r')) key.pop_back();
    const bool is_hex = key.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (key.size() != digits || !is_hex) {
        throw InputError(InputFault::use, path.string() + " holds no key: 32 digits 0 to 9 and a to f",
                         "make one: openssl rand -hex 16");
    }
    return key;
}

// A simulated cell in a process of its own, which ends with this object, and with this process however it ends.
class SimulatedCell {
 public:
    SimulatedCell(const std::string& program, const fs::path& folder)
        : child_({program, "cell-sim", "--listen", "127.0.0.1:0", "--consent", "ask", "--drop", folder.string(),
                  "--json", "--progress", "json"}) {
        std::string document;
        while (!child_.has_ended() && !document.ends_with("}\n")) {
            const auto line = child_.read_line(5s);
            if (line && !line->is_error) document += line->text + "\n";
        }
        address_ = listening_address(document);
        reader_ = std::jthread([this](const std::stop_token& stop) {
            while (!stop.stop_requested() && !child_.has_ended()) child_.read_line(200ms);  // else it would wait for us
        });
    }

    const std::string& address() const { return address_; }
    void tell(const std::string& line) { child_.write_line(line); }

 private:
    TalkingChild child_;
    std::string address_;
    std::jthread reader_;
};

// The address with the usual port where it names none.
std::string with_port(const std::string& address) {
    const bool has_port = address.empty() || (address.find(':') != std::string::npos && !address.ends_with(']'));
    return has_port ? address : address + ":8720";
}

DispatchMode mode_of(const std::string& word) {
    if (word == "none") return DispatchMode::none;
    return word == "real" ? DispatchMode::real : DispatchMode::simulated;
}

std::vector<NamedChoice> preset_choices() {
    std::vector<NamedChoice> choices;
    for (const PresetRow& row : preset_rows()) choices.push_back({row.name, row.sentence});
    return choices;
}

// Of the jobs of this folder alone: another server shows and follows its own. One that only shows has `empty`, so that
// a server that hands over may be started before and after it.
fs::path queue_folder(const fs::path& folder, const fs::path& empty, Terminal& terminal) {
    fs::path own = state_folder() / "console" / id_of_name(folder.string());
    if (empty.empty()) return own;
    if (const std::optional<std::string> other = writer_of(own)) {
        terminal.message("Another server of this folder hands its jobs over, and shows them: " + *other + ".");
    }
    return empty / "queue";
}

}  // namespace

int run(const ServeArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing is served.");
    ConsoleOptions options;
    const fs::path given = fs::absolute(without_slash(arguments.folder)).lexically_normal();
    std::error_code error;
    const bool is_project = fs::is_regular_file(given / "project.json", error);
    options.folder = is_project ? given.parent_path() : given;
    if (!fs::is_directory(options.folder, error)) {
        throw InputError(InputFault::missing, options.folder.string() + " is no folder",
                         "name the folder of the scans and projects");
    }
    options.folder = fs::canonical(options.folder);
    const TcpAddress address = listen_address(with_port(arguments.listen));
    options.rules.key = arguments.key_file ? key_of_file(*arguments.key_file) : random_digits();
    options.rules.is_read_only = arguments.is_read_only;
    options.dispatch = mode_of(arguments.dispatch);
    options.program = fs::read_symlink("/proc/self/exe").string();
    options.version = version();
    options.server = random_digits(4);
    options.presets = preset_choices();
    const TemporaryFolder scratch("qchopper-console-");
    options.scratch = scratch.path();
    options.queue = queue_folder(options.folder, arguments.is_read_only ? scratch.path() : fs::path(), terminal);
    options.to = arguments.to;
    options.drop = arguments.drop;
    std::optional<SimulatedCell> simulator;
    if (arguments.has_simulator) {
        simulator.emplace(options.program, scratch.path());
        options.to = simulator->address();
        options.tell_simulator = [&](const std::string& line) { simulator->tell(line); };
    }

    std::optional<Console> console;  // which the connections of the server ask to their end
    HttpServer server(address.host, address.port);
    const std::string port = std::to_string(server.port());
    const bool is_v6 = address.host.find(':') != std::string::npos;
    std::vector<std::string> names{is_v6 ? "[" + address.host + "]" : address.host, "localhost"};
    names.insert(names.end(), arguments.hosts.begin(), arguments.hosts.end());
    for (const std::string& name : names) options.rules.hosts.emplace_back(name).append(":").append(port);
    if (port == "80") options.rules.hosts.insert(options.rules.hosts.end(), names.begin(), names.end());
    const std::string link = "http://" + options.rules.hosts.front() + "/#key=" + options.rules.key;
    console.emplace(std::move(options));
    server.begin({[&](const HttpRequest& head) { return console->admit(head); },
                  [&](const HttpRequest& request) { return console->answer(request); },
                  [](unsigned status) { return Console::fault(status); }});
    terminal.message("This is no safety device: danger is ended by the red button at the cell. Ctrl-C ends it.");
    terminal.show({link}, listening_document(link));
    if (arguments.opens && run_child({"xdg-open", link}, 10s).code != 0) {
        terminal.warn("no browser could be opened: open the link yourself");
    }
    while (!Terminal::is_cancelled() && !terminal.is_gone()) std::this_thread::sleep_for(50ms);
    console->end();
    return exit_done;
}

int run(const ConsoleWorkerArguments& arguments, Terminal& terminal) {
    // The server and the page are answered first.
    constexpr int niceness = 5;
    static_cast<void>(::setpriority(PRIO_PROCESS, 0, niceness) == 0);
    // Nobody can read what it would say any more: it ends at once, in the middle of what it does, as by a kill.
    const std::jthread watch([](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            pollfd out{STDOUT_FILENO, 0, 0};
            if (::poll(&out, 1, 100) > 0 && (out.revents & (POLLERR | POLLNVAL)) != 0) std::_Exit(exit_done);
        }
    });
    const auto next_line = []() -> std::optional<std::string> {
        std::string line;
        return std::getline(std::cin, line) ? std::optional(std::move(line)) : std::nullopt;
    };
    const auto print = [](const std::string& line) { std::cout << line << std::endl; };
    work_for_console(arguments.project, next_line, print, version(), terminal.context());
    return exit_done;
}

int run(const ConsoleMeshArguments& arguments, Terminal& terminal) {
    const RawMesh scan = read_mesh(arguments.scan, {.weld = true});
    const DisplayFile shown = display_scan(scan.mesh, arguments.folder, terminal.context());
    terminal.json(mesh_document(shown.id, shown.deviation_mm));
    return exit_done;
}

int run(const ConsolePaintArguments& arguments, Terminal& terminal) {
    RawMesh scan = read_mesh(arguments.scan, {.weld = true});
    const double mm = arguments.units ? mm_per(unit_named(*arguments.units)) : scan.mm_per_unit.value_or(1);
    const Bytes json = read_file(arguments.strokes, settings_limit);
    TriangleMesh in_mm = scan.mesh;
    for (Vec3& point : in_mm.points) point = mm * point;
    const std::vector<StrokeSurface> painted = painted_points(in_mm, read_strokes({json.begin(), json.end()}));
    for (const auto& [surface, name] :
         {std::pair{StrokeSurface::ignore, "ignore.ply"}, {StrokeSurface::no_cut, "no_cut.ply"}}) {
        const Bytes file = masked_ply(scan.mesh, painted, surface);
        if (!file.empty()) write_file(arguments.folder / name, file);
    }
    terminal.json(painted_document(painted.size()));
    return exit_done;
}

int run(const ConsoleReplayArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("No job was changed.");
    const ReplayOrder order{without_slash(arguments.project), arguments.piece, arguments.part};
    terminal.json(document(shown_replay(order, terminal.context())));
    return exit_done;
}

}  // namespace qchopper
