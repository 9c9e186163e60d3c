#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/project_arguments.h"
#include "app/project/project_folder.h"
#include "app/report/repair_report.h"
#include "segment/import/import_scan.h"
#include "segment/io/write_ply.h"
#include "segment/io/write_stl.h"

namespace qchopper {
namespace {

ImportOptions options_of(const RepairArguments& a) {
    if ((a.mark_width || a.mark_depth) && !a.smooth_marks) {
        throw InputError(InputFault::use, "--mark-width and --mark-depth tell what --smooth-marks looks for",
                         "pass --smooth-marks too");
    }
    const auto is_skipped = [&](const std::string& step) {
        return std::find(a.skipped.begin(), a.skipped.end(), step) != a.skipped.end();
    };
    ImportOptions options;
    if (a.units) options.mm_per_unit = mm_per(unit_named(*a.units));
    options.scale = a.scale.value_or(1);
    options.may_lack_unit = !a.weld_mm && !a.smooth_marks && !a.wrap_mm;  // nothing is said in mm
    RepairChoices choices = repair_choices(a);
    choices.resolve_self_intersections = !a.keep_self_intersections;
    options.repair = qchopper::options_of(choices);
    options.repair.marks.most_width = a.mark_width.value_or(options.repair.marks.most_width);
    options.repair.marks.most_depth = a.mark_depth.value_or(options.repair.marks.most_depth);
    options.repair.drop_repeated = !is_skipped("faces");
    options.repair.split = !is_skipped("split");
    options.repair.orient = !is_skipped("orient");
    options.repair.stitch = !is_skipped("stitch");
    options.repair.remove_degenerate = !is_skipped("degenerate");
    options.repair.orient_outward = !is_skipped("outwards");
    options.repair.drop_fragments = a.fragments && *a.fragments == "drop";
    options.repair.measure_deviation = true;
    return options;
}

bool is_single_precision(const TriangleMesh& mesh) {
    const auto fits = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
    return std::all_of(mesh.points.begin(), mesh.points.end(),
                       [&](Vec3 p) { return fits(p.x) && fits(p.y) && fits(p.z); });
}

}  // namespace

int run(const RepairArguments& arguments, Terminal& terminal) {
    const bool is_stl = arguments.out.extension() == ".stl";
    if (!is_stl && arguments.out.extension() != ".ply") {
        throw InputError(InputFault::use, arguments.out.string() + " ends neither in .ply nor in .stl",
                         "name a .ply file");
    }
    const ImportOptions options = options_of(arguments);
    check_output(arguments.out);
    RepairedScan scan = repair_scan(arguments.scan, options, terminal.context());
    enlarge(scan, options.scale);
    if (is_stl && !is_single_precision(scan.mesh)) {
        scan.warnings.emplace_back("STL holds single precision: points are rounded; a .ply file keeps every bit.");
    }
    write_file(arguments.out, is_stl ? to_stl(scan.mesh) : to_ply(scan.mesh));
    terminal.warn(scan.warnings);
    const RepairedFile file{arguments.scan, arguments.out, options.scale};
    terminal.show(lines(scan, file));
    terminal.json(document(scan, file));
    return scan.report.is_solid() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper
