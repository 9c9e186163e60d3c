#include "app/cli/hand_over.h"

#include "app/cli/exit_code.h"
#include "app/report/hand_over_report.h"

namespace qchopper {

int hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
              const std::string& schema, Terminal& terminal) {
    const auto on_complete = [&](std::size_t count) {  // what an error in the next job has to say of those before it
        terminal.unchanged = "The " + std::to_string(count) + " jobs before it ended complete; it was not started.";
    };
    const HandOverReport report{hand_over(jobs, bus, options, on_complete, terminal.context()), jobs.size(),
                                options.want_simulated};
    terminal.show(lines(report));
    terminal.json(document(report, schema));
    if (report.is_cancelled()) return Terminal::cancel_code();
    return report.is_complete() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper
