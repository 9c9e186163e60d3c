#include "cli/run.h"

#include <iostream>
#include <new>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_code.h"

namespace qchopper {
namespace {

// One line: what failed and why; what is unchanged; what to do.
int report(Terminal& terminal, const std::string& what, const std::string& to_do, int code) {
    std::string line = "qchopper: " + what + ". " + terminal.unchanged;
    if (!to_do.empty()) line += " To do: " + to_do + ".";
    std::cerr << line << std::endl;
    if (terminal.is_json()) {
        const nlohmann::ordered_json document{{"schema", "qchopper-error-1"},
                                              {"error", what},
                                              {"unchanged", terminal.unchanged},
                                              {"to_do", to_do},
                                              {"exit_code", code}};
        terminal.json(document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
    return code;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
    const std::variant<Arguments, int> parsed = parse_arguments(argc, argv);
    if (std::holds_alternative<int>(parsed)) return std::get<int>(parsed);
    const auto& arguments = std::get<Arguments>(parsed);
    Terminal terminal(arguments.json, arguments.quiet);
    catch_signals();
    try {
        return std::visit([&](const auto& command) { return run(command, terminal); }, arguments.command);
    } catch (const InputError& e) {
        return report(terminal, e.what(), e.to_do, exit_code(e.fault));
    } catch (const DeviceError& e) {
        return report(terminal, e.what(), e.to_do, exit_code(e.fault));
    } catch (const Cancelled&) {
        return report(terminal, "stopped on request", "", Terminal::cancel_code());
    } catch (const std::bad_alloc&) {
        return report(terminal, "out of memory", "use a scan with fewer faces, or a machine with more memory",
                      exit_ours);
    } catch (const std::exception& e) {
        return report(terminal, std::string("our fault: ") + e.what(), "report this with the command and the scan",
                      exit_ours);
    }
}

}  // namespace qchopper
