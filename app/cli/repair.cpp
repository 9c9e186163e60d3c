// Makes a closed solid of a scan and reports what was done.

#include "app/cli/arguments/project_arguments.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/unusual_size.h"
#include "app/report/scan/repair_report.h"
#include "segment/io/write_mesh.h"

namespace qchopper {

int run(const RepairArguments& a, Terminal& terminal) {
    check_mesh_name(a.out);
    RepairRequest request{a.scan, a.out, import_options_of(a)};
    request.options.on_unusual_size = unusual_size_check(a.size_ok);
    const RepairedScan scan = repair_file(request, terminal.context());
    terminal.warn(scan.warnings);
    terminal.show(lines(scan, request), document(scan, request));
    return scan.report.is_solid() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper
