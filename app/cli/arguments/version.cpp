// The build id lies in a note of the program's own file, which is in memory while it runs.

#include "app/cli/arguments/version.h"

#include <elf.h>
#include <link.h>

#include <cstdint>
#include <string_view>

#include "base/hex.h"

namespace qchopper {
namespace {

constexpr std::size_t digits = 12;

// The bytes of the build id in a segment of notes, in hexadecimal digits; empty: none is there.
std::string build_id_in(const std::uint8_t* notes, std::size_t size) {
    const auto padded = [](std::size_t length) { return (length + 3) / 4 * 4; };
    std::size_t at = 0;
    while (at + sizeof(ElfW(Nhdr)) <= size) {
        const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(notes + at);
        const std::size_t name = at + sizeof(ElfW(Nhdr));
        const std::size_t content = name + padded(note->n_namesz);
        const std::size_t end = content + padded(note->n_descsz);
        if (end > size) break;
        const std::string_view owner(reinterpret_cast<const char*>(notes + name), note->n_namesz);
        if (note->n_type == NT_GNU_BUILD_ID && owner == std::string_view("GNU\0", 4)) {
            return to_hex({notes + content, note->n_descsz});
        }
        at = end;
    }
    return {};
}

// Of the program itself, which is the first of the files in memory.
int take_build_id(dl_phdr_info* file, std::size_t /*size*/, void* id) {
    for (ElfW(Half) i = 0; i < file->dlpi_phnum; ++i) {
        const ElfW(Phdr)& segment = file->dlpi_phdr[i];
        if (segment.p_type != PT_NOTE) continue;
        // The linker gives addresses as numbers. NOLINTNEXTLINE(performance-no-int-to-ptr)
        const auto* notes = reinterpret_cast<const std::uint8_t*>(file->dlpi_addr + segment.p_vaddr);
        const std::string found = build_id_in(notes, segment.p_memsz);
        if (!found.empty()) *static_cast<std::string*>(id) = found;
    }
    return 1;
}

std::string with_build_id() {
    std::string id;
    ::dl_iterate_phdr(take_build_id, &id);
    return std::string(QCHOPPER_VERSION) + (id.empty() ? "" : "+" + id.substr(0, digits));
}

}  // namespace

const std::string& version() {
    static const std::string text = with_build_id();
    return text;
}

}  // namespace qchopper
