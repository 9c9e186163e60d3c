// The simulated cell's memory.json: saving what was read gives the same bytes.

#include <nlohmann/json.hpp>
#include <optional>

#include "base/sha256.h"
#include "sim/cell/memory.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

void try_memory(const std::string& text) {
    or_refused(InputFault::config, [&] { demand(to_json(memory_from_json(text, "fuzz")) == text); });
}

// The same values in the form of the file, with the right checksum, which no mutation would find.
std::optional<std::string> with_checksum(const std::string& text) {
    using Json = nlohmann::json;
    try {
        Json all = Json::parse(text);
        if (!all.is_object()) return std::nullopt;
        all.erase("sha256");
        const std::string summed = all.dump(1);
        all["sha256"] = to_hex(sha256({reinterpret_cast<const std::uint8_t*>(summed.data()), summed.size()}));
        return all.dump(1) + "\n";
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    qchopper::try_memory(text);
    if (const std::optional<std::string> summed = qchopper::with_checksum(text)) qchopper::try_memory(*summed);
    return 0;
}
