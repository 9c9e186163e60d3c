// What becomes of a scan whose size tells of a wrong unit: without --size-ok it is asked on a terminal, else refused.

#pragma once

#include <functional>

#include "base/vec3.h"

namespace qchopper {

// ImportOptions::on_unusual_size. It throws InputError (use) where nobody confirms the size
// (tests/app/cli/terminal_test.py).
std::function<void(Vec3 size)> unusual_size_check(bool size_ok);

}  // namespace qchopper
