// Makes synthetic specimens: a vertebra, a femur and a skull, with thin walls, handles and openings as real bones have.
//
// Lengths are millimetres. The number of faces sets the sampling density only, not the shape. Every specimen without
// holes is closed, faces outwards and does not intersect itself; the same options give the same bytes
// (tests/segment/sample/sample_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/draw_pen_grooves.h"

namespace qchopper {

enum class Specimen {
    vertebra,  // 0.35 m: the foramen is a handle; thin spinous and transverse processes, four articular facets
    femur,     // 1.2 m: bowed shaft, head on a neck, greater trochanter, two condyles with a notch
    skull      // 2 m: hollow brain case, orbits, zygomatic arches as handles, nostrils, teeth
};

struct SampleOptions {
    std::size_t faces = 100000;  // of the closed specimen; an odd number means the even one below
    int holes = 0;               // number of holes, each with one border loop (punch.h)
    int pen_grooves = 0;         // number of pen grooves (draw_pen_grooves.h)
};

constexpr std::size_t fewest_sample_faces = 2000;
constexpr std::size_t max_sample_faces = 50'000'000;
constexpr int max_sample_holes = 100;
constexpr int max_sample_pen_grooves = 100;

// "vertebra", "femur" or "skull"; nothing for any other word.
std::optional<Specimen> specimen_named(std::string_view name);

// Throws InputError (use) for a number of faces, holes or pen grooves outside these bounds, for too few faces for the
// specimen, and for more holes than there is room for. Pen grooves change no triangle; `drawn`, if not null, receives
// what was drawn. Throws Cancelled (base/context.h). O(faces log faces).
TriangleMesh sample(Specimen specimen, const SampleOptions& options, const Context& context = {},
                    DrawnPenGrooves* drawn = nullptr);

}  // namespace qchopper
