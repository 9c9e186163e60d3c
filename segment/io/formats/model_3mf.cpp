// expat reads the XML part by part and calls a handler per element; references to objects are resolved by read_3mf.cpp.
// O(bytes) in time; memory for the points and triangles only.

#include "segment/io/formats/model_3mf.h"

#include <expat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "segment/io/formats/add_face.h"
#include "segment/io/formats/text.h"

namespace qchopper {
namespace {

// Names of elements as expat reports them: "namespace|name".
constexpr std::string_view core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02|";
// Version 0.93 of the format: the same in all that is read here.
constexpr std::string_view core_before = "http://schemas.microsoft.com/3dmanufacturing/2013/01|";
constexpr std::string_view path_attribute = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";
constexpr std::string_view lattice_start = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/";
constexpr std::string_view start_relation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

// Extensions without which the triangles are still right.
constexpr std::array<std::string_view, 4> harmless{"http://schemas.microsoft.com/3dmanufacturing/production/",
                                                   "http://schemas.microsoft.com/3dmanufacturing/material/",
                                                   "http://schemas.microsoft.com/3dmanufacturing/slice/",
                                                   "http://schemas.microsoft.com/3dmanufacturing/trianglesets/"};

struct Unit3mf {
    std::string_view name;
    double mm;
};
constexpr std::array<Unit3mf, 6> units{
    {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10}, {"inch", 25.4}, {"foot", 304.8}, {"meter", 1000}}};

using Attributes = const XML_Char**;

// Nothing if there is no such attribute.
std::optional<std::string_view> value_of(Attributes attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2) {
        if (name == attributes[0]) return attributes[1];
    }
    return {};
}

// Passes text to expat and its elements to `Handler`, whose functions may throw. expat is C: an exception must not
// cross it, so the first one is kept and thrown when expat has returned.
template <class Handler>
class Xml {
 public:
    explicit Xml(Handler& handler) : handler_(handler), parser_(XML_ParserCreateNS(nullptr, '|')) {
        if (parser_ == nullptr) throw std::bad_alloc();
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(
            parser_.get(),
            [](void* self, const XML_Char* element, Attributes attributes) {
                static_cast<Xml*>(self)->guarded([&](Handler& to) { to.start(element, attributes); });
            },
            [](void* self, const XML_Char* element) {
                static_cast<Xml*>(self)->guarded([&](Handler& to) { to.end(element); });
            });
        XML_SetStartNamespaceDeclHandler(parser_.get(), [](void* self, const XML_Char* prefix, const XML_Char* uri) {
            static_cast<Xml*>(self)->guarded(
                [&](Handler& to) { to.name_space(prefix != nullptr ? prefix : "", uri != nullptr ? uri : ""); });
        });
        // 3MF forbids it, and entities declared there can expand without bound
        XML_SetStartDoctypeDeclHandler(
            parser_.get(), [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
                static_cast<Xml*>(self)->guarded([&](Handler& to) { to.refuse("a document type, which 3MF forbids"); });
            });
        handler.line = [this] { return XML_GetCurrentLineNumber(parser_.get()); };
    }

    void read(const ReadSome& read_some) {
        constexpr int buffer_size = 1 << 16;
        while (true) {
            void* to = XML_GetBuffer(parser_.get(), buffer_size);
            if (to == nullptr) throw std::bad_alloc();
            const std::size_t got = read_some(static_cast<char*>(to), buffer_size);
            const XML_Status status = XML_ParseBuffer(parser_.get(), static_cast<int>(got), got == 0);
            if (fault_) std::rethrow_exception(fault_);
            if (status == XML_STATUS_ERROR) handler_.refuse(XML_ErrorString(XML_GetErrorCode(parser_.get())));
            if (got == 0) return;
        }
    }

 private:
    struct Free {
        void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
    };

    template <class Action>
    void guarded(const Action& action) {
        if (fault_) return;
        try {
            action(handler_);
        } catch (...) {
            fault_ = std::current_exception();
            XML_StopParser(parser_.get(), XML_FALSE);
        }
    }

    Handler& handler_;
    std::unique_ptr<std::remove_pointer_t<XML_Parser>, Free> parser_;
    std::exception_ptr fault_;
};

// The file, the current line, and errors that name both.
struct XmlHandler {
    const std::string& name;
    std::function<std::size_t()> line;

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name + ": line " + std::to_string(line()) + " of the 3MF model: " + why,
                         export_again);
    }
};

class ModelHandler : public XmlHandler {
 public:
    explicit ModelHandler(const std::string& file) : XmlHandler{file, {}} {}

    void name_space(const std::string& prefix, const std::string& uri) {
        if (depth_ == 0) uri_of_[prefix] = uri;
    }

    void start(std::string_view element, Attributes attributes) {
        const std::string_view name_in_core = in_core(element);
        if (depth_++ == 0) return start_model(name_in_core, attributes);
        if (name_in_core == "vertex") return add_point(attributes);
        if (name_in_core == "triangle") return add_triangle(attributes);
        if (name_in_core == "object") return start_object(attributes);
        if (name_in_core == "component") {
            if (object_ == nullptr) refuse("a component outside any object");
            object_->components.push_back(reference(attributes));
        } else if (name_in_core == "item") {
            model_.items.push_back(reference(attributes));
        } else if (object_ != nullptr && element.starts_with(lattice_start) && element.ends_with("|beam")) {
            object_->has_beams = true;
        }
    }

    void end(std::string_view element) {
        --depth_;
        if (in_core(element) != "object" || object_ == nullptr) return;
        check_corners();
        object_ = nullptr;
    }

