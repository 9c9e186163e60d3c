// The header and the first chunk of a GLB are those of the glTF 2.0 specification (Khronos Group, 2021). The members
// that describe triangles are copied from the parsed JSON into a new one, and the type and the range of each is
// checked. O(bytes) in time; memory for both documents, and with_json copies the file once.

#include "segment/io/formats/gltf_json.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {
namespace {

std::uint32_t u32_at(const Bytes& bytes, std::size_t at) {
    return std::uint32_t{bytes[at]} | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
}

using Json = nlohmann::json;

// Extensions that change only the appearance of a surface, or that are read: a file may require them.
bool is_harmless(const std::string& extension) {
    for (const char* part : {"_materials_", "_texture_", "_lights_", "KHR_mesh_quantization", "KHR_xmp"}) {
        if (extension.find(part) != std::string::npos) return true;
    }
    return false;
}

class GltfFilter {
 public:
    GltfFilter(const Json& all, bool has_bin, const std::string& name) : all_(all), has_bin_(has_bin), name_(name) {}

    PlainGltf filtered() {
        if (!all_.is_object()) refuse("it is not a JSON object");
        check_extensions();
        Json plain;
        plain["asset"]["version"] = "2.0";
        check_version();
        list(plain, "buffers", &GltfFilter::buffer);
        list(plain, "bufferViews", &GltfFilter::view);
        list(plain, "accessors", &GltfFilter::accessor);
        list(plain, "meshes", &GltfFilter::mesh);
        list(plain, "nodes", &GltfFilter::node);
        list(plain, "scenes", &GltfFilter::scene);
        index(all_, plain, "scene");
        if (morphed_ > 0) {
            result_.warnings.push_back("Of " + std::to_string(morphed_) +
                                       " meshes with morph targets, only the base shape was read.");
        }
        if (instanced_ > 0) {
            result_.warnings.push_back("The copies that " + std::to_string(instanced_) +
                                       " nodes make by EXT_mesh_gpu_instancing were left out.");
        }
        result_.json = plain.dump();
        return std::move(result_);
    }

 private:
    void check_version() const {
        const auto asset = all_.find("asset");
        if (asset == all_.end() || !asset->is_object()) refuse("it has no \"asset\"");
        const auto version = asset->find("version");
        if (version == asset->end() || !version->is_string() ||
            !version->get_ref<const std::string&>().starts_with("2.")) {
            refuse("only version 2 is read");
        }
    }

    void check_extensions() const {
        const auto required = all_.find("extensionsRequired");
        if (required == all_.end() || !required->is_array()) return;
        for (const Json& extension : *required) {
            if (!extension.is_string()) refuse("\"extensionsRequired\" has an entry that is not a name");
            const auto& extension_name = extension.get_ref<const std::string&>();
            if (is_harmless(extension_name)) continue;
            throw InputError(
                InputFault::mesh,
                name_ + " needs " + extension_name.substr(0, 60) + ", an extension of glTF that is not read",
                "export it without compression and extensions");
        }
    }

    using Filter = Json (GltfFilter::*)(const Json&);
    void list(Json& plain, const char* key, Filter filter) {
        const auto found = all_.find(key);
        if (found == all_.end()) return;
        if (!found->is_array()) refuse("\"" + std::string(key) + "\" is not a list");
        Json& items = plain[key] = Json::array();
        for (const Json& item : *found) {
            at_ = std::string(key) + " " + std::to_string(items.size());
            items.push_back((this->*filter)(checked_object(item)));
        }
        if (items.empty()) plain.erase(key);
    }

    Json buffer(const Json& from) {
        Json to = Json::object();
        size(from, to, "byteLength");
        const auto uri = from.find("uri");
        if (uri == from.end()) {
            // only the first buffer of a GLB lies in the file itself
            if (!has_bin_ || at_ != "buffers 0") refuse(at_ + " has no \"uri\"");
            return to;
        }
        if (!uri->is_string()) refuse(at_ + ": \"uri\" is not a text");
        to["uri"] = *uri;
        return to;
    }

