// Files and folders that are removed if the program ends before they are finished.
//
// For a program that is stopped in the middle of its work; what a killed one leaves is removed by a later run, where
// that is possible (staged_folder.h, project folders). All functions may be called from several threads at once.

#pragma once

#include <cstddef>
#include <filesystem>

namespace qchopper {

// Lists a path during its lifetime.
class Unfinished {
 public:
    explicit Unfinished(std::filesystem::path path);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

 private:
    std::size_t number_;
};

// Removes what is listed, folders with their content, and from then on blocks threads that begin or end one. Only for
// the moment before the process ends. What cannot be removed is left.
void remove_unfinished_and_block();

}  // namespace qchopper
