// The scans and projects of a folder, by ids that name no path, and what a project is at this moment.
//
// Nothing is held: every function looks at the disk (tests/app/console/console_folder_test.cpp).

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/console/console_state.h"

namespace qchopper {

// 16 hexadecimal digits of the SHA-256 of the name.
std::string id_of_name(const std::string& name);

// At most a thousand of each, by name. A project that cannot be read is listed with the reason.
FolderList list_folder(const std::filesystem::path& folder);

// Of the folder, by their ids; nothing if there is none.
std::optional<std::filesystem::path> scan_of_id(const std::filesystem::path& folder, const std::string& id);
std::optional<std::filesystem::path> project_of_id(const std::filesystem::path& folder, const std::string& id);
// The projects of the folder, by name.
std::vector<std::filesystem::path> projects_in(const std::filesystem::path& folder);

// Throws what load_project throws.
ProjectSummary summary_of(const std::filesystem::path& project);

// What changes when project.json does, without reading it; 0 if there is none.
std::uint64_t stamp_of(const std::filesystem::path& project);

// Whether a project of this name may be made: 1 to 80 letters, digits, spaces, '.', '_' and '-', the first one a letter
// or a digit, in UTF-8 of at most 200 bytes, which leaves room for the endings of its files. Beyond ASCII every
// character is taken for a letter but controls, spaces, punctuation and what is not seen; the page takes fewer.
bool is_project_name(const std::string& name);

}  // namespace qchopper
