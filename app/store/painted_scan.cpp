// The share of area off the scan is that of triangles (segment/import/map_painted.h).

#include "app/store/painted_scan.h"

#include "base/error.h"
#include "base/text.h"
#include "segment/import/map_painted.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr double far_share = 0.005;    // of the diagonal: a painted surface farther from the scan is another's
constexpr double max_far_area = 0.01;  // of the painted area

}  // namespace

void place_on_scan(TriangleMesh& painted, double factor, Vec3 centre) {
    for (Vec3& p : painted.points) p = factor * p - centre;
}

void check_is_of_scan(const TriangleMesh& painted, const TriangleMesh& scan, const std::string& name) {
    const double distance = far_share * norm(bounds(scan).size());
    const double off = share_off_scan(painted, scan, distance);
    if (off <= max_far_area) return;
    throw InputError(InputFault::mesh,
                     name + " is not painted on this scan: " + fixed(100 * off, 1) + " % of its surface is more than " +
                         significant(distance, 3) + " mm away from it",
                     "paint a copy of the scan, and export it in the same units and place");
}

}  // namespace qchopper
