// Explains a cut by the candidates that were ranked for it: sentences, a table, a plot and a document. Offsets in mm.

#pragma once

#include <string>
#include <vector>

#include "app/engine/explain.h"
#include "app/report/document.h"
#include "segment/picture/plot.h"

namespace qchopper {

// A sentence that compares the chosen plane with the next or with the best.
std::string describe(const Explanation& explanation);

// What the cut made, the verdict, and a table of the ten best planes, with the chosen one if it is not among them.
std::vector<std::string> lines(const Explanation& explanation, const Project& project, const std::string& picture);

// One if the total of the chosen plane differs from that at the decision by more than 1e-6, relative.
std::vector<std::string> warnings(const Explanation& explanation);

// `project` is its name in the title.
Plot plot(const Explanation& explanation, const std::string& project);

// The document qchopper-explain-3, with the discarded pieces of the project; `picture` is the path of the plot.
Document document(const Explanation& explanation, const Project& project, const std::string& picture);

}  // namespace qchopper
