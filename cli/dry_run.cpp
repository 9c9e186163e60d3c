#include <unistd.h>

#include <cstdlib>

#include "cli/commands.h"
#include "cli/hand_over.h"
#include "cli/simulated_limits.h"
#include "devices/modbus_tcp.h"
#include "segment/error.h"
#include "sim/cell_sim.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// A folder that is gone when the dry run is over.
struct PassingFolder {
    fs::path path;
    PassingFolder() {
        std::string name = (fs::temp_directory_path() / "qchopper-drop-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) {
            throw InputError(InputFault::create,
                             "no folder for the drop can be made in " + fs::temp_directory_path().string(),
                             "free some space there");
        }
        path = name;
    }
    ~PassingFolder() {
        std::error_code error;
        fs::remove_all(path, error);
    }
    PassingFolder(const PassingFolder&) = delete;
    PassingFolder& operator=(const PassingFolder&) = delete;
};

}  // namespace

int run(const DryRunArguments& arguments, Terminal& terminal) {
    terminal.unchanged = "The project is unchanged.";
    const std::vector<PieceJob> jobs = jobs_of(arguments.project, arguments.piece);
    const Cell cell = read_cell(arguments.project / "cell.toml");
    const PassingFolder drop;
    CellSimOptions options;
    options.drop_folder = drop.path;
    options.limits = simulated_limits(cell);
    options.limits.consent = Consent::automatic;
    options.limits.speed = arguments.speed;
    options.limits.acting_ms = 20;
    CellSim sim(options);
    sim.start();
    terminal.say("dry run: a simulated cell inside this program, over TCP on 127.0.0.1:" + std::to_string(sim.port()) +
                 "; consent is given at once, nothing moves");
    ModbusTcpBus bus({"127.0.0.1", sim.port()});
    DispatchOptions dispatch;
    dispatch.cell_id = cell.id;
    dispatch.want_simulated = true;
    dispatch.drop_folder = drop.path;
    dispatch.timings.poll_s = 0.02;
    return report(hand_over(jobs, bus, dispatch, terminal), jobs.size(), "qchopper-dry-run-1", true, terminal);
}

}  // namespace qchopper
