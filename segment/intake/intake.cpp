#include "segment/intake/intake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "segment/error.h"
#include "segment/files/file.h"
#include "segment/intake/inspect.h"
#include "segment/intake/read_mesh.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/shells.h"
#include "segment/repair/fill_holes.h"
#include "segment/repair/manifold.h"
#include "segment/repair/nesting.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

struct UnitName {
    std::string_view name;
    double mm;
};
constexpr std::array<UnitName, 4> units{{{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}}};  // in the order of Unit

constexpr double most_fill_of_surface = 0.8;   // of a shell's area: beyond this it is a sheet, not a solid
constexpr double warn_fill_of_surface = 0.05;  // of the whole area
constexpr double largest_mm = 1e11;            // beyond this a double does not hold 0.0001 mm any more
constexpr const char* repair_first = "repair the scan in the scanning software, then try again";

std::string in_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

// One scan on its way from the file to a solid.
class Taking {
 public:
    Taking(std::string name, const IntakeOptions& options, const Context& context)
        : name_(std::move(name)), factor_(options.mm_per_unit * options.scale), context_(context) {
        if (!(options.mm_per_unit > 0) || !(options.scale > 0) || !std::isfinite(factor_) || factor_ == 0) {
            throw InputError(InputFault::use, "units and scale must be positive numbers", "leave --scale out for 1");
        }
        if (options.scale != 1) {
            warn("The scan is scaled by " + in_digits(options.scale) + " (--scale): its pieces are not in true size.");
        }
    }

    Intake take(const Bytes& bytes) {
        taken_.sha256 = sha256(bytes);
        read(bytes);
        clean();
        close();
        turn_outwards();
        check_closed();
        check_size();
        return std::move(taken_);
    }

 private:
    // Each step checks for a stop and says where it is.
    void step(const std::string& what) {
        context_.check_cancelled();
        context_.progress(what, ++steps_, 5);
    }

    // Coordinates become mm about the middle of the box of all points in use.
    void read(const Bytes& bytes) {
        step("scan read");
        RawMesh scan = parse_mesh(bytes, name_);
        mesh_ = std::move(scan.mesh);
        mesh_.cap_of.clear();  // caps of an earlier segmentation mean nothing here
        report_.faces_in = mesh_.triangles.size();
        report_.points_in = mesh_.points.size();
        if (scan.faces_without_area > 0) {
            warn(counted(scan.faces_without_area, "face has", "faces have") + " fewer than three corners; left out.");
        }
        Box box{mesh_.points[mesh_.triangles[0][0]], mesh_.points[mesh_.triangles[0][0]]};
        for (const Triangle& t : mesh_.triangles) {
            for (const std::uint32_t corner : t) {
                for (int axis = 0; axis < 3; ++axis) {
                    box.min[axis] = std::min(box.min[axis], mesh_.points[corner][axis]);
                    box.max[axis] = std::max(box.max[axis], mesh_.points[corner][axis]);
                }
            }
        }
        const double far = largest_mm / factor_;
        for (int axis = 0; axis < 3; ++axis) {
            if (box.min[axis] < -far || box.max[axis] > far) {
                throw InputError(InputFault::mesh,
                                 name_ + " reaches to (" + in_file_units(box.max) + ") and (" + in_file_units(box.min) +
                                     "): more than 100 000 km from its origin",
                                 "check --units, or export the scan again");
            }
        }
        taken_.centre = factor_ * box.centre();
        for (Vec3& p : mesh_.points) p = factor_ * p - taken_.centre;
    }

    void clean() {
        step("points welded");
        const WeldCounts counts = weld(mesh_);
        report_.welded = counts.welded;
        report_.collapsed_dropped = counts.collapsed;
        report_.unreferenced_dropped = counts.unreferenced;
        if (mesh_.triangles.empty()) {
            throw InputError(InputFault::mesh, name_ + ": no face has an area", repair_first);
        }
        const Edges found = edges(mesh_);
        if (found.faults.non_manifold + found.faults.inconsistent > 0) refuse_edges(found);
        report_.pinched_split = split_pinched(mesh_, found);
    }

    [[noreturn]] void refuse_edges(const Edges& found) const {
        const std::uint32_t first = unpaired(mesh_, found).faulty.front();
        std::string what = name_ + " is not the surface of a solid:";
        if (found.faults.non_manifold > 0) {
            what +=
                " " + counted(found.faults.non_manifold, "edge belongs", "edges belong") + " to three faces or more";
        }
        if (found.faults.inconsistent > 0) {
            what += std::string(found.faults.non_manifold > 0 ? ", and" : "") + " at " +
                    counted(found.faults.inconsistent, "edge", "edges") + " the two faces turn opposite ways";
        }
        throw InputError(InputFault::mesh, what + "; the first at " + place(mesh_.points[start_of(mesh_, first)]),
                         repair_first);
    }

    void close() {
        step("holes closed");
        const std::size_t before = mesh_.triangles.size();
        const FilledHoles holes = fill_holes(mesh_);
        report_.holes_filled = holes.filled;
        report_.triangles_added = holes.triangles;
        if (!holes.left.empty()) {
            const OpenHole& hole = holes.left.front();
            throw InputError(InputFault::mesh,
                             name_ + ": " + counted(holes.left.size(), "hole", "holes") +
                                 " cannot be closed; the first has " + std::to_string(hole.edges) + " edges around " +
                                 place(hole.centre),
                             repair_first);
        }
        if (holes.filled > 0) check_filling(before);
    }

