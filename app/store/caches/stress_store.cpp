// One file per scan and load. O(triangles) for the name, O(voxels) for the content.

#include "app/store/caches/stress_store.h"

#include "app/store/caches/cache_file.h"
#include "base/timings.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever the stress of the same scan and load changes.
constexpr std::uint32_t version_of_stress = 1;

fs::path file_for(const fs::path& folder, const TriangleMesh& scan, const StructureOptions& load) {
    CacheWriter out;
    out.put(version_of_stress);
    for (const double x : {load.up.x, load.up.y, load.up.z, load.density_kg_per_m3, load.strength_mpa, load.force_n,
                           load.poisson_ratio, load.voxel_mm}) {
        out.put(x);
    }
    out.put(static_cast<std::uint8_t>(load.has_own_weight));
    out.put(load.unknowns);
    out.put_all(scan.points);
    out.put_all(scan.triangles);
    return cache_file(folder, out, ".stress");
}

void put(CacheWriter& out, const StructureReport& report) {
    for (const std::size_t n :
         {report.unknowns, report.iterations, report.standing_voxels, report.thin_voxels, report.hinges}) {
        out.put(n);
    }
    out.put(report.residual);
    out.put(report.largest_tension_mpa);
    out.put(report.largest_tension_at);
    out.put(report.floating.size());
    for (const FloatingSolid& solid : report.floating) {
        out.put(solid.voxels);
        out.put(solid.centre);
        out.put(static_cast<std::uint8_t>(solid.is_hinged));
    }
}

StructureReport report_from(CacheReader& in) {
    StructureReport report;
    for (std::size_t* n :
         {&report.unknowns, &report.iterations, &report.standing_voxels, &report.thin_voxels, &report.hinges}) {
        *n = in.get<std::size_t>();
    }
    report.residual = in.get<double>();
    report.largest_tension_mpa = in.get<double>();
    report.largest_tension_at = in.vec3();
    report.floating.resize(in.count());
    for (FloatingSolid& solid : report.floating) {
        solid.voxels = in.get<std::size_t>();
        solid.centre = in.vec3();
        solid.is_hinged = in.get<std::uint8_t>() != 0;
    }
    return report;
}

CacheWriter content_of(const StressedModel& model) {
    CacheWriter out;
    for (const Vec3 axis : model.grid.axis) out.put(axis);
    out.put(model.grid.corner);
    out.put(model.grid.size);
    for (const std::uint32_t n : model.grid.count) out.put(n);
    out.put(model.strength_mpa);
    out.put_all(model.voxels);
    out.put_all(model.stress);
    out.put_all(model.is_thick);
    put(out, model.report);
    return out;
}

std::optional<StressedModel> found_in(const fs::path& file) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    StressedModel model;
    for (Vec3& axis : model.grid.axis) axis = in.vec3();
    model.grid.corner = in.vec3();
    model.grid.size = in.get<double>();
    for (std::uint32_t& n : model.grid.count) n = in.get<std::uint32_t>();
    model.strength_mpa = in.get<double>();
    model.voxels = in.get_all<std::uint32_t>();
    model.stress = in.get_all<Stress>();
    model.is_thick = in.get_all<std::uint8_t>();
    model.report = report_from(in);
    if (!in.is_whole() || model.stress.size() != model.voxels.size() || model.is_thick.size() != model.voxels.size()) {
        return std::nullopt;
    }
    return model;
}

}  // namespace

std::shared_ptr<const StressedModel> kept_stress(const fs::path& folder, const TriangleMesh& scan,
                                                 const StructureOptions& load, const Context& context) {
    const StageTimer stage(context, "stress analysed");
    const fs::path file = file_for(folder, scan, load);
    if (std::optional<StressedModel> found = found_in(file)) {
        return std::make_shared<const StressedModel>(std::move(*found));
    }
    auto model = std::make_shared<const StressedModel>(stress_of(scan, load, context));
    keep(file, content_of(*model));
    return model;
}

}  // namespace qchopper
