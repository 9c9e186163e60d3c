// One call of stat().

#include "base/files/regular_file.h"

#include <sys/stat.h>

#include "base/error.h"

namespace qchopper {
namespace {

const char* kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

}  // namespace

void refuse_irregular(const std::filesystem::path& path, mode_t mode) {
    if (S_ISREG(mode)) return;
    throw InputError(InputFault::missing, path.string() + " is " + kind_of(mode) + ", not a file",
                     "name the file itself");
}

void check_regular_file(const std::filesystem::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0) refuse_irregular(path, info.st_mode);
}

}  // namespace qchopper
