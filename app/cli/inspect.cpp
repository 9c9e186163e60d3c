// Reports what a scan is and what is wrong with it.

#include "segment/import/inspect.h"

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/scan/inspect_report.h"
#include "base/timings.h"
#include "segment/import/import_scan.h"

namespace qchopper {

int run(const InspectArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    InspectOptions options;
    options.deep = arguments.deep;
    const Context context = terminal.context();
    StageTimer stage(context, "scan read");
    RawMesh scan = read_mesh(arguments.scan, {.weld = true});
    stage.next("scan inspected");
    Inspection inspection = inspect(std::move(scan), options, context);
    std::optional<double> given;
    if (arguments.units) given = mm_per(unit_named(*arguments.units));
    const std::optional<double> mm = agreed_mm_per_unit(inspection.mm_per_unit, given, name_of_scan(arguments.scan));
    const Vec3 size = mm.value_or(1) * inspection.box.size();
    if (mm && inspection.triangles > 0 && !is_usual_size(size)) inspection.warnings.push_back(size_warning(size));
    InspectedFile file{name_of_scan(arguments.scan), {}, inspection};
    if (mm) file.units = name_of(unit_of(*mm));
    terminal.show(lines(file), document(file));
    return exit_done;
}

}  // namespace qchopper
