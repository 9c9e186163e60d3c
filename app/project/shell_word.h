// A name as it is typed in a shell, for the commands that are printed for the operator.

#pragma once

#include <filesystem>
#include <string>

namespace qchopper {

// The text itself where no shell would read it otherwise, else quoted. Typed in a POSIX shell it is one word again, and
// no option (tests/app/project/shell_word_test.cpp).
std::string shell_word(const std::filesystem::path& path);

}  // namespace qchopper
