// A sentence for a person. Where a program that shows it can name a control of its own in it, the sentence has a key:
// the command line words it with its options (app/report/command_line_text.h), a page with its buttons.
//
// Tests: tests/architecture/options_test.py, tests/app/report/command_line_text_test.cpp.

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace qchopper {

struct Sentence {
    std::string text;              // complete, and right wherever it is shown: names no option and no button
    std::string key;               // "give_unit"; empty: the text is all that there is
    std::vector<Sentence> values;  // what the sentence of that key is completed by: figures, names, other sentences

    Sentence() = default;
    Sentence(std::string plain) : text(std::move(plain)) {}
    Sentence(const char* plain) : text(plain) {}
    static Sentence with_key(const char* key, std::vector<Sentence> values, std::string text) {
        Sentence sentence(std::move(text));
        sentence.key = key;
        sentence.values = std::move(values);
        return sentence;
    }

    bool empty() const { return text.empty(); }
};

}  // namespace qchopper
