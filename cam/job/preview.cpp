#include "cam/job/preview.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <sstream>
#include <vector>

namespace qchopper {
namespace {

template <class Number>
int add_view(tinygltf::Model& model, const std::vector<Number>& numbers, int target) {
    std::vector<unsigned char>& data = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = numbers.size() * sizeof(Number);
    view.target = target;
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, numbers.data(), view.byteLength);  // glTF is little-endian, as we are
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
}

int add_positions(tinygltf::Model& model, const TriangleMesh& mesh) {
    std::vector<float> numbers;
    numbers.reserve(3 * mesh.points.size());
    tinygltf::Accessor accessor;
    accessor.minValues.assign(3, std::numeric_limits<float>::max());
    accessor.maxValues.assign(3, std::numeric_limits<float>::lowest());
    for (const Vec3& p : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) {
            numbers.push_back(static_cast<float>(p[axis]));
            const auto a = static_cast<std::size_t>(axis);
            accessor.minValues[a] = std::min<double>(accessor.minValues[a], numbers.back());
            accessor.maxValues[a] = std::max<double>(accessor.maxValues[a], numbers.back());
        }
    }
    accessor.bufferView = add_view(model, numbers, TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = TINYGLTF_TYPE_VEC3;
    accessor.count = mesh.points.size();
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

// The triangles that are caps, or those that are not.
void add_primitive(tinygltf::Model& model, const TriangleMesh& mesh, bool caps, int positions) {
    std::vector<std::uint32_t> corners;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if ((cap_of(mesh, t) != no_cap) != caps) continue;
        corners.insert(corners.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    }
    if (corners.empty()) return;
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(model, corners, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = corners.size();
    model.accessors.push_back(accessor);
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = positions;
    primitive.indices = static_cast<int>(model.accessors.size()) - 1;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = caps ? 1 : 0;
    model.meshes[0].primitives.push_back(primitive);
}

tinygltf::Material matt(const std::string& name, std::array<double, 3> colour) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {colour[0], colour[1], colour[2], 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    return material;
}

tinygltf::Value extras(const PreviewNotes& notes) {
    using tinygltf::Value;
    Value::Object inner;
    inner["piece"] = Value(notes.piece);
    inner["piece_no"] = Value(notes.piece_no);
    inner["piece_count"] = Value(notes.piece_count);
    inner["unit"] = Value(std::string("mm"));
    inner["fits"] = Value(notes.fits);
    if (notes.base >= 0) inner["base"] = Value(notes.base);
    return Value(Value::Object{{"qchopper", Value(inner)}});
}

void add_nodes(tinygltf::Model& model, const PreviewNotes& notes) {
    tinygltf::Node root;
    root.name = "setup";
    constexpr double half_root_2 = 0.70710678118654752;
    root.rotation = {-half_root_2, 0, 0, half_root_2};  // -90 degrees about X: Z up becomes Y up
    root.scale = {0.001, 0.001, 0.001};
    root.children = {1};
    tinygltf::Node piece;
    piece.name = "piece/" + notes.piece;
    piece.mesh = 0;
    piece.extras = extras(notes);
    model.nodes = {root, piece};
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes = {scene};
    model.defaultScene = 0;
}

}  // namespace

Bytes preview_glb(const TriangleMesh& mesh, const PreviewNotes& notes) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "qchopper " + notes.program_version;
    model.buffers.resize(1);
    model.meshes.resize(1);
    model.meshes[0].name = "piece/" + notes.piece;
    model.materials = {matt("surface", {0.80, 0.72, 0.56}), matt("cap", {0.90, 0.85, 0.74})};
    const int positions = add_positions(model, mesh);
    add_primitive(model, mesh, false, positions);
    add_primitive(model, mesh, true, positions);
    add_nodes(model, notes);
    std::ostringstream stream;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    const std::string text = stream.str();
    return {text.begin(), text.end()};
}

}  // namespace qchopper
