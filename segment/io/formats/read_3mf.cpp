// libzip unpacks each model file once. The build is walked depth first to list the placed objects, which are counted
// before any is added. O(bytes of the models + placed points and triangles).

#include "segment/io/formats/read_3mf.h"

#include <zip.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <set>

#include "base/error.h"
#include "segment/io/formats/model_3mf.h"
#include "segment/io/formats/unpack.h"

namespace qchopper {
namespace {

constexpr int max_depth = 100;               // of components in components
constexpr std::size_t max_visits = 100'000;  // of objects: empty ones add no points and need a limit too

std::string without_slash(const std::string& path) {
    return path.substr(path.starts_with('/') ? 1 : 0);
}

// The parts of a package.
class Package {
 public:
    Package(const Bytes& bytes, const std::string& name) : name_(name), most_(max_unpacked(bytes.size())) {
        zip_error_t error;
        zip_error_init(&error);
        zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
        if (source == nullptr) throw std::bad_alloc();
        archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
        const std::string why = archive_ ? "" : zip_error_strerror(&error);
        zip_error_fini(&error);
        if (archive_) return;
        zip_source_free(source);
        throw InputError(InputFault::mesh, name + " is a damaged ZIP: " + why, export_again);
    }

    bool has(const std::string& path) const { return find(path) >= 0; }

    // The name of the first part with this ending; empty if there is none.
    std::string first_that_ends_with(const std::string& ending) const {
        for (zip_int64_t i = 0; i < zip_get_num_entries(archive_.get(), 0); ++i) {
            const char* part = zip_get_name(archive_.get(), static_cast<zip_uint64_t>(i), 0);
            if (part != nullptr && std::string(part).ends_with(ending)) return part;
        }
        return {};
    }

    // Calls `use` with a function that reads the part in blocks, and returns its result.
    template <class Use>
    auto read(const std::string& path, const Use& use) {
        const std::unique_ptr<zip_file_t, Close> file(
            zip_fopen_index(archive_.get(), static_cast<zip_uint64_t>(find(path)), 0));
        if (!file) refuse(path, zip_strerror(archive_.get()));
        return use([&](char* to, std::size_t size) {
            const zip_int64_t got = zip_fread(file.get(), to, size);
            if (got < 0) refuse(path, zip_file_strerror(file.get()));
            unpacked_ += static_cast<std::uint64_t>(got);
            if (unpacked_ > most_) refuse(path, "it unpacks to more than " + std::to_string(most_ >> 20) + " MiB");
            return static_cast<std::size_t>(got);
        });
    }

 private:
    struct Discard {
        void operator()(zip_t* archive) const { zip_discard(archive); }
    };
    struct Close {
        void operator()(zip_file_t* file) const { zip_fclose(file); }
    };

    // The names of parts do not depend on case.
    zip_int64_t find(const std::string& path) const {
        return zip_name_locate(archive_.get(), without_slash(path).c_str(), ZIP_FL_NOCASE);
    }

    [[noreturn]] void refuse(const std::string& path, const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + ": " + path.substr(0, 100) + " cannot be read: " + why,
                         export_again);
    }

    const std::string& name_;
    std::uint64_t most_;
    std::uint64_t unpacked_ = 0;  // of all parts so far
    std::unique_ptr<zip_t, Discard> archive_;
};

class Builder {
 public:
    Builder(Package& package, const std::string& name) : package_(package), name_(name) {}

    RawMesh build() {
        scan_.format = MeshFormat::three_mf;
        const std::string start = start_part();
        const Model3mf& model = model_at(start);
        scan_.mm_per_unit = model.mm_per_unit;
        for (const Reference3mf& item : model.items) visit(item, start, {}, 0);
        check_count();
        for (const Placed& placed : placed_) add(*placed.object, placed.placement);
        if (not_built_ > 0) {
            scan_.warnings.push_back(std::to_string(not_built_) +
                                     " supports and other objects that are not to be made were left out.");
        }
        if (beams_ > 0) {
            scan_.warnings.push_back("Beam lattices of " + std::to_string(beams_) + " objects were left out.");
        }
        if (model.items.empty() && !model.objects.empty()) {
            refuse(" holds objects, but its build is empty: nothing is to be made",
                   "put the object on the plate and export again");
        }
        return std::move(scan_);
    }

