// Makes one mesh of several range scans.

#include "segment/fuse/fuse.h"

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/scan/fuse_report.h"
#include "app/store/project_folder.h"
#include "base/timings.h"
#include "segment/io/write_mesh.h"

namespace qchopper {

int run(const FuseArguments& a, Terminal& terminal) {
    check_mesh_name(a.out);
    check_output(a.out);
    const Context context = terminal.context();
    StageTimer stage(context, "scans fused");
    const Fused fused = fuse(a.list, {a.voxel}, context);
    stage.next("mesh written");
    write_mesh(a.out, fused.mesh);
    terminal.show(lines(fused, a.out), document(fused, a.out));
    return exit_done;
}

}  // namespace qchopper
