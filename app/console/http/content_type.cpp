// A table of endings. O(1).

#include "app/console/http/content_type.h"

#include <algorithm>

namespace qchopper {
namespace {

struct TypeOfEnding {
    std::string_view ending;
    std::string_view type;
};
// The last one is for all others.
constexpr TypeOfEnding types[] = {{".html", "text/html; charset=utf-8"},
                                  {".js", "text/javascript; charset=utf-8"},
                                  {".css", "text/css; charset=utf-8"},
                                  {".json", "application/json; charset=utf-8"},
                                  {".svg", "image/svg+xml"},
                                  {".png", "image/png"},
                                  {".pdf", "application/pdf"},
                                  {".glb", "model/gltf-binary"},
                                  {".stl", "model/stl"},
                                  {"", "text/plain; charset=utf-8"}};

}  // namespace

std::string_view content_type(std::string_view name) {
    return std::ranges::find_if(types, [&](const TypeOfEnding& row) { return name.ends_with(row.ending); })->type;
}

}  // namespace qchopper
