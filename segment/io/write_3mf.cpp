// The model is written block by block into the ZIP, which reads it twice. O(points + triangles); memory for
// one block and the packed file.

#include "segment/io/write_3mf.h"

#include <algorithm>
#include <charconv>
#include <memory>

#include "base/files/zip.h"

namespace qchopper {
namespace {

constexpr const char* content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
)";

constexpr const char* relationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
)";

// XML 1.0 allows no control characters, not even as references: they become spaces.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else if (c == '>') {
            out += "&gt;";
        } else if (c == '"') {
            out += "&quot;";
        } else {
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return out;
}

template <class Number>
void put(std::string& out, Number value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    out.append(digits, end);
}

// Doubles with the shortest digits that give the same double again; + 0 turns a negative zero into a positive one.
template <class Number>
void put_attribute(std::string& out, const char* name, Number value) {
    out += name;
    put(out, value + Number{0});
    out += '"';
}

void put_points(std::string& out, const TriangleMesh& mesh, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
        const Vec3 p = mesh.points[i];
        out += "<vertex";
        put_attribute(out, " x=\"", p.x);
        put_attribute(out, " y=\"", p.y);
        put_attribute(out, " z=\"", p.z);
        out += "/>\n";
    }
}

void put_triangles(std::string& out, const TriangleMesh& mesh, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
        const Triangle& t = mesh.triangles[i];
        out += "<triangle";
        put_attribute(out, " v1=\"", t[0]);
        put_attribute(out, " v2=\"", t[1]);
        put_attribute(out, " v3=\"", t[2]);
        out += "/>\n";
    }
}

// 3MF multiplies row vectors by the matrix: it is the transpose, with the shift in the last row.
void put_item(std::string& out, std::size_t id, const Pose& pose) {
    out += "<item objectid=\"";
    put(out, id);
    out += '"';
    if (pose != Pose{}) {
        out += " transform=\"";
        for (int column = 0; column < 3; ++column) {
            for (const Vec3& row : pose.row) {
                put(out, row[column] + 0.0);
                out += ' ';
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            put(out, pose.shift[axis] + 0.0);
            out += axis < 2 ? " " : "\"";
        }
    }
    out += "/>\n";
}

// The model as text, block by block: head, then points and triangles of one object after the other, then the end.
class Model {
 public:
    Model(std::span<const Solid3mf> solids, const Metadata3mf& metadata) : solids_(solids), metadata_(metadata) {}

    void next(std::string& out) {
        if (!has_begun_) {
            put_head(out);
        } else if (solid_ < solids_.size()) {
            put_block(out, *solids_[solid_].mesh);
        } else if (!has_ended_) {
            put_end(out);
        }
    }

 private:
    static constexpr std::size_t block = 4096;  // points or triangles

    void put_head(std::string& out) {
        has_begun_ = true;
        out +=
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
            "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n";
        for (const auto& [name, value] : metadata_) {
            out += "<metadata name=\"" + escaped(name) + "\">" + escaped(value) + "</metadata>\n";
        }
        out += "<resources>\n";
    }

    // In a mesh, `at_` counts the points and then the triangles.
    void put_block(std::string& out, const TriangleMesh& mesh) {
        const std::size_t points = mesh.points.size();
        const std::size_t all = points + mesh.triangles.size();
        if (at_ == 0) {
            out += "<object id=\"" + std::to_string(solid_ + 1) + "\" type=\"model\" name=\"" +
                   escaped(solids_[solid_].name) + "\"><mesh>\n<vertices>\n";
        }
        if (at_ < points) {
            const std::size_t to = std::min(points, at_ + block);
            put_points(out, mesh, at_, to);
            at_ = to;
            if (at_ == points) out += "</vertices>\n<triangles>\n";
        } else {
            const std::size_t to = std::min(all, at_ + block);
            put_triangles(out, mesh, at_ - points, to - points);
            at_ = to;
        }
        if (at_ == all) {
            out += "</triangles>\n</mesh></object>\n";
            at_ = 0;
            ++solid_;
        }
    }

    void put_end(std::string& out) {
        has_ended_ = true;
        out += "</resources>\n<build>\n";
        for (std::size_t i = 0; i < solids_.size(); ++i) put_item(out, i + 1, solids_[i].pose);
        out += "</build>\n</model>\n";
    }

    std::span<const Solid3mf> solids_;
    const Metadata3mf& metadata_;
    bool has_begun_ = false;
    bool has_ended_ = false;
    std::size_t solid_ = 0;
    std::size_t at_ = 0;
};

Bytes bytes_of(const char* text) {
    const std::string whole = text;
    return {whole.begin(), whole.end()};
}

}  // namespace

Bytes to_3mf(std::span<const Solid3mf> solids, const Metadata3mf& metadata) {
    const auto open = [&]() -> NextStretch {
        // shared: a std::function must be copyable
        const auto model = std::make_shared<Model>(solids, metadata);
        return [model](std::string& out) { model->next(out); };
    };
    const Bytes types = bytes_of(content_types);
    const Bytes rels = bytes_of(relationships);
    return zip({zip_entry("[Content_Types].xml", types), zip_entry("_rels/.rels", rels),
                ZipEntry{"3D/3dmodel.model", open, true}});
}

}  // namespace qchopper
