// Answers of the console in the form of HTTP.

#pragma once

#include <string>

#include "app/console/http/http_message.h"
#include "app/console/worker/worker.h"

namespace qchopper {

HttpAnswer http_answer(const WorkerAnswer& answer);
// The document qchopper-error-1; nothing was changed.
HttpAnswer refusal(unsigned status, const std::string& what, const Sentence& to_do = {});
// Fields that keep a browser from using an answer for anything but what it is.
void add_guards(HttpAnswer& answer);

}  // namespace qchopper
