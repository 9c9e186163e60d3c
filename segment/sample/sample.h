// Specimens that the project makes itself: a vertebra, a femur and a skull that look like bones and are hard like
// bones.
//
// Lengths are millimetres. The shape does not depend on the number of faces, which sets the sampling density only.
// Every specimen is closed, faces outwards, does not meet itself, and the same options give the same bytes
// (tests/segment/sample/sample_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/draw_marks.h"

namespace qchopper {

enum class Specimen {
    vertebra,  // 0.35 m: the foramen is a handle; thin spinous and transverse processes, four articular facets
    femur,     // 1.2 m: bowed shaft, head on a neck, greater trochanter, two condyles with a notch
    skull      // 2 m: hollow brain case, orbits, zygomatic arches as handles, nostrils, teeth
};

struct SampleOptions {
    std::size_t faces = 100000;  // of the closed specimen; an odd number means the even one below
    int holes = 0;               // this many patches of faces are taken out, each leaves one border loop
    int marks = 0;               // this many lines are drawn on it, each a narrow shallow dent (draw_marks.h)
};

constexpr std::size_t fewest_sample_faces = 2000;
constexpr std::size_t most_sample_faces = 50'000'000;
constexpr int most_sample_holes = 100;
constexpr int most_sample_marks = 100;

// "vertebra", "femur" or "skull"; nothing for any other word.
std::optional<Specimen> specimen_named(std::string_view name);

// Throws InputError (use) for fewer than fewest_sample_faces or more than most_sample_faces, or for more holes than
// the surface has room for. Marks change no triangle; `drawn` (may be null) tells of them.
TriangleMesh sample(Specimen specimen, const SampleOptions& options, const Context& context = {},
                    DrawnMarks* drawn = nullptr);

}  // namespace qchopper
