// Writes an identifier as text.

#include "base/uuid.h"

#include "base/hex.h"

namespace qchopper {

std::string to_text(const Uuid& id) {
    std::string text = to_hex(id);
    for (const std::size_t at : {20, 16, 12, 8}) text.insert(at, "-");
    return text;
}

}  // namespace qchopper
