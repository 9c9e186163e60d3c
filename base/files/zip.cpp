// Wraps libzip. zip() reads each entry twice, for its size and for its content, and takes memory for one stretch and
// the archive. unzip() packs the entries again, to compare them with the input, and takes three times the
// archive. O(bytes).

#include "base/files/zip.h"

#include <zip.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include "base/error.h"
#include "base/files/portable_name.h"

namespace qchopper {
namespace {

constexpr zip_int64_t max_entries = 1000;

struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct CloseFile {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, DiscardArchive>;
using Source = std::unique_ptr<zip_source_t, FreeSource>;
using OpenFile = std::unique_ptr<zip_file_t, CloseFile>;

// Working in memory fails only for want of it.
void must(bool done) {
    if (!done) throw std::bad_alloc();
}

// Bytes that stay the caller's; nullptr: a buffer that grows.
Source source_of(const std::uint8_t* bytes, std::size_t size) {
    zip_error_t error;
    zip_error_init(&error);
    Source source(zip_source_buffer_create(bytes, size, 0, &error));
    zip_error_fini(&error);
    must(source != nullptr);
    return source;
}

// Nothing if the source is no archive. The archive that is returned owns one reference to the source.
Archive open_archive(zip_source_t* source, int flags) {
    zip_error_t error;
    zip_error_init(&error);
    Archive archive(zip_open_from_source(source, flags, &error));
    zip_error_fini(&error);
    return archive;
}

// What libzip reads an entry from. Exceptions must not cross the library: they are kept and rethrown by zip().
struct Reading {
    const ZipEntry& entry;
    std::exception_ptr& failure;
    std::uint64_t size = 0;  // of the whole entry; stated beforehand, so that no ZIP64 is needed for a small one
    NextStretch next = {};
    std::string stretch = {};
    std::size_t used = 0;  // of the stretch
    bool is_at_end = false;

    void measure() {
        const NextStretch count = entry.open();
        for (std::string some; count(some), !some.empty(); some.clear()) size += some.size();
    }

    zip_int64_t read(char* to, zip_uint64_t capacity) {
        zip_uint64_t filled = 0;
        while (filled < capacity) {
            if (used == stretch.size()) {
                stretch.clear();
                used = 0;
                next(stretch);
                is_at_end = stretch.empty();
                if (is_at_end) break;
            }
            const std::size_t some = std::min<std::size_t>(capacity - filled, stretch.size() - used);
            std::memcpy(to + filled, stretch.data() + used, some);
            used += some;
            filled += some;
        }
        return static_cast<zip_int64_t>(filled);
    }

    void restart() {
        next = entry.open();
        is_at_end = false;
        stretch.clear();
        used = 0;
    }
};

void set_size(zip_stat_t* stat, std::uint64_t size) {
    zip_stat_init(stat);
    stat->size = size;
    stat->valid |= ZIP_STAT_SIZE;
}

zip_int64_t set_no_memory(int* codes) {
    codes[0] = ZIP_ER_MEMORY;
    codes[1] = 0;
    return 2 * sizeof(int);
}

// The callback of a source, as zip_source_function(3) defines it.
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
                if (reading.is_at_end && reading.entry.close) reading.entry.close();
                return 0;
            case ZIP_SOURCE_FREE:
                return 0;
            case ZIP_SOURCE_STAT:
                set_size(static_cast<zip_stat_t*>(data), reading.size);
                return sizeof(zip_stat_t);
            case ZIP_SOURCE_ERROR:
                return set_no_memory(static_cast<int*>(data));
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

// What libzip writes an archive to. Exceptions must not cross the library.
struct Writing {
    Bytes bytes = {};
    std::uint64_t at = 0;

    zip_int64_t write(const char* from, zip_uint64_t size) {
        if (bytes.size() < at + size) bytes.resize(at + size);
        std::memcpy(bytes.data() + at, from, size);
        at += size;
        return static_cast<zip_int64_t>(size);
    }

    zip_int64_t seek(void* arguments, zip_uint64_t size) {
        const zip_int64_t to = zip_source_seek_compute_offset(at, bytes.size(), arguments, size, nullptr);
        if (to < 0) return -1;
        at = static_cast<std::uint64_t>(to);
        return 0;
    }
};

// The callback of that source, as zip_source_function(3) defines it. It is never read: the archive is new.
zip_int64_t take(void* state, void* data, zip_uint64_t size, zip_source_cmd_t command) {
    auto& writing = *static_cast<Writing*>(state);
    try {
        switch (command) {
            case ZIP_SOURCE_OPEN:
            case ZIP_SOURCE_CLOSE:
            case ZIP_SOURCE_BEGIN_WRITE:
            case ZIP_SOURCE_COMMIT_WRITE:
            case ZIP_SOURCE_ROLLBACK_WRITE:
            case ZIP_SOURCE_FREE:
                return 0;
            case ZIP_SOURCE_WRITE:
                return writing.write(static_cast<const char*>(data), size);
            case ZIP_SOURCE_SEEK_WRITE:
                return writing.seek(data, size);
            case ZIP_SOURCE_TELL_WRITE:
                return static_cast<zip_int64_t>(writing.at);
            case ZIP_SOURCE_STAT:
                set_size(static_cast<zip_stat_t*>(data), writing.bytes.size());
                return sizeof(zip_stat_t);
            case ZIP_SOURCE_ERROR:
                return set_no_memory(static_cast<int*>(data));
            case ZIP_SOURCE_SUPPORTS:
                return zip_source_make_command_bitmap(
                    ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE, ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR,
                    ZIP_SOURCE_FREE, ZIP_SOURCE_SEEK, ZIP_SOURCE_TELL, ZIP_SOURCE_BEGIN_WRITE, ZIP_SOURCE_COMMIT_WRITE,
                    ZIP_SOURCE_ROLLBACK_WRITE, ZIP_SOURCE_WRITE, ZIP_SOURCE_SEEK_WRITE, ZIP_SOURCE_TELL_WRITE,
                    ZIP_SOURCE_REMOVE, -1);
            default:
                return -1;
        }
    } catch (...) {
        return -1;
    }
}

[[noreturn]] void refuse(const std::string& source, const std::string& why) {
    throw InputError(InputFault::mesh, source + " is not a whole job file: " + why,
                     "write it again with qchopper prepare, or copy it again");
}

Bytes read_entry(zip_t* archive, zip_uint64_t index, std::uint64_t size, const std::string& name,
                 const std::string& source) {
    const OpenFile file(zip_fopen_index(archive, index, 0));
    if (!file) refuse(source, name + " cannot be opened");
    Bytes bytes(size);
    std::uint64_t filled = 0;
    while (true) {
        std::uint8_t spare = 0;  // reading past the end is what makes libzip compare the checksum
        const bool full = filled == size;
        const zip_int64_t got = zip_fread(file.get(), full ? &spare : bytes.data() + filled, full ? 1 : size - filled);
        if (got < 0) refuse(source, name + " is damaged");
        if (got == 0) break;
        if (full) refuse(source, name + " is longer than it says");
        filled += static_cast<std::uint64_t>(got);
    }
    if (filled != size) refuse(source, name + " is cut short");
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
    Writing writing;  // outlives the archive, as the readings do
    std::exception_ptr failure;
    std::vector<std::unique_ptr<Reading>> readings;
    zip_error_t error;
    zip_error_init(&error);
    Source target(zip_source_function_create(take, &writing, &error));
    zip_error_fini(&error);
    must(target != nullptr);
    Archive archive = open_archive(target.get(), ZIP_CREATE | ZIP_TRUNCATE);
    must(archive != nullptr);
    static_cast<void>(target.release());  // the archive owns it now
    std::uint64_t total = 0;
    for (const ZipEntry& entry : entries) {
        readings.push_back(std::make_unique<Reading>(Reading{entry, failure}));
        readings.back()->measure();
        if (!entry.is_packed) total += readings.back()->size;
        add(archive.get(), *readings.back());
    }
    constexpr std::uint64_t max_beside_an_entry = 512;  // headers and names, of names that are not long
    writing.bytes.reserve(total + max_beside_an_entry * (entries.size() + 1));
    const bool is_closed = zip_close(archive.get()) == 0;
    if (failure) std::rethrow_exception(failure);
    must(is_closed);
    static_cast<void>(archive.release());
    return std::move(writing.bytes);
}

Bytes zip(const std::map<std::string, Bytes>& files) {
    std::vector<ZipEntry> entries;
    entries.reserve(files.size());
    for (const auto& [name, bytes] : files) entries.push_back(zip_entry(name, bytes));
    return zip(entries);
}

Bytes zip(std::map<std::string, Bytes>&& files) {
    std::vector<ZipEntry> entries;
    entries.reserve(files.size());
    for (auto& [name, bytes] : files) {
        entries.push_back(zip_entry(name, bytes));
        entries.back().close = [&bytes = bytes] { Bytes().swap(bytes); };
    }
    return zip(entries);
}

std::map<std::string, Bytes> unzip(const Bytes& bytes, const std::string& source) {
    if (bytes.empty()) refuse(source, "it is empty");  // to libzip that is an archive of nothing
    Source whole = source_of(bytes.data(), bytes.size());
    Archive archive = open_archive(whole.get(), ZIP_RDONLY | ZIP_CHECKCONS);
    if (!archive) refuse(source, "it is no ZIP, or a damaged one");
    static_cast<void>(whole.release());

    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    if (count > max_entries) refuse(source, "it has more than " + std::to_string(max_entries) + " entries");
    std::map<std::string, Bytes> entries;
    std::uint64_t total = 0;
    for (zip_int64_t i = 0; i < count; ++i) {
        const auto index = static_cast<zip_uint64_t>(i);
        zip_stat_t stat;
        zip_stat_init(&stat);
        if (zip_stat_index(archive.get(), index, 0, &stat) != 0) refuse(source, "an entry cannot be read");
        const std::string name = stat.name != nullptr ? stat.name : "";
        if (!is_portable_name(name)) refuse(source, "an entry has a name that no job file has");
        if (entries.contains(name)) refuse(source, name + " is there twice");
        if (stat.comp_method != ZIP_CM_STORE || stat.encryption_method != ZIP_EM_NONE || stat.size != stat.comp_size) {
            refuse(source, name + " is compressed or encrypted, and job files never are");
        }
        total += stat.size;
        if (stat.size > bytes.size() || total > bytes.size()) refuse(source, "its entries are larger than the file");
        entries[name] = read_entry(archive.get(), index, stat.size, name, source);
    }
    archive.reset();
    if (zip(entries) != bytes) {
        refuse(source, "it holds more than its entries, or is packed in another way than qchopper packs");
    }
    return entries;
}

}  // namespace qchopper
