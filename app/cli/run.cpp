#include "app/cli/run.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string_view>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/parse_arguments.h"
#include "app/report/notices.h"

namespace qchopper {
namespace {

// Ends a sentence that may have its mark already.
std::string sentence(const std::string& text) {
    return text.empty() || std::string_view(".?!").find(text.back()) == std::string_view::npos ? text + "." : text;
}

// What helps where the fault was seen too deep down to know.
const char* general_remedy(InputFault fault) {
    constexpr const char* remedies[] = {
        "see qchopper --help",
        "see what is wrong with it by: qchopper inspect SCAN",
        "check the name and the rights",
        "choose another place",
        "check the disk, then run the command again",
        "wait until it is done, then run the command again",
        "correct that file; docs/cell-file.md explains the keys of a cell"};  // in the order of InputFault
    return remedies[static_cast<std::size_t>(fault)];
}

// One line: what failed and why; what is unchanged; what to do.
int report(Terminal& terminal, const std::string& what, const std::string& to_do, int code) {
    std::string line = "qchopper: " + sentence(what) + " " + terminal.unchanged;
    if (!to_do.empty()) line += " To do: " + sentence(to_do);
    for (char& c : line) {
        if (c == '\n' || c == '\r') c = ' ';  // a name out of a file may hold anything
    }
    terminal.error(line);
    if (terminal.is_json()) {
        terminal.json(error_document(what, terminal.unchanged, to_do, code));
    }
    return code;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
    // Known before the rest is understood, so that an error in the options comes as a document too.
    const bool is_json = std::any_of(argv, argv + argc, [](const char* a) { return std::string_view(a) == "--json"; });
    Terminal terminal(is_json);
    catch_signals();
    try {
        const std::optional<Arguments> arguments = parse_arguments(argc, argv);
        if (!arguments) return exit_done;  // help or version was asked for
        if (arguments->quiet) terminal.be_quiet();
        return std::visit([&](const auto& command) { return run(command, terminal); }, arguments->command);
    } catch (const InputError& e) {
        return report(terminal, e.what(), e.to_do.empty() ? general_remedy(e.fault) : e.to_do, exit_code(e.fault));
    } catch (const DeviceError& e) {
        return report(terminal, e.what(), e.to_do, exit_code(e.fault));
    } catch (const Cancelled&) {
        return report(terminal, "stopped on request", "", Terminal::cancel_code());
    } catch (const std::bad_alloc&) {
        return report(terminal, "out of memory", "use a scan with fewer faces, or a machine with more memory",
                      exit_internal);
    } catch (const std::exception& e) {
        return report(terminal, std::string("internal error: ") + e.what(), "report this with the command and the scan",
                      exit_internal);
    }
}

}  // namespace qchopper
