// Keeps what was made for display in a project's cache, so that it is made once and found by its id. The files may be
// deleted at any time.
//
// KEY.display says what was made of an input, by its SHA-256; ID.mesh, ID.states and ID.path hold it. All end in a
// SHA-256 of their content: a damaged file is ignored and made again (tests/app/display/display_store_test.cpp).

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/store/caches/cache_file.h"
#include "base/files/file.h"

namespace qchopper {

// A mesh (QCD1), states (QCS1) or the way of a tool (QCP1) as they are sent.
struct DisplayFile {
    std::string id;           // display_id() of what is packed
    double deviation_mm = 0;  // of a mesh: its faces are so far from the surface that they show at most
    Bytes packed;             // gzip
    bool operator==(const DisplayFile&) const = default;
};

enum class DisplayKind { mesh, states, path };

// What the folder holds for `key`, or what `make` returns, which is kept. With an empty folder, or if it cannot be
// written, nothing is kept. Throws what `make` throws. May be called from several threads at once.
DisplayFile kept_or_made(const std::filesystem::path& folder, DisplayKind kind, const CacheWriter& key,
                         const std::function<DisplayFile()>& make);

// The packed bytes with that id; nothing if the folder does not hold them, or the text is no id: it may be anything.
std::optional<Bytes> kept_display(const std::filesystem::path& folder, DisplayKind kind, const std::string& id);

// Removes the oldest files beyond `count` of each kind.
void remove_oldest_display(const std::filesystem::path& folder, std::size_t count);

}  // namespace qchopper
