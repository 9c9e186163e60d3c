// The files of a project's cache, which may be deleted at any time: values in the byte order of the machine, and at the
// end a SHA-256 of the rest, by which a damaged file is known. Each kind of content has a store of its own, with a
// number that is raised whenever the same key has other content, and a test (tests/app/store/caches).

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/plane.h"

namespace qchopper {

class CacheWriter {
 public:
    template <typename T>
    void put(T value) {
        static_assert(std::is_arithmetic_v<T>);
        add(&value, sizeof value);
    }
    template <typename T>
    void put_all(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        put(values.size());
        add(values.data(), values.size() * sizeof(T));
    }
    void put(const Vec3& v) {
        for (const double x : {v.x, v.y, v.z}) put(x);
    }
    void put(const Plane& p) {
        put(p.normal);
        put(p.offset);
    }
    void put(const std::string& text) { put_all(std::vector<char>(text.begin(), text.end())); }
    const Bytes& bytes() const { return bytes_; }

 private:
    // Not inline: of several calls in a row g++ 12 believes that the vector cannot grow.
    [[gnu::noinline]] void add(const void* from, std::size_t count) {
        if (count == 0) return;
        const std::size_t before = bytes_.size();
        bytes_.resize(before + count);
        std::memcpy(bytes_.data() + before, from, count);
    }

    Bytes bytes_;
};

// Never reads beyond the end, but returns zeros, nor a value that an enumeration does not have, but its last one;
// is_whole() is then false.
class CacheReader {
 public:
    explicit CacheReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    template <typename T>
    T get() {
        T value{};
        if (bytes_.size() < sizeof value) {
            is_wrong_ = true;
            return value;
        }
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_ = bytes_.subspan(sizeof value);
        return value;
    }
    // All elements of a list; none if the bytes do not hold so many.
    template <typename T>
    std::vector<T> get_all() {
        const auto n = get<std::size_t>();
        if (n > bytes_.size() / sizeof(T)) {
            is_wrong_ = true;
            return {};
        }
        std::vector<T> values(n);
        if (n > 0) std::memcpy(values.data(), bytes_.data(), n * sizeof(T));
        bytes_ = bytes_.subspan(n * sizeof(T));
        return values;
    }
    std::string text() {
        const std::vector<char> characters = get_all<char>();
        return {characters.begin(), characters.end()};
    }
    Vec3 vec3() {
        Vec3 v;
        for (double* x : {&v.x, &v.y, &v.z}) *x = get<double>();
        return v;
    }
    // `last` is the last of values that begin at 0 and leave none out.
    template <typename Enum>
    Enum one_of(Enum last) {
        const auto number = get<std::uint8_t>();
        if (number <= static_cast<std::uint8_t>(last)) return static_cast<Enum>(number);
        is_wrong_ = true;
        return last;
    }
    // A count of elements of at least one byte each.
    std::size_t count() {
        const auto n = get<std::size_t>();
        if (n <= bytes_.size()) return n;
        is_wrong_ = true;
        return 0;
    }
    bool is_whole() const { return !is_wrong_ && bytes_.empty(); }

 private:
    std::span<const std::uint8_t> bytes_;
    bool is_wrong_ = false;
};

// The file in `folder` for what follows from the values in `key`: named by their SHA-256.
std::filesystem::path cache_file(const std::filesystem::path& folder, const CacheWriter& key,
                                 const std::string& extension);

// The values with their SHA-256 behind them, and the values of such bytes; nothing if they are damaged. O(bytes).
Bytes sealed(const CacheWriter& content);
std::optional<Bytes> unsealed(Bytes bytes);

// What keep() wrote; nothing if there is no such file, or it is damaged. Never throws InputError.
std::optional<Bytes> kept(const std::filesystem::path& file);

// Makes the folder when needed. What cannot be written is not kept: a full disk costs time, not work.
void keep(const std::filesystem::path& file, const CacheWriter& content);

// Removes the files of this ending that were written first, so that `count` stay. Throws nothing.
void remove_oldest(const std::filesystem::path& folder, const std::string& extension, std::size_t count);

}  // namespace qchopper
