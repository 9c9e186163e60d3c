// The meshes of the folder `nasty`, for tests that hold on all of them.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "base/error.h"
#include "segment/io/read_mesh.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"

namespace qchopper {

// Calls action(mesh, name) with every mesh of the folder that can be read, welded, with at most so many triangles. The
// folder must be there (NEEDS_MESH).
template <class Action>
void for_each_nasty_mesh(std::size_t max_triangles, const Action& action) {
    for (const auto& entry : std::filesystem::directory_iterator(real_mesh("nasty"))) {
        TriangleMesh mesh;
        try {
            mesh = read_mesh(entry.path()).mesh;
        } catch (const InputError&) {
            continue;
        }
        weld(mesh);
        if (mesh.triangles.size() <= max_triangles) action(std::move(mesh), entry.path().filename().string());
    }
}

}  // namespace qchopper
