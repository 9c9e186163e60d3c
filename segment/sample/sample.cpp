// The isosurface on a base lattice; for more faces a finer lattice, for fewer faces the base surface with edges
// collapsed.

#include "segment/sample/sample.h"

#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/sample/bones.h"
#include "segment/sample/isosurface.h"
#include "segment/sample/punch.h"
#include "segment/sample/refine.h"
#include "segment/simplify/collapse.h"

namespace qchopper {
namespace {

constexpr std::array<std::string_view, 3> names{"vertebra", "femur", "skull"};  // in the order of Specimen

Bone bone_of(Specimen specimen) {
    switch (specimen) {
        case Specimen::vertebra:
            return vertebra();
        case Specimen::femur:
            return femur();
        case Specimen::skull:
            break;
    }
    return skull();
}

void check(const SampleOptions& options) {
    const auto check_range = [](auto value, auto least, auto most, const std::string& what) {
        if (value >= least && value <= most) return;
        throw InputError(InputFault::use, "a sample has " + std::to_string(least) + " to " + std::to_string(most) +
                                              " " + what + ", not " + std::to_string(value));
    };
    check_range(options.faces, fewest_sample_faces, max_sample_faces, "faces");
    check_range(options.holes, 0, max_sample_holes, "holes");
    check_range(options.pen_grooves, 0, max_sample_pen_grooves, "pen grooves");
}

// The spacing that gives a little fewer triangles than `faces`: their number is about proportional to 1 / spacing
// squared.
double spacing_for(const Bone& bone, std::size_t faces, std::size_t base_faces, const Context& context) {
    constexpr double aim = 0.99;
    constexpr int max_tries = 6;
    const auto wanted = static_cast<double>(faces);
    double spacing = bone.base_spacing * std::sqrt(static_cast<double>(base_faces) / (aim * wanted));
    for (int i = 0; i < max_tries; ++i) {
        context.progress("lattices tried", static_cast<std::size_t>(i), 0);
        const auto count = static_cast<double>(count_triangles(bone.field, bone.box, spacing, context));
        if (count <= wanted && count >= 0.97 * wanted) break;
        spacing *= std::sqrt(count / (aim * wanted));
    }
    return spacing;
}

// More faces than on the base lattice: a finer lattice, then splits of edges up to the exact number.
TriangleMesh dense(const Bone& bone, std::size_t faces, std::size_t base_faces, const Context& context) {
    double spacing = spacing_for(bone, faces, base_faces, context);
    TriangleMesh mesh = isosurface(bone.field, bone.box, spacing, context);
    while (mesh.triangles.size() > faces) {
        spacing *= 1.01;
        mesh = isosurface(bone.field, bone.box, spacing, context);
    }
    while (mesh.triangles.size() < faces) split_longest_edges(mesh, (faces - mesh.triangles.size()) / 2);
    return mesh;
}

// Fewer faces than on the base lattice. A collapse may let parts of the surface intersect, so the result is checked.
// False if there is no surface of that many faces without an intersection.
bool make_coarse(TriangleMesh& mesh, std::size_t faces, const Context& context) {
    CollapseLimits limits;
    limits.max_faces = faces;
    return collapse_edges(mesh, {}, limits, context) && mesh.triangles.size() == faces &&
           self_intersections(mesh, {}, context).is_free();
}

}  // namespace

std::optional<Specimen> specimen_named(std::string_view name) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name) return static_cast<Specimen>(i);
    }
    return {};
}

TriangleMesh sample(Specimen specimen, const SampleOptions& options, const Context& context, DrawnPenGrooves* drawn) {
    check(options);
    const std::size_t faces = options.faces - options.faces % 2;
    const Bone bone = bone_of(specimen);
    TriangleMesh mesh = isosurface(bone.field, bone.box, bone.base_spacing, context);
    if (faces > mesh.triangles.size()) {
        mesh = dense(bone, faces, mesh.triangles.size(), context);
    } else if (faces < mesh.triangles.size() && !make_coarse(mesh, faces, context)) {
        throw InputError(InputFault::use, "this specimen cannot be represented by " + std::to_string(faces) + " faces",
                         "give a larger number of faces");
    }
    const int holes = punch_holes(mesh, options.holes);
    if (holes < options.holes) {
        throw InputError(InputFault::use,
                         "there is room for " + std::to_string(holes) + " holes, not " + std::to_string(options.holes),
                         "give more faces or fewer holes");
    }
    if (options.pen_grooves > 0) {
        const DrawnPenGrooves made = draw_pen_grooves(mesh, {options.pen_grooves});
        if (drawn != nullptr) *drawn = made;
    }
    return mesh;
}

}  // namespace qchopper
