// Repair as segment/repair does it; beside it O(points) to warn of rounding.

#include "app/engine/repair_file.h"

#include <algorithm>

#include "app/store/project_folder.h"
#include "base/timings.h"
#include "segment/io/write_mesh.h"

namespace qchopper {
namespace {

bool is_single_precision(const TriangleMesh& mesh) {
    const auto fits = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
    return std::all_of(mesh.points.begin(), mesh.points.end(),
                       [&](Vec3 p) { return fits(p.x) && fits(p.y) && fits(p.z); });
}

}  // namespace

RepairedScan repair_file(const RepairRequest& request, const Context& context) {
    check_mesh_name(request.out);
    check_output(request.out);
    RepairedScan scan = repair_scan(request.scan, request.options, context);
    const StageTimer stage(context, "mesh written");
    enlarge(scan, request.options.scale);
    if (request.out.extension() == ".stl" && !is_single_precision(scan.mesh)) {
        scan.warnings.emplace_back("STL holds single precision: points are rounded; a .ply file keeps every bit.");
    }
    write_mesh(request.out, scan.mesh);
    return scan;
}

}  // namespace qchopper
