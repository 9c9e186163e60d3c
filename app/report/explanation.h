// Why a cut lies where it lies, as sentences, a table, a plot and a document.

#pragma once

#include <string>
#include <vector>

#include "app/project/explain.h"
#include "segment/picture/plot.h"

namespace qchopper {

// In words, ending in a full stop: how the chosen plane compares with the next or with the best.
std::string verdict(const Explanation& explanation);

// What the cut made, the verdict, and a table of the ten best planes, with the chosen one if it is not among them.
std::vector<std::string> lines(const Explanation& explanation, const Project& project, const std::string& picture);

// Of a cut whose objective values come out otherwise than when it was decided.
std::vector<std::string> warnings(const Explanation& explanation);

Plot plot(const Explanation& explanation, const std::string& project);

// The one JSON document, with what is discarded in the project; `picture` is where the plot was written.
std::string document(const Explanation& explanation, const Project& project, const std::string& picture);

}  // namespace qchopper