    Json view(const Json& from) {
        Json to = Json::object();
        index(from, to, "buffer");
        size(from, to, "byteOffset");
        size(from, to, "byteLength");
        const std::uint64_t stride = size(from, to, "byteStride");
        if (stride > 252) refuse(at_ + ": \"byteStride\" is more than 252");
        return to;
    }

    Json accessor(const Json& from) {
        Json to = Json::object();
        index(from, to, "bufferView");
        size(from, to, "byteOffset");
        index(from, to, "componentType");
        size(from, to, "count");
        const auto type = from.find("type");
        if (type == from.end() || !type->is_string()) refuse(at_ + " has no \"type\"");
        to["type"] = *type;
        const auto normalized = from.find("normalized");
        if (normalized != from.end() && normalized->is_boolean()) to["normalized"] = *normalized;
        if (const auto sparse = from.find("sparse"); sparse != from.end()) {
            const Json& whole = checked_object(*sparse);
            Json& few = to["sparse"];
            index(whole, few, "count");
            for (const char* side : {"indices", "values"}) {
                const auto found = whole.find(side);
                if (found == whole.end()) refuse(at_ + ": \"sparse\" has no \"" + side + "\"");
                index(checked_object(*found), few[side], "bufferView");
                index(*found, few[side], "byteOffset");
                if (side[0] == 'i') index(*found, few[side], "componentType");
            }
        }
        return to;
    }

    Json mesh(const Json& from) {
        Json to = Json::object();
        Json& primitives = to["primitives"] = Json::array();
        const auto found = from.find("primitives");
        if (found == from.end() || !found->is_array()) refuse(at_ + " has no list of \"primitives\"");
        bool is_morphed = false;
        for (const Json& item : *found) {
            const Json& primitive = checked_object(item);
            Json plain = Json::object();
            const auto attributes = primitive.find("attributes");
            if (attributes == primitive.end()) refuse(at_ + " has a primitive without \"attributes\"");
            plain["attributes"] = Json::object();
            index(checked_object(*attributes), plain["attributes"], "POSITION");
            index(primitive, plain, "indices");
            index(primitive, plain, "mode");
            is_morphed |= primitive.contains("targets");
            primitives.push_back(std::move(plain));
        }
        morphed_ += is_morphed;
        return to;
    }

    Json node(const Json& from) {
        Json to = Json::object();
        index(from, to, "mesh");
        indices(from, to, "children");
        numbers(from, to, "matrix", 16);
        numbers(from, to, "translation", 3);
        numbers(from, to, "rotation", 4);
        numbers(from, to, "scale", 3);
        if (const auto extensions = from.find("extensions"); extensions != from.end() && extensions->is_object()) {
            instanced_ += extensions->contains("EXT_mesh_gpu_instancing");
        }
        return to;
    }

    Json scene(const Json& from) {
        Json to = Json::object();
        indices(from, to, "nodes");
        return to;
    }

    const Json& checked_object(const Json& value) const {
        if (!value.is_object()) refuse(at_ + " is not an object");
        return value;
    }

    std::uint64_t whole(const Json& value, const char* key, std::uint64_t most) const {
        // some writers write 12.0 for 12; 9e15 is below 2^53, up to which every whole number is a double
        const double real = value.is_number_float() ? value.get<double>() : -1;
        const bool is_whole = value.is_number_unsigned() || (real >= 0 && real <= 9e15 && std::floor(real) == real);
        const std::uint64_t number = is_whole ? value.get<std::uint64_t>() : 0;
        if (!is_whole || number > most) refuse(at_ + ": \"" + key + "\" is no whole number in its range");
        return number;
    }

    // Sizes and counts of bytes.
    std::uint64_t size(const Json& from, Json& to, const char* key) {
        const auto found = from.find(key);
        if (found == from.end()) return 0;
        const std::uint64_t number = whole(*found, key, std::uint64_t{1} << 53);
        to[key] = number;
        return number;
    }

