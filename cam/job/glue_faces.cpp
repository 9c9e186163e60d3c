// Flush caps grouped by their faces.

#include "cam/job/glue_faces.h"

#include <algorithm>
#include <array>

namespace qchopper {
namespace {

void add_neighbours(std::span<const JobCap> caps, std::int32_t cut, std::vector<std::string>& names) {
    for (const JobCap& cap : caps) {
        if (cap.cut != cut) continue;
        for (const CapJoint& joint : cap.joints) {
            if (std::find(names.begin(), names.end(), joint.neighbour) == names.end()) names.push_back(joint.neighbour);
        }
    }
}

}  // namespace

std::vector<GlueFace> glue_faces(const Setup& setup, std::span<const JobCap> caps) {
    std::vector<GlueFace> faces;
    for (std::size_t f = 0; f < block_faces; ++f) {
        GlueFace face{static_cast<BlockFace>(f), {}, 0, {}};
        for (const FlushCap& cap : setup.flush_caps) {
            if (cap.face != face.face) continue;
            face.cuts.push_back(cap.cut);
            face.area_mm2 += cap.area_mm2;
            add_neighbours(caps, cap.cut, face.neighbours);
        }
        if (!face.cuts.empty()) faces.push_back(std::move(face));
    }
    return faces;
}

std::vector<std::string> neighbours_at_base(const Setup& setup, std::span<const JobCap> caps) {
    std::vector<std::string> names;
    if (setup.base) add_neighbours(caps, *setup.base, names);
    return names;
}

std::string list_of_pieces(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "no piece" : text;
}

std::vector<double> foam_around(const Setup& setup) {
    const Vec3 low = setup.box.min - setup.block_box().min;
    const Vec3 high = setup.block_box().max - setup.box.max;
    return {low.x, high.x, low.y, high.y, high.z};
}

TouchFaces touch_faces(const Setup& setup) {
    std::array<double, block_faces> area{};
    for (const FlushCap& cap : setup.flush_caps) area[static_cast<std::size_t>(cap.face)] += cap.area_mm2;
    const auto largest = [&](const auto& is_meant) {
        std::optional<BlockFace> found;
        for (const BlockFace face : {BlockFace::minus_x, BlockFace::plus_x, BlockFace::minus_y, BlockFace::plus_y}) {
            const double mm2 = area[static_cast<std::size_t>(face)];
            if (mm2 > 0 && is_meant(face) && (!found || mm2 > area[static_cast<std::size_t>(*found)])) found = face;
        }
        return found;
    };
    TouchFaces touched;
    touched.first = largest([](BlockFace) { return true; });
    if (touched.first) touched.second = largest([&](BlockFace f) { return axis_of(f) != axis_of(*touched.first); });
    return touched;
}

bool is_sawn_down(const Setup& setup) {
    return setup.block.is_sawn && (!setup.block.offcuts.empty() || !setup.flush_caps.empty());
}

bool is_only_sawn(const Setup& setup, const TriangleMesh& mesh) {
    if (setup.flush_caps.empty() || !setup.block.holds) return false;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::int32_t cut = cap_of(mesh, t);
        if (cut == no_cap || !setup.is_unmilled(cut)) return false;
    }
    return true;
}

}  // namespace qchopper
