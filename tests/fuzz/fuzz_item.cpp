// What a program is made from, of a stranger: an item that is read and written is read again as the same item. Inputs
// are the content, which is sealed here, because no change of it would pass the seal.

#include <algorithm>

#include "app/jobs/work_item.h"
#include "app/store/caches/cache_file.h"
#include "tests/fuzz/demand.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace qchopper;
    constexpr const char* build = "0.1.0+0123456789ab";
    CacheWriter content;
    for (std::size_t i = 0; i < size; ++i) content.put(data[i]);
    or_refused(InputFault::mesh, [&] {
        const Bytes written = to_bytes(item_from(sealed(content), "fuzz.qitem", build));
        try {
            demand(to_bytes(item_from(written, "written.qitem", build)) == written);
        } catch (const InputError&) {
            std::abort();
        }
    });
    return 0;
}
