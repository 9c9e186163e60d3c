// One question.

#include "app/cli/unusual_size.h"

#include <unistd.h>

#include "app/cli/confirm.h"
#include "base/error.h"
#include "segment/import/inspect.h"

namespace qchopper {

std::function<void(Vec3 size)> unusual_size_check(bool size_ok) {
    if (size_ok) return {};
    return [](Vec3 size) {
        const std::string what = "the scan measures " + describe_size(size) + ", and 1 cm to 20 m is usual";
        if (::isatty(STDIN_FILENO) == 0 || !is_confirmed(what + ". Is that its size?")) {
            throw InputError(InputFault::use, what, "check --units and --scale; if the size is right pass --size-ok");
        }
    };
}

}  // namespace qchopper
