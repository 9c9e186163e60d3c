#include "cam/job/zip.h"

#include <zip.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>

#include "base/error.h"
#include "base/portable_name.h"
#include "base/zip.h"
#include "cam/job/ticket.h"

namespace qchopper {
namespace {

constexpr zip_int64_t most_entries = 1000;

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

// The bytes stay the caller's.
Source view_of(const Bytes& bytes) {
    zip_error_t error;
    zip_error_init(&error);
    Source source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error));
    zip_error_fini(&error);
    if (!source) throw std::bad_alloc();
    return source;
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

Bytes zip(const std::map<std::string, Bytes>& files) {
    std::vector<ZipEntry> entries;
    entries.reserve(files.size());
    for (const auto& [name, bytes] : files) entries.push_back(zip_entry(name, bytes));
    return zip(entries);
}

std::map<std::string, Bytes> unzip(const Bytes& bytes, const std::string& source) {
    if (bytes.empty()) refuse(source, "it is empty");  // to libzip that is an archive of nothing
    zip_error_t error;
    zip_error_init(&error);
    Source whole = view_of(bytes);
    Archive archive(zip_open_from_source(whole.get(), ZIP_RDONLY | ZIP_CHECKCONS, &error));
    zip_error_fini(&error);
    if (!archive) refuse(source, "it is no ZIP, or a damaged one");
    static_cast<void>(whole.release());

    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    if (count > most_entries) refuse(source, "it has more than " + std::to_string(most_entries) + " entries");
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
