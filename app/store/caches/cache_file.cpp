// O(bytes).

#include "app/store/caches/cache_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/hex.h"
#include "base/sha256.h"

namespace qchopper {

namespace fs = std::filesystem;

fs::path cache_file(const fs::path& folder, const CacheWriter& key, const std::string& extension) {
    return folder / (to_hex(sha256(key.bytes())) + extension);
}

Bytes sealed(const CacheWriter& content) {
    Bytes bytes = content.bytes();
    const Sha256 digest = sha256(bytes);
    bytes.insert(bytes.end(), digest.bytes.begin(), digest.bytes.end());
    return bytes;
}

std::optional<Bytes> unsealed(Bytes bytes) {
    if (bytes.size() < sizeof(Sha256)) return std::nullopt;
    const std::size_t size = bytes.size() - sizeof(Sha256);
    const Sha256 digest = sha256(std::span(bytes).first(size));
    if (!std::equal(digest.bytes.begin(), digest.bytes.end(), bytes.end() - sizeof(Sha256))) return std::nullopt;
    bytes.resize(size);
    return bytes;
}

std::optional<Bytes> kept(const fs::path& file) {
    try {
        return unsealed(read_file(file));
    } catch (const InputError&) {
        return std::nullopt;
    }
}

void keep(const fs::path& file, const CacheWriter& content) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    try {
        write_file(file, sealed(content));
    } catch (const InputError&) {
    }
}

void remove_oldest(const fs::path& folder, const std::string& extension, std::size_t count) {
    std::error_code error;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == extension) files.emplace_back(entry.last_write_time(error), entry.path());
    }
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i + count < files.size(); ++i) fs::remove(files[i].second, error);
}

}  // namespace qchopper
