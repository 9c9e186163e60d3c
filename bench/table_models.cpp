// One list.

#include "bench/table_models.h"

#include <algorithm>

#include "bench/specimens.h"
#include "segment/mesh/measure.h"

namespace qchopper::bench {
namespace {

constexpr double longest_side_mm = 1000;

}  // namespace

const std::vector<TableModel>& table_models() {
    static const std::vector<TableModel> all{{"femur_3548", "femur_3548.stl", std::nullopt},
                                             {"vertebra", "", Specimen::vertebra},
                                             {"femur", "", Specimen::femur},
                                             {"skull", "", Specimen::skull},
                                             {"skull_scan_25k", "skull_scan_25k.stl", std::nullopt},
                                             {"bunny", "bunny_bun_zipper.ply", std::nullopt},
                                             {"igea", "igea_268k.ply", std::nullopt},
                                             {"gorilla", "gorilla_skull_159k.ply", std::nullopt},
                                             {"ct_head_371k", "ct_head_371k.ply", std::nullopt},
                                             {"dragon", "dragon_vrip_871k.ply", std::nullopt}};
    return all;
}

std::optional<TriangleMesh> mesh_of(const TableModel& model, const std::filesystem::path& data,
                                    std::size_t specimen_faces) {
    std::optional<TriangleMesh> mesh;
    if (model.specimen) {
        SampleOptions options;
        options.faces = specimen_faces;
        mesh = sample(*model.specimen, options);
    } else if (const auto read = scan(data / model.file, 1)) {
        mesh = *read;
    }
    if (!mesh) return std::nullopt;
    const Vec3 size = bounds(*mesh).size();
    for (Vec3& p : mesh->points) p = (longest_side_mm / std::max({size.x, size.y, size.z})) * p;
    return mesh;
}

}  // namespace qchopper::bench
