// Quotes a path for a POSIX shell, for the commands that are printed for the operator.

#pragma once

#include <filesystem>
#include <string>

namespace qchopper {

// The path itself if it has letters, digits and harmless marks only, else in single quotes. The shell reads it as one
// word, and no program as an option (tests/base/shell_word_test.cpp). O(characters).
std::string shell_word(const std::filesystem::path& path);

}  // namespace qchopper
