// Keys and ids that nobody can guess, from the random numbers of the system.

#pragma once

#include <cstddef>
#include <string>

namespace qchopper {

// Twice as many hexadecimal digits.
std::string random_digits(std::size_t bytes = 16);

}  // namespace qchopper
