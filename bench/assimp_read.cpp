// assimp's importer without any post-processing.

#include "bench/other_readers.h"

#ifdef QCHOPPER_HAS_ASSIMP
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

namespace qchopper::bench {

#ifdef QCHOPPER_HAS_ASSIMP

bool has_assimp() {
    return true;
}

std::size_t assimp_read(const std::filesystem::path& file) {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(file.string(), 0);
    std::size_t faces = 0;
    for (unsigned i = 0; scene != nullptr && i < scene->mNumMeshes; ++i) faces += scene->mMeshes[i]->mNumFaces;
    return faces;
}

#else

bool has_assimp() {
    return false;
}

std::size_t assimp_read(const std::filesystem::path&) {
    return 0;
}

#endif

}  // namespace qchopper::bench
