// The JSON document of a command: a value until it is printed, so that --timings can add a key to it.

#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace qchopper {

struct Document {
    std::shared_ptr<const nlohmann::ordered_json> json;  // never empty
    bool is_one_line = false;                            // else indented by one space a level
};

// A document of this value; the second one is printed as one line.
Document compose(nlohmann::ordered_json json);
Document compose_line(nlohmann::ordered_json json);

// As it is printed, without a line end; bytes that are not UTF-8 are replaced.
std::string text_of(const Document& document);

}  // namespace qchopper