    Model3mf model() {
        std::vector<Object3mf>& objects = model_.objects;
        std::stable_sort(objects.begin(), objects.end(),
                         [](const Object3mf& a, const Object3mf& b) { return a.id < b.id; });
        for (std::size_t i = 1; i < objects.size(); ++i) {
            if (objects[i].id == objects[i - 1].id) {
                throw InputError(InputFault::mesh, name + " has two objects " + std::to_string(objects[i].id),
                                 export_again);
            }
        }
        return std::move(model_);
    }

 private:
    // Empty for an element of another namespace.
    static std::string_view in_core(std::string_view element) {
        for (const std::string_view name_space : {core, core_before}) {
            if (element.starts_with(name_space)) return element.substr(name_space.size());
        }
        return {};
    }

    void start_model(std::string_view element, Attributes attributes) {
        if (element != "model") refuse("it is not a 3MF model");
        if (const auto unit = value_of(attributes, "unit")) {
            const auto known =
                std::find_if(units.begin(), units.end(), [&](const Unit3mf& u) { return u.name == *unit; });
            if (known == units.end()) refuse("unknown unit \"" + std::string(unit->substr(0, 40)) + "\"");
            model_.mm_per_unit = known->mm;
        }
        Text prefixes(value_of(attributes, "requiredextensions").value_or(""));
        for (std::string_view prefix = prefixes.word(); !prefix.empty(); prefix = prefixes.word()) {
            const std::string uri = uri_of_[std::string(prefix)];
            const bool is_harmless = std::any_of(harmless.begin(), harmless.end(),
                                                 [&](std::string_view start) { return uri.starts_with(start); });
            if (is_harmless) continue;
            throw InputError(InputFault::mesh,
                             name + " needs " + (uri.empty() ? std::string(prefix) : uri).substr(0, 100) +
                                 ", an extension of 3MF that is not read",
                             "export it as plain triangles");
        }
    }

    void start_object(Attributes attributes) {
        if (object_ != nullptr) refuse("an object in an object");
        model_.objects.emplace_back();
        object_ = &model_.objects.back();
        object_->id = whole(attributes, "id");
        if (const auto type = value_of(attributes, "type")) object_->type = type->substr(0, 40);
    }

    void add_point(Attributes attributes) {
        if (object_ == nullptr) refuse("a vertex outside any object");
        if (object_->points.size() == max_placed) refuse("more than 50 million points");
        object_->points.push_back({real(attributes, "x"), real(attributes, "y"), real(attributes, "z")});
    }

    void add_triangle(Attributes attributes) {
        if (object_ == nullptr) refuse("a triangle outside any object");
        if (object_->triangles.size() == max_placed) refuse("more than 50 million triangles");
        object_->triangles.push_back({whole(attributes, "v1"), whole(attributes, "v2"), whole(attributes, "v3")});
    }

    void check_corners() const {
        for (std::size_t t = 0; t < object_->triangles.size(); ++t) {
            for (const std::uint32_t corner : object_->triangles[t]) {
                if (corner < object_->points.size()) continue;
                refuse("triangle " + std::to_string(t) + " of object " + std::to_string(object_->id) +
                       " names vertex " + std::to_string(corner) + ", but there are " +
                       std::to_string(object_->points.size()));
            }
        }
    }

    Reference3mf reference(Attributes attributes) const {
        Reference3mf made;
        made.object = whole(attributes, "objectid");
        made.path = value_of(attributes, path_attribute).value_or("");
        const auto transform = value_of(attributes, "transform");
        if (!transform) return made;
        std::array<double, 12> m{};
        Text words(*transform);
        for (double& value : m) {
            const std::optional<double> read = number(words.word());
            if (!read || !std::isfinite(*read)) refuse("a transform needs twelve numbers");
            value = *read;
        }
        if (!words.word().empty()) refuse("a transform needs twelve numbers");
        made.placement = {{{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}}, {m[9], m[10], m[11]}};
        return made;
    }

    double real(Attributes attributes, const char* attribute) const {
        const std::string_view word = value_of(attributes, attribute).value_or("");
        const std::optional<double> value = number(Text(word).word());
        if (!value || !std::isfinite(*value)) refuse(fault_of(attribute, word));
        return *value;
    }

    std::uint32_t whole(Attributes attributes, const char* attribute) const {
        const std::string_view word = value_of(attributes, attribute).value_or("");
        const std::optional<std::int64_t> value = integer(Text(word).word());
        if (!value || *value < 0 || *value > static_cast<std::int64_t>(max_points)) refuse(fault_of(attribute, word));
        return static_cast<std::uint32_t>(*value);
    }

    static std::string fault_of(const char* attribute, std::string_view word) {
        return std::string(attribute) + " should be a number, but is \"" + std::string(word.substr(0, 40)) + "\"";
    }

    Model3mf model_;
    Object3mf* object_ = nullptr;  // whose element is open
    std::size_t depth_ = 0;
    std::map<std::string, std::string> uri_of_;  // per prefix
};

class RelationsHandler : public XmlHandler {
 public:
    explicit RelationsHandler(const std::string& file) : XmlHandler{file, {}} {}
    void name_space(const std::string&, const std::string&) {}
    void end(std::string_view) {}
    void start(std::string_view element, Attributes attributes) {
        if (!element.ends_with("|Relationship") || !target.empty()) return;
        if (value_of(attributes, "Type") == start_relation) target = value_of(attributes, "Target").value_or("");
    }
    std::string target;
};

}  // namespace

Model3mf read_model_3mf(const ReadSome& read_some, const std::string& name) {
    ModelHandler handler(name);
    Xml<ModelHandler>(handler).read(read_some);
    return handler.model();
}

std::string start_part_3mf(const ReadSome& read_some, const std::string& name) {
    RelationsHandler handler(name);
    Xml<RelationsHandler>(handler).read(read_some);
    return handler.target;
}

}  // namespace qchopper
