// A table of names in the order of Origin; `source` and `sources` of one table of the file. O(keys).

#include "cam/cell/cell_tables.h"

#include <array>
#include <cstddef>

#include "base/toml_reader.h"

namespace qchopper {
namespace {

constexpr std::array<std::string_view, 5> names{"data sheet", "measured", "assumed", "unstated", "by default"};
constexpr std::size_t names_in_files = 3;

Origin read_origin(const TomlReader& reader, std::string_view key) {
    const std::string word = reader.text(key);
    const std::optional<Origin> origin = origin_of(word);
    if (!origin) reader.refuse(key, "unknown origin " + word, "use \"data sheet\", \"measured\" or \"assumed\"");
    return *origin;
}

}  // namespace

std::string_view to_word(Origin origin) {
    return names[static_cast<std::size_t>(origin)];
}

std::optional<Origin> origin_of(std::string_view word) {
    for (std::size_t i = 0; i < names_in_files; ++i) {
        if (names[i] == word) return static_cast<Origin>(i);
    }
    return std::nullopt;
}

void add_origins(const TomlReader& reader, const TableKeys& table, const std::string& name, Origins& origins) {
    const Origin of_table = reader.has("source") ? read_origin(reader, "source") : Origin::unstated;
    std::optional<TomlReader> sources;
    if (reader.has("sources")) sources = reader.table("sources", table.with_origin());
    for (const std::string_view key : table.with_origin()) {
        const bool has_own = sources && sources->has(key);
        if (has_own && !reader.has(key)) sources->refuse(key, "the table does not give this value");
        if (!reader.has(key)) continue;
        origins.push_back({name, std::string(key), has_own ? read_origin(*sources, key) : of_table});
    }
}

void add_defaults(const TomlReader& reader, Keys keys, const std::string& name, Origins& origins) {
    for (const std::string_view key : keys) {
        if (!reader.has(key)) origins.push_back({name, std::string(key), Origin::by_default});
    }
}

}  // namespace qchopper
