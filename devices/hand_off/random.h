// Random numbers of the operating system, for identities that nobody may guess or draw twice.
//
// Both throw InputError (io) if the system gives none.

#pragma once

#include <cstdint>

#include "base/uuid.h"

namespace qchopper {

// Never 0.
std::uint32_t random_number();

// UUID version 4 (RFC 9562).
Uuid random_id();

}  // namespace qchopper
