// Builds the scene as a tinygltf model, which writes it. Of coloured scenes too, so that the library is seen by one
// source; lines are pairs of indices there, so that one primitive holds all of a group. O(points + triangles +
// colours); memory for some copies of the file.

#include "segment/io/write_glb.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "segment/io/write_coloured_glb.h"

namespace qchopper {
namespace {

// Appends numbers to the buffer, and an accessor to them by a view of their own, of which it returns the index. The
// target of the view is 0 for numbers that are no part of a mesh.
template <class Number>
int add_accessor(tinygltf::Model& model, const std::vector<Number>& numbers, int target, int component, int type,
                 std::size_t count, tinygltf::Accessor accessor = {}) {
    std::vector<unsigned char>& data = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = numbers.size() * sizeof(Number);
    view.target = target;
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, numbers.data(),
                view.byteLength);  // glTF is little-endian, as the host must be
    model.bufferViews.push_back(view);
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

// Precondition: there is a point.
int add_positions(tinygltf::Model& model, const std::vector<Vec3>& points) {
    std::vector<float> numbers;
    numbers.reserve(3 * points.size());
    tinygltf::Accessor bounded;
    bounded.minValues.assign(3, std::numeric_limits<float>::max());
    bounded.maxValues.assign(3, std::numeric_limits<float>::lowest());
    for (const Vec3& p : points) {
        for (int axis = 0; axis < 3; ++axis) {
            numbers.push_back(static_cast<float>(p[axis]));
            const auto a = static_cast<std::size_t>(axis);
            bounded.minValues[a] = std::min<double>(bounded.minValues[a], numbers.back());
            bounded.maxValues[a] = std::max<double>(bounded.maxValues[a], numbers.back());
        }
    }
    return add_accessor(model, numbers, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                        points.size(), bounded);
}

// Adds the triangles that are caps, or those that are not.
void add_primitive(tinygltf::Model& model, tinygltf::Mesh& to, const TriangleMesh& mesh, bool caps, int positions,
                   int material) {
    std::vector<std::uint32_t> corners;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if ((cap_of(mesh, t) != no_cap) != caps) continue;
        corners.insert(corners.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    }
    if (corners.empty()) return;
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = positions;
    primitive.indices = add_accessor(model, corners, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, corners.size());
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    to.primitives.push_back(primitive);
}

// Returns the index of the material; equal materials are added once.
int add_material(tinygltf::Model& model, const std::string& name, std::array<double, 3> colour) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {colour[0], colour[1], colour[2], 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    const auto same = std::find(model.materials.begin(), model.materials.end(), material);
    if (same != model.materials.end()) return static_cast<int>(same - model.materials.begin());
    model.materials.push_back(material);
    return static_cast<int>(model.materials.size()) - 1;
}

tinygltf::Value extras(const std::vector<GlbNote>& notes) {
    using tinygltf::Value;
    Value::Object inner;
    for (const auto& [name, value] : notes) {
        inner[name] = std::visit([](const auto& v) { return Value(v); }, value);
    }
    return Value(Value::Object{{"qchopper", Value(inner)}});
}

void add_node(tinygltf::Model& model, const GlbNode& from) {
    tinygltf::Mesh mesh;
    mesh.name = from.name;
    const int surface = add_material(model, "surface", from.surface);
    const int cap = add_material(model, "cap", from.cap);
    const int positions = add_positions(model, from.mesh->points);
    add_primitive(model, mesh, *from.mesh, false, positions, surface);
    add_primitive(model, mesh, *from.mesh, true, positions, cap);
    tinygltf::Node node;
    node.name = from.name;
    node.mesh = static_cast<int>(model.meshes.size());
    if (from.origin != Vec3{}) node.translation = {from.origin.x, from.origin.y, from.origin.z};
    if (!from.notes.empty()) node.extras = extras(from.notes);
    model.nodes[0].children.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
    model.meshes.push_back(mesh);
}

void add_keys(tinygltf::Model& model, tinygltf::Animation& animation, const GlbNode& node, int number) {
    std::vector<float> times;
    std::vector<float> places;
    for (const GlbKey& key : node.keys) {
        times.push_back(static_cast<float>(key.time_s));
        const Vec3 place = node.origin + key.shift;
        for (int axis = 0; axis < 3; ++axis) places.push_back(static_cast<float>(place[axis]));
    }
    tinygltf::AnimationSampler sampler;
    tinygltf::Accessor bounded;
    bounded.minValues = {times.front()};
    bounded.maxValues = {times.back()};
    sampler.input =
        add_accessor(model, times, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, times.size(), bounded);
    sampler.output = add_accessor(model, places, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, times.size());
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = number;
    channel.target_path = "translation";
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
}

void add_animation(tinygltf::Model& model, const GlbScene& scene) {
    tinygltf::Animation animation;
    animation.name = scene.animation;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        // node 0 is the root
        if (!scene.nodes[i].keys.empty()) add_keys(model, animation, scene.nodes[i], static_cast<int>(i) + 1);
    }
    if (!animation.channels.empty()) model.animations.push_back(animation);
}

void add_root(tinygltf::Model& model, const std::string& name) {
    tinygltf::Node root;
    root.name = name;
    constexpr double half_root_2 = 0.70710678118654752;
    root.rotation = {-half_root_2, 0, 0, half_root_2};  // -90 degrees about X: Z up becomes Y up
    root.scale = {0.001, 0.001, 0.001};
    model.nodes = {root};
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes = {scene};
    model.defaultScene = 0;
}

void check_size(const GlbScene& scene) {
    double bytes = 0;
    for (const GlbNode& node : scene.nodes) {
        bytes += 12.0 * static_cast<double>(node.mesh->points.size() + node.mesh->triangles.size());
    }
    constexpr double most = 4.2e9;  // the length of the file has 32 bits; the rest is left to the JSON
    if (bytes > most) {
        throw InputError(InputFault::use, "the pieces are too large for one GLB file, which ends at 4 GiB",
                         Sentence::with_key("export_one_by_one", {}, "export them one by one, or simplify them"));
    }
}

Bytes bytes_of(tinygltf::Model model) {
    std::ostringstream stream;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    model = {};
    const std::string_view text = stream.view();
    return {text.begin(), text.end()};
}

tinygltf::Primitive primitive_of(tinygltf::Model& model, int positions, const std::vector<std::uint32_t>& indices,
                                 int mode, const GlbColour& colour) {
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = positions;
    primitive.indices = add_accessor(model, indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size());
    primitive.mode = mode;
    primitive.material = add_material(model, colour.name, colour.colour);
    return primitive;
}

void add_plain_node(tinygltf::Model& model, const std::string& name, tinygltf::Mesh mesh) {
    mesh.name = name;
    tinygltf::Node node;
    node.name = name;
    node.mesh = static_cast<int>(model.meshes.size());
    model.nodes[0].children.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
    model.meshes.push_back(std::move(mesh));
}

void add_coloured_mesh(tinygltf::Model& model, const ColouredGlb& scene) {
    std::vector<std::vector<std::uint32_t>> corners(scene.colours.size());
    for (std::size_t t = 0; t < scene.mesh->triangles.size(); ++t) {
        const Triangle& triangle = scene.mesh->triangles[t];
        std::vector<std::uint32_t>& of_colour = corners[scene.colour_of[t]];
        of_colour.insert(of_colour.end(), triangle.begin(), triangle.end());
    }
    const int positions = add_positions(model, scene.mesh->points);
    tinygltf::Mesh mesh;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i].empty()) continue;
        mesh.primitives.push_back(
            primitive_of(model, positions, corners[i], TINYGLTF_MODE_TRIANGLES, scene.colours[i]));
    }
    add_plain_node(model, scene.node, std::move(mesh));
}

