// Entry point: from the command line to the exit code (exit_code.h).
//
// Parses the command line, runs the command, and turns every exception into one line
// (docs/user/troubleshooting.md, tests/app/cli/bad_input_test.cpp).

#include <algorithm>
#include <array>
#include <iterator>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include "app/cli/arguments/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/command_line_text.h"
#include "app/report/notices.h"
#include "base/parallel.h"
#include "base/process.h"
#include "devices/wire/device_error.h"

namespace qchopper {
namespace {

// The text with a full stop, unless it ends in a mark.
std::string sentence(const std::string& text) {
    return text.empty() || std::string_view(".?!").find(text.back()) == std::string_view::npos ? text + "." : text;
}

struct FaultRow {
    ExitCode code;
    const char* remedy;  // of an error that carries none of its own
};
constexpr FaultRow fault_rows[] = {
    // in the order of InputFault
    {exit_use, "see qchopper --help"},
    {exit_mesh, "see what is wrong with it by: qchopper inspect SCAN"},
    {exit_missing, "check the name and the rights"},
    {exit_create, "choose another place"},
    {exit_io, "check the disk, then run the command again"},
    {exit_busy, "wait until it is done, then run the command again"},
    {exit_config, "correct that file; docs/user/cell-file.md explains the keys of a cell"}};
static_assert(static_cast<std::size_t>(InputFault::config) + 1 == std::size(fault_rows));
constexpr ExitCode device_codes[] = {exit_unreachable, exit_protocol, exit_busy, exit_demand_broken};  // of DeviceFault
static_assert(static_cast<std::size_t>(DeviceFault::refused) + 1 == std::size(device_codes));

// One line: what failed and why; what is unchanged; what to do.
int report(Terminal& terminal, const std::string& what, const Sentence& to_do, int code) {
    terminal.begin_end();
    std::string line = "qchopper: " + sentence(what) + " " + terminal.unchanged();
    if (!to_do.empty()) line += " To do: " + sentence(command_line_text(to_do));
    for (char& c : line) {
        if (c == '\n' || c == '\r') c = ' ';  // names from files may contain line breaks
    }
    terminal.error(line);
    terminal.json(error_document(what, terminal.unchanged(), to_do, code));
    return code;
}

int report_stop(Terminal& terminal) {
    return report(terminal, "stopped on request", "", Terminal::cancel_code());
}

// Whether a command may be ended in the middle of its work: all but those that lead a cell or other processes, are a
// cell, or ask for a passphrase.
bool may_end_anywhere(const Arguments& arguments) {
    const auto& command = arguments.command;
    const auto* const submit = std::get_if<SubmitArguments>(&command);
    if (submit != nullptr && submit->engine == "local") return false;
    return !std::holds_alternative<DispatchArguments>(command) && !std::holds_alternative<DryRunArguments>(command) &&
           !std::holds_alternative<CellSimArguments>(command) && !std::holds_alternative<ServeArguments>(command) &&
           !std::holds_alternative<CellControlArguments>(command) &&
           !std::holds_alternative<CellCheckArguments>(command) &&
           !std::holds_alternative<KeysArguments>(command);  // a terminal without echo is to be restored
}

// Throws nothing.
int run_program(int argc, const char* const* argv) {
    // Found before the options are parsed, so that an error in them is reported as a document too.
    const std::vector<std::string_view> words(argv, argv + argc);
    constexpr std::array progress_json{std::string_view("--progress"), std::string_view("json")};
    const bool is_json = std::ranges::find(words, "--json") != words.end();
    catch_signals();
    Terminal terminal(is_json);
    const auto pair = std::search(words.begin(), words.end(), progress_json.begin(), progress_json.end());
    if (pair != words.end() || std::ranges::find(words, "--progress=json") != words.end()) terminal.set_progress_json();
    try {
        const std::optional<Arguments> arguments = parse_arguments(argc, argv);
        if (!arguments) return exit_done;  // help or version was asked for
        if (arguments->quiet) terminal.set_quiet();
        if (arguments->timings) terminal.set_timings();
        std::optional<ThreadLimit> limit;
        if (arguments->threads) limit.emplace(*arguments->threads);
        if (may_end_anywhere(*arguments)) terminal.end_when_stopped([&] { report_stop(terminal); });
        const int code = std::visit([&](const auto& command) { return run(command, terminal); }, arguments->command);
        if (!Terminal::is_output_lost()) return code;
        return report(terminal, "standard output cannot be written",
                      "free space on the disk, or write it to another place", exit_io);
    } catch (const InputError& e) {
        const FaultRow& row = fault_rows[static_cast<std::size_t>(e.fault)];
        return report(terminal, e.what(), e.to_do.empty() ? Sentence(row.remedy) : e.to_do, row.code);
    } catch (const DeviceError& e) {
        return report(terminal, e.what(), e.to_do, device_codes[static_cast<std::size_t>(e.fault)]);
    } catch (const Cancelled&) {
        return report_stop(terminal);
    } catch (const std::bad_alloc&) {
        return report(terminal, "out of memory", "use a scan with fewer faces, or a machine with more memory",
                      exit_internal);
    } catch (const std::exception& e) {
        return report(terminal, std::string("internal error: ") + e.what(), "report this with the command and the scan",
                      exit_internal);
    }
}

}  // namespace
}  // namespace qchopper

int main(int argc, char** argv) {
    // Pictures, maps and pieces are large blocks of short life: a third of the time of a small scan's `prepare` was the
    // system's.
    qchopper::keep_freed_memory();
    return qchopper::run_program(argc, argv);
}