 private:
    std::string start_part() {
        std::string start;
        if (package_.has("_rels/.rels")) {
            start = package_.read("_rels/.rels",
                                  [&](const ReadSome& some) { return start_part_3mf(some, name_ + ": _rels/.rels"); });
        }
        if (start.empty() || !package_.has(start)) start = package_.first_that_ends_with(".model");
        if (start.empty()) {
            refuse(" is a ZIP, but no 3MF: it holds no model", "unpack it and give the scan that is in it");
        }
        return without_slash(start);
    }

    const Model3mf& model_at(const std::string& path) {
        const auto known = models_.find(path);
        if (known != models_.end()) return known->second;
        if (!package_.has(path)) refuse(" names " + path.substr(0, 100) + ", which is not in it");
        const std::string name = models_.empty() ? name_ : name_ + ": " + path;
        Model3mf model = package_.read(path, [&](const ReadSome& some) { return read_model_3mf(some, name); });
        if (!models_.empty() && model.mm_per_unit != *scan_.mm_per_unit) {
            throw InputError(InputFault::mesh, name + " has another unit than the model that names it", export_again);
        }
        return models_.emplace(path, std::move(model)).first->second;
    }

    void visit(const Reference3mf& reference, const std::string& from, const Placement& outer, int depth) {
        if (depth > max_depth || ++visits_ > max_visits) {
            refuse(": its components contain each other without end", "export the parts as plain objects");
        }
        const std::string path = reference.path.empty() ? from : without_slash(reference.path);
        const Object3mf& object = object_at(path, reference.object);
        if (object.type != "model" && object.type != "surface") {
            ++not_built_;
            return;
        }
        beams_ += object.has_beams;
        const Placement placement = outer * reference.placement;
        if (!object.triangles.empty()) placed_.push_back({&object, placement});
        for (const Reference3mf& component : object.components) visit(component, path, placement, depth + 1);
    }

    const Object3mf& object_at(const std::string& path, std::uint32_t id) {
        const std::vector<Object3mf>& objects = model_at(path).objects;
        const auto found =
            std::lower_bound(objects.begin(), objects.end(), id,
                             [](const Object3mf& object, std::uint32_t wanted) { return object.id < wanted; });
        if (found == objects.end() || found->id != id) {
            refuse(" names object " + std::to_string(id) + ", which is not in it");
        }
        return *found;
    }

    // Before memory is taken for the first of them.
    void check_count() {
        std::uint64_t points = 0;
        std::uint64_t triangles = 0;
        for (const Placed& placed : placed_) {
            points += placed.object->points.size();
            triangles += placed.object->triangles.size();
        }
        if (points > max_placed || triangles > max_placed) {
            refuse(": with all its repetitions there are more than 50 million points or triangles",
                   "export only what is to be carved");
        }
        scan_.mesh.points.reserve(points);
        scan_.mesh.triangles.reserve(triangles);
    }

    void add(const Object3mf& object, const Placement& placement) {
        const std::uint32_t first =
            place_points(scan_, object.points, placement, name_ + ": object " + std::to_string(object.id));
        const bool is_mirrored = is_mirroring(placement);
        for (Triangle t : object.triangles) {
            if (is_mirrored) std::swap(t[1], t[2]);
            scan_.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
        scan_.faces_in_file += object.triangles.size();
    }

    [[noreturn]] void refuse(const std::string& why, const char* to_do = export_again) const {
        throw InputError(InputFault::mesh, name_ + why, to_do);
    }

    struct Placed {
        const Object3mf* object;  // in models_, whose entries do not move
        Placement placement;
    };

    Package& package_;
    const std::string& name_;
    RawMesh scan_;
    std::map<std::string, Model3mf> models_;
    std::vector<Placed> placed_;
    std::size_t visits_ = 0;
    std::size_t not_built_ = 0;
    std::size_t beams_ = 0;
};

}  // namespace

bool is_3mf(const Bytes& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'P' && bytes[1] == 'K' && (bytes[2] == 3 || bytes[2] == 5) &&
           bytes[3] == bytes[2] + 1;
}

RawMesh parse_3mf(const Bytes& bytes, const std::string& name) {
    Package package(bytes, name);
    return Builder(package, name).build();
}

}  // namespace qchopper
