#include "segment/sample/sample.h"

#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "segment/repair/self_intersections.h"
#include "segment/sample/bones.h"
#include "segment/sample/punch.h"
#include "segment/sample/refine.h"
#include "segment/sample/surface.h"
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
    if (options.faces < fewest_sample_faces || options.faces > most_sample_faces) {
        throw InputError(InputFault::use, "a sample has " + std::to_string(fewest_sample_faces) + " to " +
                                              std::to_string(most_sample_faces) + " faces, not " +
                                              std::to_string(options.faces));
    }
    if (options.holes < 0 || options.holes > most_sample_holes) {
        throw InputError(InputFault::use, "a sample has 0 to " + std::to_string(most_sample_holes) + " holes, not " +
                                              std::to_string(options.holes));
    }
    if (options.marks < 0 || options.marks > most_sample_marks) {
        throw InputError(InputFault::use, "a sample has 0 to " + std::to_string(most_sample_marks) + " marks, not " +
                                              std::to_string(options.marks));
    }
}

// The lattice that gives a little fewer triangles than asked for: their number goes with 1 / spacing squared, nearly.
double spacing_for(const Bone& bone, std::size_t faces, std::size_t base_faces, const Context& context) {
    constexpr double aim = 0.99;
    constexpr int most_tries = 6;
    const auto wanted = static_cast<double>(faces);
    double spacing = bone.base_spacing * std::sqrt(static_cast<double>(base_faces) / (aim * wanted));
    for (int i = 0; i < most_tries; ++i) {
        context.progress("lattices tried", static_cast<std::size_t>(i), 0);
        const auto count = static_cast<double>(count_triangles(bone.field, bone.box, spacing, context));
        if (count <= wanted && count >= 0.97 * wanted) break;
        spacing *= std::sqrt(count / (aim * wanted));
    }
    return spacing;
}

// Denser than the base lattice: a finer lattice, then single splits up to the very number.
TriangleMesh dense(const Bone& bone, std::size_t faces, std::size_t base_faces, const Context& context) {
    double spacing = spacing_for(bone, faces, base_faces, context);
    TriangleMesh mesh = surface(bone.field, bone.box, spacing, context);
    while (mesh.triangles.size() > faces) {
        spacing *= 1.01;
        mesh = surface(bone.field, bone.box, spacing, context);
    }
    while (mesh.triangles.size() < faces) split_longest_edges(mesh, (faces - mesh.triangles.size()) / 2);
    return mesh;
}

// Coarser than the base lattice: its surface with edges collapsed. A collapse does not look at what lies near by, so
// the result is checked. False where it is no such surface of so many faces.
bool make_coarse(TriangleMesh& mesh, std::size_t faces, const Context& context) {
    CollapseLimits limits;
    limits.most_faces = faces;
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

TriangleMesh sample(Specimen specimen, const SampleOptions& options, const Context& context, DrawnMarks* drawn) {
    check(options);
    const std::size_t faces = options.faces - options.faces % 2;
    const Bone bone = bone_of(specimen);
    TriangleMesh mesh = surface(bone.field, bone.box, bone.base_spacing, context);
    if (faces > mesh.triangles.size()) {
        mesh = dense(bone, faces, mesh.triangles.size(), context);
    } else if (faces < mesh.triangles.size() && !make_coarse(mesh, faces, context)) {
        throw InputError(InputFault::use, "this specimen cannot be told with " + std::to_string(faces) + " faces",
                         "ask for more");
    }
    const int taken = punch_holes(mesh, options.holes);
    if (taken < options.holes) {
        throw InputError(InputFault::use,
                         "there is room for " + std::to_string(taken) + " holes, not " + std::to_string(options.holes),
                         "ask for more faces or fewer holes");
    }
    if (options.marks > 0) {
        DrawOptions lines;
        lines.marks = options.marks;
        const DrawnMarks made = draw_marks(mesh, lines);
        if (drawn != nullptr) *drawn = made;
    }
    return mesh;
}

}  // namespace qchopper
