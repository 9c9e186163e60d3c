// tinygltf loads the buffers; nodes are visited depth first, and each primitive is added through its placement.
// O(bytes + placed points and triangles).

#include "segment/io/formats/read_gltf.h"

#include <tiny_gltf.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/error.h"
#include "segment/io/formats/gltf_json.h"
#include "segment/io/formats/gltf_numbers.h"
#include "segment/io/formats/placement.h"
#include "segment/io/formats/text.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double mm_per_metre = 1000;
constexpr Placement z_up{{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {}};
constexpr int max_depth = 1000;  // of nodes in nodes

// The buffer files that tinygltf reads through callbacks. Its error texts hold no reason, so the first fault is kept
// and thrown later.
struct BufferFiles {
    fs::path folder;
    std::string name;
    std::vector<Sha256> read = {};
    std::optional<InputError> fault = {};

    bool load(std::vector<unsigned char>& bytes, const std::string& uri) {
        try {
            const fs::path path(uri);
            bool is_outside = folder.empty() || path.is_absolute() || uri.find(':') != std::string::npos;
            for (const fs::path& step : path) is_outside |= step == "..";
            if (is_outside) {
                const std::string why =
                    folder.empty() ? ", but no folder to search was given" : ", which is not beside it";
                throw InputError(InputFault::mesh, name + " has a buffer in the file " + uri.substr(0, 100) + why,
                                 "export the scan as GLB, which is one file");
            }
            bytes = read_file(folder / uri);
            read.push_back(sha256(bytes));
            return true;
        } catch (const InputError& error) {
            if (!fault) fault = error;
            return false;
        }
    }
};

bool assume_exists(const std::string&, void*) {
    return true;  // read_buffer reports why a file cannot be read
}
std::string unchanged_path(const std::string& path, void*) {
    return path;
}
bool read_buffer(std::vector<unsigned char>* bytes, std::string*, const std::string& uri, void* files) {
    return static_cast<BufferFiles*>(files)->load(*bytes, uri);
}
bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

tinygltf::Model load(const Bytes& bytes, const JsonChunk& chunk, std::string json, BufferFiles& files) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({assume_exists, unchanged_path, read_buffer, write_nothing, &files});
    tinygltf::Model model;
    std::string fault;  // texts of the library, not meant for the operator
    std::string remark;
    bool is_loaded = false;
    if (json.size() + bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw InputError(InputFault::mesh, files.name + " has more than 4 GiB", "export the scan as PLY");
    }
    try {
        if (chunk.is_glb) {
            const Bytes plain = with_json(bytes, chunk, std::move(json));
            is_loaded =
                loader.LoadBinaryFromMemory(&model, &fault, &remark, plain.data(), static_cast<unsigned>(plain.size()));
        } else {
            is_loaded = loader.LoadASCIIFromString(&model, &fault, &remark, json.data(),
                                                   static_cast<unsigned>(json.size()), "");
        }
    } catch (const std::exception&) {
        is_loaded = false;
    }
    if (files.fault) throw *files.fault;
    if (!is_loaded) {
        throw InputError(InputFault::mesh,
                         files.name + " is not a valid glTF file: its buffers, views and accessors do not fit together",
                         "export the scan again");
    }
    return model;
}

class SceneReader {
 public:
    SceneReader(const tinygltf::Model& model, const std::string& name) : model_(model), name_(name) {
        is_seen_.assign(model.nodes.size(), false);
    }

    RawMesh read() {
        for (const int node : roots()) read_node(node, z_up, 0);
        if (left_out_ > 0) {
            scan_.warnings.push_back(std::to_string(left_out_) +
                                     " sets of lines or points were left out: only faces are read.");
        }
        return std::move(scan_);
    }