    // Indices of objects, and the codes of the format.
    void index(const Json& from, Json& to, const char* key) {
        const auto found = from.find(key);
        if (found == from.end()) return;
        to[key] = whole(*found, key, std::numeric_limits<std::int32_t>::max());
    }

    void indices(const Json& from, Json& to, const char* key) {
        const auto found = from.find(key);
        if (found == from.end()) return;
        if (!found->is_array()) refuse(at_ + ": \"" + key + "\" is not a list");
        Json& values = to[key] = Json::array();
        for (const Json& value : *found) {
            values.push_back(whole(value, key, std::numeric_limits<std::int32_t>::max()));
        }
        if (values.empty()) to.erase(key);
    }

    void numbers(const Json& from, Json& to, const char* key, std::size_t count) {
        const auto found = from.find(key);
        if (found == from.end()) return;
        if (!found->is_array() || found->size() != count) {
            refuse(at_ + ": \"" + key + "\" needs " + std::to_string(count) + " numbers");
        }
        for (const Json& value : *found) {
            if (!value.is_number()) refuse(at_ + ": \"" + key + "\" has an entry that is not a number");
        }
        to[key] = *found;
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + " is not a valid glTF file: " + why, "export the scan again");
    }

    const Json& all_;
    bool has_bin_;
    const std::string& name_;
    std::string at_ = "the file";  // what is being filtered: "nodes 7"
    std::size_t morphed_ = 0;
    std::size_t instanced_ = 0;
    PlainGltf result_;
};

}  // namespace

bool is_glb(const Bytes& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

JsonChunk find_json(const Bytes& bytes, const std::string& name) {
    if (!is_glb(bytes)) return {0, bytes.size(), bytes.size(), false};
    constexpr std::size_t header = 20;               // bytes, of the file and of its first chunk
    constexpr std::uint32_t json_type = 0x4e4f534a;  // "JSON"
    const auto refuse = [&](const std::string& why) {
        throw InputError(InputFault::mesh, name + " is not a valid GLB file: " + why, export_again);
    };
    if (bytes.size() < header) refuse("it ends within its header");
    if (u32_at(bytes, 4) != 2) refuse("only version 2 is read");
    const std::uint32_t length = u32_at(bytes, 8);
    if (length > bytes.size() || length < header) {
        refuse("it should have " + std::to_string(length) + " bytes, but has " + std::to_string(bytes.size()));
    }
    const std::size_t json_size = u32_at(bytes, 12);
    if (u32_at(bytes, 16) != json_type || json_size > length - header) refuse("its first chunk is not complete JSON");
    return {header, header + json_size, length, true};
}

Bytes with_json(const Bytes& bytes, const JsonChunk& old, std::string json) {
    while (json.size() % 4 != 0) json += ' ';
    Bytes made(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(old.begin));
    made.insert(made.end(), json.begin(), json.end());
    made.insert(made.end(), bytes.begin() + static_cast<std::ptrdiff_t>(old.end),
                bytes.begin() + static_cast<std::ptrdiff_t>(old.end_of_file));
    const auto put = [&](std::size_t at, std::size_t value) {
        for (std::size_t i = 0; i < 4; ++i) made[at + i] = static_cast<std::uint8_t>(value >> 8 * i);
    };
    put(8, made.size());
    put(12, json.size());
    return made;
}

PlainGltf plain_gltf(std::string_view json, bool has_bin, const std::string& name) {
    Json all;
    try {
        all = Json::parse(json);
    } catch (const Json::exception& fault) {
        const auto* position = dynamic_cast<const Json::parse_error*>(&fault);
        throw InputError(InputFault::mesh,
                         name + " is not a valid glTF file: its JSON is damaged" +
                             (position != nullptr ? " at byte " + std::to_string(position->byte) : ""),
                         export_again);
    }
    return GltfFilter(all, has_bin, name).filtered();
}

}  // namespace qchopper
