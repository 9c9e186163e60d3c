#include "base/zip.h"

#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

namespace qchopper {
namespace {

struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Archive = std::unique_ptr<zip_t, DiscardArchive>;
using Source = std::unique_ptr<zip_source_t, FreeSource>;

// Writing to memory fails only for want of it.
void must(bool done) {
    if (!done) throw std::bad_alloc();
}

// What libzip reads an entry from. Exceptions must not cross the library: they are kept and thrown when it is through.
struct Reading {
    const ZipEntry& entry;
    std::exception_ptr& failure;
    std::uint64_t size = 0;  // of the whole entry; told beforehand, so that no ZIP64 is needed for a small one
    NextStretch next = {};
    std::string stretch = {};
    std::size_t used = 0;  // of the stretch

    void measure() {
        const NextStretch count = entry.open();
        for (std::string some; count(some), !some.empty(); some.clear()) size += some.size();
    }

    zip_int64_t read(char* to, zip_uint64_t room) {
        zip_uint64_t filled = 0;
        while (filled < room) {
            if (used == stretch.size()) {
                stretch.clear();
                used = 0;
                next(stretch);
                if (stretch.empty()) break;
            }
            const std::size_t some = std::min<std::size_t>(room - filled, stretch.size() - used);
            std::memcpy(to + filled, stretch.data() + used, some);
            used += some;
            filled += some;
        }
        return static_cast<zip_int64_t>(filled);
    }

    void restart() {
        next = entry.open();
        stretch.clear();
        used = 0;
    }
};

void tell_size(zip_stat_t* stat, std::uint64_t size) {
    zip_stat_init(stat);
    stat->size = size;
    stat->valid |= ZIP_STAT_SIZE;
}

zip_int64_t tell_no_memory(int* codes) {
    codes[0] = ZIP_ER_MEMORY;
    codes[1] = 0;
    return 2 * sizeof(int);
}

zip_int64_t serve(void* state, void* data, zip_uint64_t size, zip_source_cmd_t command) {
    auto& reading = *static_cast<Reading*>(state);
    try {
        switch (command) {
            case ZIP_SOURCE_OPEN:
                reading.restart();
                return 0;
            case ZIP_SOURCE_READ:
                return reading.read(static_cast<char*>(data), size);
            case ZIP_SOURCE_CLOSE:
            case ZIP_SOURCE_FREE:
                return 0;
            case ZIP_SOURCE_STAT:
                tell_size(static_cast<zip_stat_t*>(data), reading.size);
                return sizeof(zip_stat_t);
            case ZIP_SOURCE_ERROR:
                return tell_no_memory(static_cast<int*>(data));
            case ZIP_SOURCE_SUPPORTS:
                return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                                      ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
            default:
                return -1;
        }
    } catch (...) {
        reading.failure = std::current_exception();
        return -1;
    }
}

void add(zip_t* archive, Reading& reading) {
    Source source(zip_source_function(archive, serve, &reading));
    must(source != nullptr);
    const zip_int64_t index = zip_file_add(archive, reading.entry.name.c_str(), source.get(), ZIP_FL_ENC_UTF_8);
    must(index >= 0);
    static_cast<void>(source.release());  // the archive owns it now
    const auto entry = static_cast<zip_uint64_t>(index);
    constexpr zip_uint32_t level = 5;  // of 9: text shrinks to a fifth, and more effort gains hardly anything
    const bool packed = reading.entry.is_packed;
    must(zip_set_file_compression(archive, entry, packed ? ZIP_CM_DEFLATE : ZIP_CM_STORE, packed ? level : 0) == 0);
    constexpr zip_uint16_t first_of_january_1980 = (1 << 5) | 1;
    must(zip_file_set_dostime(archive, entry, 0, first_of_january_1980, 0) == 0);
    constexpr zip_uint32_t plain_file = 0100644u << 16;
    must(zip_file_set_external_attributes(archive, entry, 0, ZIP_OPSYS_UNIX, plain_file) == 0);
}

Bytes content(zip_source_t* source) {
    must(zip_source_open(source) == 0);
    must(zip_source_seek(source, 0, SEEK_END) == 0);
    Bytes bytes(static_cast<std::size_t>(zip_source_tell(source)));
    must(zip_source_seek(source, 0, SEEK_SET) == 0);
    const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
    zip_source_close(source);
    must(got == static_cast<zip_int64_t>(bytes.size()));
    return bytes;
}

}  // namespace

ZipEntry zip_entry(std::string name, const Bytes& bytes) {
    const auto open = [&bytes]() -> NextStretch {
        return [&bytes, at = std::size_t{0}](std::string& stretch) mutable {
            constexpr std::size_t most = 1 << 16;
            const std::size_t some = std::min(most, bytes.size() - at);
            stretch.assign(reinterpret_cast<const char*>(bytes.data()) + at, some);
            at += some;
        };
    };
    return {std::move(name), open, false};
}

Bytes zip(const std::vector<ZipEntry>& entries) {
    zip_error_t error;
    zip_error_init(&error);
    const Source target(zip_source_buffer_create(nullptr, 0, 0, &error));
    must(target != nullptr);
    zip_source_keep(target.get());  // closing the archive drops one reference; the bytes are read after that
    std::exception_ptr failure;
    std::vector<std::unique_ptr<Reading>> readings;  // outlive the archive
    Archive archive(zip_open_from_source(target.get(), ZIP_CREATE | ZIP_TRUNCATE, &error));
    zip_error_fini(&error);
    must(archive != nullptr);
    for (const ZipEntry& entry : entries) {
        readings.push_back(std::make_unique<Reading>(Reading{entry, failure}));
        readings.back()->measure();
        add(archive.get(), *readings.back());
    }
    const bool is_closed = zip_close(archive.get()) == 0;
    if (failure) std::rethrow_exception(failure);
    must(is_closed);
    static_cast<void>(archive.release());
    return content(target.get());
}

}  // namespace qchopper