 private:
    // The nodes of the default scene; without scenes, every node that has no parent.
    std::vector<int> roots() const {
        if (!model_.scenes.empty()) {
            const int scene = std::max(model_.defaultScene, 0);
            return item_at(model_.scenes, scene, "there is no scene " + std::to_string(scene)).nodes;
        }
        std::vector<bool> is_child(model_.nodes.size());
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children) {
                if (static_cast<std::size_t>(child) < is_child.size()) is_child[static_cast<std::size_t>(child)] = true;
            }
        }
        std::vector<int> found;
        for (std::size_t n = 0; n < is_child.size(); ++n) {
            if (!is_child[n]) found.push_back(static_cast<int>(n));
        }
        return found;
    }

    void read_node(int index, const Placement& outer, int depth) {
        const auto n = static_cast<std::size_t>(index);
        const std::string what = "node " + std::to_string(index);
        const tinygltf::Node& node = item_at(model_.nodes, index, "there is no " + what);
        if (is_seen_[n]) refuse(what + " occurs twice in the scene");
        if (depth > max_depth) refuse(what + " lies more than " + std::to_string(max_depth) + " nodes deep");
        is_seen_[n] = true;
        const Placement placement = outer * placement_of(node);
        if (node.mesh >= 0) {
            const tinygltf::Mesh& mesh = item_at(model_.meshes, node.mesh, what + " names a mesh that is not there");
            std::map<int, std::uint32_t> placed;  // first point of each accessor: primitives of a mesh may share one
            for (const tinygltf::Primitive& primitive : mesh.primitives) {
                read_primitive(primitive, placement, placed, "mesh " + std::to_string(node.mesh));
            }
        }
        for (const int child : node.children) read_node(child, placement, depth + 1);
    }

    static Placement placement_of(const tinygltf::Node& node) {
        Placement placement;
        if (const std::vector<double>& m = node.matrix; m.size() == 16) {  // column by column
            return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
        }
        if (const std::vector<double>& q = node.rotation; q.size() == 4) {  // x, y, z, w
            const double x = q[0], y = q[1], z = q[2], w = q[3];
            placement.axes = {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                               {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                               {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
        }
        if (node.scale.size() == 3) {
            for (std::size_t i = 0; i < 3; ++i) placement.axes[i] = node.scale[i] * placement.axes[i];
        }
        if (node.translation.size() == 3)
            placement.origin = {node.translation[0], node.translation[1], node.translation[2]};
        return placement;
    }

    void read_primitive(const tinygltf::Primitive& primitive, const Placement& placement,
                        std::map<int, std::uint32_t>& placed, const std::string& what) {
        const bool is_surface = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                                primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                                primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const auto position = primitive.attributes.find("POSITION");
        if (!is_surface || position == primitive.attributes.end()) {
            ++left_out_;
            return;
        }
        const tinygltf::Accessor& accessor = accessor_at(position->second, what);
        auto at = placed.find(position->second);
        if (at == placed.end()) {
            const std::uint32_t first = place_points(scan_, points_of(accessor, what), placement, name_ + ": " + what);
            at = placed.emplace(position->second, first).first;
        }
        add_triangles(primitive, at->second, accessor.count, is_mirroring(placement), what);
    }

    void add_triangles(const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t points, bool is_mirrored,
                       const std::string& what) {
        std::size_t count = points;
        std::optional<GltfNumbers> indices;
        if (primitive.indices >= 0) {
            const tinygltf::Accessor& accessor = accessor_at(primitive.indices, what);
            if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.sparse.isSparse) {
                refuse(what + " has corners that are no plain whole numbers");
            }
            count = accessor.count;
            indices = whole_numbers(accessor.bufferView, accessor.byteOffset, accessor.componentType, count, what);
        }
        const auto corner = [&](std::size_t i) {
            const std::uint32_t index = indices ? indices->whole(i) : static_cast<std::uint32_t>(i);
            if (index >= points) {
                refuse(what + ": corner " + std::to_string(i) + " names point " + std::to_string(index) +
                       ", but there are " + std::to_string(points));
            }
            return first + index;
        };
        const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
        if (is_list && count % 3 != 0)
            refuse(what + " has " + std::to_string(count) + " corners, which is no multiple of 3");
        const std::size_t triangles = is_list ? count / 3 : count < 3 ? 0 : count - 2;
        if (triangles > max_placed - scan_.mesh.triangles.size()) {
            refuse("with all its repetitions the scene has more than 50 million triangles");
        }
        for (std::size_t t = 0; t < triangles; ++t) {
            Triangle made;
            if (is_list) {
                made = {corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)};
            } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                made = {corner(0), corner(t + 1), corner(t + 2)};
            } else {
                made = {corner(t), corner(t + 1 + t % 2), corner(t + 2 - t % 2)};
                // triangles with a repeated corner only connect two parts of a strip
                if (made[0] == made[1] || made[1] == made[2] || made[2] == made[0]) continue;
            }
            if (is_mirrored) std::swap(made[1], made[2]);
            scan_.mesh.triangles.push_back(made);
            ++scan_.faces_in_file;
        }
    }

    std::vector<Vec3> points_of(const tinygltf::Accessor& accessor, const std::string& what) const {
        const std::optional<GltfComponent> component = gltf_component(accessor.componentType);
        if (accessor.type != TINYGLTF_TYPE_VEC3 || !component || *component == GltfComponent::u32) {
            refuse(what + " has points of another type than three numbers");
        }
        if (accessor.bufferView < 0 && !accessor.sparse.isSparse) refuse(what + " has points without numbers");
        if (accessor.count > max_placed) refuse(what + " has more than 50 million points");
        const auto read = [&](const GltfNumbers& from, std::size_t i) {
            return Vec3{from.real(i, 0, accessor.normalized), from.real(i, 1, accessor.normalized),
                        from.real(i, 2, accessor.normalized)};
        };
        std::vector<Vec3> points;
        if (accessor.bufferView >= 0) {
            const GltfNumbers all =
                numbers(accessor.bufferView, accessor.byteOffset, *component, 3, accessor.count, what);
            points.reserve(accessor.count);
            for (std::size_t i = 0; i < accessor.count; ++i) points.push_back(read(all, i));
        } else {
            // all zero but for a few: the count is backed by no bytes of its own, so it is limited by those of the file
            if (accessor.count > all_bytes()) refuse(what + " has more points than bytes");
            points.resize(accessor.count);
        }
        if (!accessor.sparse.isSparse) return points;
        const auto& sparse = accessor.sparse;
        const auto at_least_0 = [](int value) { return static_cast<std::size_t>(std::max(value, 0)); };
        const std::size_t changed = at_least_0(sparse.count);
        const GltfNumbers which = whole_numbers(sparse.indices.bufferView, at_least_0(sparse.indices.byteOffset),
                                                sparse.indices.componentType, changed, what);
        const GltfNumbers values =
            numbers(sparse.values.bufferView, at_least_0(sparse.values.byteOffset), *component, 3, changed, what);
        for (std::size_t i = 0; i < changed; ++i) {
            if (which.whole(i) >= points.size()) refuse(what + " replaces a point that is not there");
            points[which.whole(i)] = read(values, i);
        }
        return points;
    }

    std::size_t all_bytes() const {
        std::size_t sum = 0;
        for (const tinygltf::Buffer& buffer : model_.buffers) sum += buffer.data.size();
        return sum;
    }

    const tinygltf::Accessor& accessor_at(int index, const std::string& what) const {
        return item_at(model_.accessors, index,
                       what + " names accessor " + std::to_string(index) + ", which is not there");
    }

    template <class Item>
    const Item& item_at(const std::vector<Item>& items, int index, const std::string& fault) const {
        if (index < 0 || static_cast<std::size_t>(index) >= items.size()) refuse(fault);
        return items[static_cast<std::size_t>(index)];
    }

    GltfNumbers numbers(int view_index, std::size_t offset, GltfComponent component, std::size_t components,
                        std::size_t count, const std::string& what) const {
        const tinygltf::BufferView& view =
            item_at(model_.bufferViews, view_index, what + " has numbers in no buffer view");
        const tinygltf::Buffer& buffer = item_at(model_.buffers, view.buffer, what + " has numbers in no buffer");
        const std::optional<GltfNumbers> found = numbers_in(
            {buffer.data, view.byteOffset, view.byteLength, view.byteStride}, offset, component, components, count);
        if (!found) refuse(what + " has more numbers than its buffer");
        return *found;
    }

    // Indices of points.
    GltfNumbers whole_numbers(int view_index, std::size_t offset, int code, std::size_t count,
                              const std::string& what) const {
        const std::optional<GltfComponent> component = gltf_component(code);
        const bool is_index = component && (*component == GltfComponent::u8 || *component == GltfComponent::u16 ||
                                            *component == GltfComponent::u32);
        if (!is_index) refuse(what + " has corners that are no plain whole numbers");
        return numbers(view_index, offset, *component, 1, count, what);
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + " is not a valid glTF file: " + why, "export the scan again");
    }

    const tinygltf::Model& model_;
    const std::string& name_;
    std::vector<bool> is_seen_;  // per node
    std::size_t left_out_ = 0;
    RawMesh scan_;
};

}  // namespace

bool is_gltf(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
        if (byte != ' ' && byte != '\t' && byte != '\n' && byte != '\r') return byte == '{';
    }
    return false;
}

RawMesh parse_gltf(const Bytes& bytes, const std::string& name, const fs::path& folder) {
    const JsonChunk chunk = find_json(bytes, name);
    const std::string_view json = as_text(bytes).substr(chunk.begin, chunk.end - chunk.begin);
    PlainGltf plain = plain_gltf(json, chunk.is_glb, name);
    BufferFiles files{folder, name};
    const tinygltf::Model model = load(bytes, chunk, std::move(plain.json), files);
    RawMesh scan = SceneReader(model, name).read();
    scan.format = chunk.is_glb ? MeshFormat::glb : MeshFormat::gltf;
    scan.mm_per_unit = mm_per_metre;
    scan.warnings.insert(scan.warnings.begin(), plain.warnings.begin(), plain.warnings.end());
    scan.beside = std::move(files.read);
    return scan;
}

}  // namespace qchopper
