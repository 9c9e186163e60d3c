// zlib's inflate into a buffer that doubles up to the limit: O(unpacked bytes). Of a text one copy: O(bytes).

#include "segment/io/formats/unpack.h"

#include <zlib.h>
#include <algorithm>
#include <limits>
#include <new>

#include "base/error.h"

namespace qchopper {
namespace {

// Owns the memory of zlib.
struct Inflater {
    z_stream stream{};
    Inflater() {
        constexpr int gzip_only = 15 + 16;  // the largest window, and no format but gzip
        if (inflateInit2(&stream, gzip_only) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
};

[[noreturn]] void refuse(const std::string& what) {
    throw InputError(InputFault::mesh, what, "unpack the file yourself, or copy it again");
}

}  // namespace

std::uint64_t max_unpacked(std::uint64_t packed) {
    constexpr std::uint64_t mebi = 1 << 20;
    return std::clamp(200 * packed, 64 * mebi, 8192 * mebi);
}

bool is_gzip(const Bytes& bytes) {
    return bytes.size() >= 3 && bytes[0] == 0x1f && bytes[1] == 0x8b && bytes[2] == 8;
}

Bytes gunzip(const Bytes& bytes, const std::string& name) {
    Inflater inflater;
    z_stream& stream = inflater.stream;
    const std::uint64_t most = max_unpacked(bytes.size());
    std::size_t used = 0;  // packed bytes that zlib has been given
    Bytes unpacked;
    std::size_t filled = 0;
    while (true) {
        if (stream.avail_in == 0) {
            constexpr std::size_t max_given = std::numeric_limits<uInt>::max();
            stream.next_in = const_cast<Bytef*>(bytes.data() + used);  // zlib only reads
            stream.avail_in = static_cast<uInt>(std::min(max_given, bytes.size() - used));
            used += stream.avail_in;
        }
        if (filled == unpacked.size()) {
            if (filled == most)
                refuse(name + " is packed (gzip) and would become more than " + std::to_string(most >> 20) + " MiB");
            unpacked.resize(static_cast<std::size_t>(std::min<std::uint64_t>(most, 2 * filled + 65536)));
        }
        const std::size_t space = std::min<std::size_t>(unpacked.size() - filled, 1 << 30);
        stream.next_out = unpacked.data() + filled;
        stream.avail_out = static_cast<uInt>(space);
        const int state = inflate(&stream, Z_NO_FLUSH);
        filled += space - stream.avail_out;
        if (state == Z_STREAM_END) {
            // another member may follow; other bytes after it are ignored, as gunzip does
            const bool more = used - stream.avail_in + 2 <= bytes.size() && bytes[used - stream.avail_in] == 0x1f &&
                              bytes[used - stream.avail_in + 1] == 0x8b;
            if (!more) break;
            inflateReset(&stream);
        } else if (state == Z_BUF_ERROR ||
                   (state == Z_OK && stream.avail_in == 0 && used == bytes.size() && stream.avail_out > 0)) {
            refuse(name + " is packed (gzip) and ends before its end mark");
        } else if (state != Z_OK) {
            refuse(name + " is packed (gzip) and damaged");
        }
    }
    unpacked.resize(filled);
    return unpacked;
}

std::optional<Bytes> to_utf8(const Bytes& bytes) {
    if (bytes.size() >= 3 && bytes[0] == 0xef && bytes[1] == 0xbb && bytes[2] == 0xbf) {
        return Bytes(bytes.begin() + 3, bytes.end());
    }
    const bool is_big = bytes.size() >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff;
    const bool is_little = bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe;
    if (!is_big && !is_little) return {};
    Bytes text;
    text.reserve(bytes.size() / 2);
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        const std::uint8_t low = bytes[is_big ? i + 1 : i];
        const std::uint8_t high = bytes[is_big ? i : i + 1];
        text.push_back(high == 0 && low < 128 ? low : '?');
    }
    if (bytes.size() % 2 == 1) text.push_back('?');  // half a character: the file was cut short
    return text;
}

}  // namespace qchopper
