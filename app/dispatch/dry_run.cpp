// The cell gives consent at once. The cost is that of dispatch_jobs.h.

#include "app/dispatch/dry_run.h"

#include <mutex>
#include <utility>

#include "app/dispatch/executed_program.h"
#include "app/dispatch/proven_jobs.h"
#include "app/dispatch/signing.h"
#include "app/dispatch/simulated_limits.h"
#include "base/files/temporary_folder.h"
#include "base/printable.h"
#include "devices/wire/modbus_tcp.h"
#include "sim/cell/cell_sim.h"

namespace qchopper {
namespace {

Sentence next_step(const ProjectJobs& ordered, const DryRunRequest& request) {
    if (!unproven_jobs(ordered, false).empty() || !unreachable_jobs(ordered.jobs).empty()) return {};
    const Link& link = ordered.cell.link;
    std::error_code error;
    const bool has_drop = link.drop && std::filesystem::is_directory(*link.drop, error);
    return Sentence::with_key(
        "dispatch",
        {request.project.string(), request.piece.value_or(""), link.to ? "" : "HOST:PORT", has_drop ? "" : "DIR"},
        "hand the jobs to the cell");
}

void warn_of(const ProjectJobs& ordered, const ProjectContext& context) {
    if (!ordered.is_finished) {
        context.warn(ordered.folder.string() + " is not finished: of its jobs the " +
                     std::to_string(ordered.jobs.size()) + " that are written so far are rehearsed");
    }
    for (const std::string& sentence : unproven_jobs(ordered, true)) {
        context.warn(sentence + "; dispatch to a real cell refuses it");
    }
    const TrustedKeys trusted = read_trusted_keys(trusted_keys_file(std::nullopt));
    for (const std::string& sentence : wrongly_signed_jobs(ordered, trusted, unix_ms())) {
        context.warn(sentence + "; dispatch refuses it");
    }
    for (const std::string& sentence : unreachable_jobs(ordered.jobs)) {
        context.warn(Sentence::with_key("asks_accept_unreachable", {sentence},
                                        sentence + "; dispatch asks whether that may stay"));
    }
    for (const std::string& sentence : jobs_failing_workholding(ordered.jobs)) {
        context.warn(sentence + "; dispatch asks before it sends it");
    }
}

// Programs that the cell could not execute. Its own threads tell of them.
class ProgramFaults {
 public:
    ProgramReader told(ProgramReader read) {
        if (!read) return read;
        return [this, read = std::move(read)](const Bytes& job_file, const std::string& name) {
            ReceivedProgram received = read(job_file, name);
            const std::lock_guard lock(mutex_);
            if (!received.fault.empty()) faults_.push_back(name + ": " + received.fault);
            return received;
        };
    }
    void warn(const ProjectContext& context) {
        const std::lock_guard lock(mutex_);
        for (const std::string& fault : faults_) context.warn(fault);
    }

 private:
    std::mutex mutex_;
    std::vector<std::string> faults_;
};

CellSimOptions simulated_cell(const Cell& cell, double speed, const std::filesystem::path& drop) {
    CellSimOptions options;
    options.drop_folder = drop;
    options.limits = simulated_limits(cell);
    options.limits.consent = Consent::automatic;
    options.limits.require_signature = false;  // nobody is asked for a passphrase where nothing moves
    options.limits.speed = speed;
    options.limits.acting_ms = 20;
    return options;
}

}  // namespace

DryRunAnswer dry_run(const DryRunRequest& request, const ProjectContext& context) {
    const ProjectJobs ordered = jobs_of(request.project, request.piece, context, true);
    warn_of(ordered, context);
    const TemporaryFolder drop("qchopper-dry-run-");
    CellSimOptions sim_options = simulated_cell(ordered.cell, request.speed, drop.path());
    ProgramFaults program_faults;
    sim_options.read_program = program_faults.told(program_reader(ordered.cell));
    CellSim sim(std::move(sim_options));
    sim.start();
    context.message("dry run: a simulated cell inside this program, over TCP on 127.0.0.1:" +
                    std::to_string(sim.port()) + "; consent is given at once, nothing moves");
    ModbusTcpBus bus({"127.0.0.1", sim.port()});
    DispatchOptions options;
    options.cell_id = ordered.cell.id;
    options.want_simulated = true;
    options.drop_folder = drop.path();
    options.timings.poll_s = 0.02;
    const TemporaryFolder state("qchopper-dry-run-journal-");
    Journal journal(state.path(), {ordered.cell.id, true, "dry-run"});
    std::vector<DispatchedJob> handed = dispatch_jobs(ordered.jobs, bus, options, journal, context);
    program_faults.warn(context);
    return {std::move(handed), ordered.jobs.size(), next_step(ordered, request)};
}

}  // namespace qchopper