    // Any border can be closed somehow; a sheet that is closed so has no inside worth carving.
    void check_filling(std::size_t first_added) {
        const Shells found = shells(mesh_);
        std::vector<double> scanned(found.count());
        std::vector<double> added(found.count());
        double all_scanned = 0;
        double all_added = 0;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const double area = norm(area_vector(mesh_, t));
            (t < first_added ? scanned : added)[found.shell_of[t]] += area;
            (t < first_added ? all_scanned : all_added) += area;
        }
        std::size_t sheets = 0;
        std::size_t first_sheet = 0;
        for (std::size_t s = found.count(); s-- > 0;) {
            if (added[s] <= most_fill_of_surface * scanned[s]) continue;
            ++sheets;
            first_sheet = s;
        }
        if (sheets > 0) {
            throw InputError(InputFault::mesh,
                             name_ + " is open: " + counted(sheets, "part of it is a sheet", "parts of it are sheets") +
                                 " with more missing than there is; the first around " +
                                 place(found.box[first_sheet].centre()),
                             "scan the other side too, or close the surface in the scanning software");
        }
        warn(counted(report_.holes_filled, "hole", "holes") + " closed with " +
             counted(report_.triangles_added, "face", "faces") + ".");
        if (all_added > warn_fill_of_surface * all_scanned) {
            warn("What closes the holes makes up " +
                 in_digits(std::round(100 * all_added / (all_scanned + all_added))) +
                 " % of the surface: compare the picture with the bone.");
        }
    }

    // An outer shell that is inside out is turned, and what lies in it so that insides and outsides alternate.
    void turn_outwards() {
        step("shells turned outwards");
        const Shells found = shells(mesh_);
        report_.shells = found.count();
        const std::vector<std::vector<std::uint32_t>> around = shells_around(mesh_, found);
        std::vector<bool> is_turned(found.count());
        std::size_t overlapping = 0;
        for (std::size_t s = 0; s < found.count(); ++s) {
            const bool should_be_outer = around[s].size() % 2 == 0;
            const bool is_outer = !(found.volume[s] < 0);
            const bool in_turned = std::any_of(around[s].begin(), around[s].end(), [&](std::uint32_t outer) {
                return around[outer].empty() && found.volume[outer] < 0;
            });
            is_turned[s] = is_outer != should_be_outer && (around[s].empty() || in_turned);
            report_.shells_turned += is_turned[s];
            report_.cavities += is_outer == static_cast<bool>(is_turned[s]);
            overlapping += is_outer != should_be_outer && !is_turned[s];
        }
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (is_turned[found.shell_of[t]]) std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
        }
        if (report_.shells_turned > 0) {
            warn(counted(report_.shells_turned, "shell was", "shells were") + " inside out and turned.");
        }
        if (overlapping > 0) {
            warn(counted(overlapping, "shell lies", "shells lie") +
                 " inside another one that faces the same way: the scan overlaps itself there.");
        }
    }

    void check_closed() {
        const EdgeFaults faults = edges(mesh_).faults;
        if (!faults.is_closed()) {
            throw InputError(
                InputFault::mesh,
                name_ + " does not close near " + place(mesh_.points[mesh_.triangles[faults.first_triangle][0]]),
                repair_first);
        }
        if (!(volume_mm3(mesh_) > 0)) {
            throw InputError(InputFault::mesh, name_ + " has no volume", repair_first);
        }
    }

    void check_size() {
        step("scan taken in");
        const Vec3 size = bounds(mesh_).size();
        const double longest = std::max({size.x, size.y, size.z});
        if (longest < 10 || longest > 20000) {
            warn("The scan measures " + size_in_words(size) + ": is --units right?");
        }
        taken_.mesh = std::move(mesh_);
    }

    std::string in_file_units(Vec3 p) const { return in_digits(p.x) + ", " + in_digits(p.y) + ", " + in_digits(p.z); }
    std::string place(Vec3 p) const {
        return "(" + in_file_units((1 / factor_) * (p + taken_.centre)) + ") in the units of the file";
    }
    void warn(const std::string& sentence) { report_.warnings.push_back(sentence); }

    std::string name_;
    double factor_;
    const Context& context_;
    std::size_t steps_ = 0;
    TriangleMesh mesh_;
    Intake taken_;
    IntakeReport& report_ = taken_.report;
};

}  // namespace

double mm_per(Unit unit) {
    return units[static_cast<std::size_t>(unit)].mm;
}

std::string name_of(Unit unit) {
    return std::string(units[static_cast<std::size_t>(unit)].name);
}

Unit unit_named(std::string_view name) {
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (units[i].name == name) return static_cast<Unit>(i);
    }
    throw InputError(InputFault::use, "unknown unit \"" + std::string(name) + "\"", "use mm, cm, m or in");
}

Intake take_in(const std::filesystem::path& path, const IntakeOptions& options, const Context& context) {
    Taking taking(path.string(), options, context);
    return taking.take(read_file(path));
}

}  // namespace qchopper
