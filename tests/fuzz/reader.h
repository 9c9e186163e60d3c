// What every fuzzer of this folder does with a reader: any bytes end in a sound mesh or in an InputError.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "segment/error.h"
#include "segment/files/file.h"
#include "segment/intake/read_mesh.h"

namespace qchopper {

// Stops the program, which is what a fuzzer notices, where a mesh could hurt whoever takes it.
inline void demand_sound(const RawMesh& scan) {
    const TriangleMesh& mesh = scan.mesh;
    for (const Vec3& p : mesh.points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) std::abort();
    }
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) {
            if (corner >= mesh.points.size()) std::abort();
        }
    }
    if (!mesh.cap_of.empty() && mesh.cap_of.size() != mesh.triangles.size()) std::abort();
}

// Only InputError (mesh) may come out of `parse`; anything else ends the fuzzer.
template <class Parse>
void try_to_read(const Parse& parse) {
    try {
        demand_sound(parse());
    } catch (const InputError& error) {
        if (error.fault != InputFault::mesh) std::abort();
    }
}

}  // namespace qchopper
