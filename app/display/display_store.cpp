// O(bytes).

#include "app/display/display_store.h"

#include <array>

#include "base/hex.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* made_ending = ".display";

const char* ending_of(DisplayKind kind) {
    constexpr std::array endings{".mesh", ".states", ".path"};  // in the order of DisplayKind
    return endings[static_cast<std::size_t>(kind)];
}

std::optional<DisplayFile> found_in(const fs::path& folder, DisplayKind kind, const fs::path& made) {
    const std::optional<Bytes> bytes = kept(made);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    DisplayFile file;
    file.id = in.text();
    file.deviation_mm = in.get<double>();
    if (!in.is_whole()) return std::nullopt;
    std::optional<Bytes> packed = kept_display(folder, kind, file.id);
    if (!packed) return std::nullopt;
    file.packed = *std::move(packed);
    return file;
}

}  // namespace

DisplayFile kept_or_made(const fs::path& folder, DisplayKind kind, const CacheWriter& key,
                         const std::function<DisplayFile()>& make) {
    if (folder.empty()) return make();
    const fs::path made = cache_file(folder, key, made_ending);
    if (std::optional<DisplayFile> found = found_in(folder, kind, made)) return *std::move(found);
    DisplayFile file = make();
    CacheWriter content;
    content.put_all(file.packed);
    keep(folder / (file.id + ending_of(kind)), content);
    CacheWriter of_input;
    of_input.put(file.id);
    of_input.put(file.deviation_mm);
    keep(made, of_input);
    return file;
}

std::optional<Bytes> kept_display(const fs::path& folder, DisplayKind kind, const std::string& id) {
    if (!from_hex<16>(id)) return std::nullopt;
    const std::optional<Bytes> bytes = kept(folder / (id + ending_of(kind)));
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    Bytes packed = in.get_all<std::uint8_t>();
    if (!in.is_whole()) return std::nullopt;
    return packed;
}

void remove_oldest_display(const fs::path& folder, std::size_t count) {
    if (folder.empty()) return;
    remove_oldest(folder, made_ending, count);
    for (const DisplayKind kind : {DisplayKind::mesh, DisplayKind::states, DisplayKind::path}) {
        remove_oldest(folder, ending_of(kind), count);
    }
}

}  // namespace qchopper