void add_lines(tinygltf::Model& model, const GlbLines& group) {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> ends;
    for (const std::vector<Vec3>& line : group.lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (i > 0) {
                const auto last = static_cast<std::uint32_t>(points.size());
                ends.insert(ends.end(), {last - 1, last});
            }
            points.push_back(line[i]);
        }
    }
    if (ends.empty()) return;
    const int positions = add_positions(model, points);
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive_of(model, positions, ends, TINYGLTF_MODE_LINE, group.colour));
    add_plain_node(model, group.node, std::move(mesh));
}

}  // namespace

Bytes to_glb(const GlbScene& scene) {
    check_size(scene);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = scene.generator;
    model.buffers.resize(1);
    add_root(model, scene.root);
    for (const GlbNode& node : scene.nodes) add_node(model, node);
    add_animation(model, scene);
    return bytes_of(std::move(model));
}

Bytes to_glb(const ColouredGlb& scene) {
    assert(scene.mesh != nullptr && !scene.mesh->triangles.empty());
    assert(scene.colour_of.size() == scene.mesh->triangles.size());
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = scene.generator;
    model.buffers.resize(1);
    add_root(model, "setup");
    add_coloured_mesh(model, scene);
    for (const GlbLines& group : scene.lines) add_lines(model, group);
    return bytes_of(std::move(model));
}

}  // namespace qchopper
