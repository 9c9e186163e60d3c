// What dry-run and dispatch tell at their end: a table for people, one JSON document for programs.

#pragma once

#include <string>
#include <vector>

#include "app/project/hand_over.h"

namespace qchopper {

struct HandOverReport {
    std::vector<HandedOver> handed;
    std::size_t wanted = 0;  // so many jobs were to be handed over
    bool is_simulated = false;
    bool is_complete() const;
    bool is_cancelled() const;
};

std::vector<std::string> lines(const HandOverReport& report);
std::string document(const HandOverReport& report, const std::string& schema);

}  // namespace qchopper
