// JSON by nlohmann::json, with a SHA-256 over the text before the key "sha256" is added. Reading parses the text,
// writes it again and compares: O(bytes), three times the text in memory.

#include "sim/cell/memory.h"

#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/error.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

using Json = nlohmann::json;

constexpr int schema = 4;

// Throws std::invalid_argument, caught below.
template <std::size_t N>
std::array<std::uint8_t, N> id_from(const std::string& text) {
    const auto id = from_hex<N>(text);
    if (!id) throw std::invalid_argument("'" + text + "' is not an id");
    return *id;
}

// Whether it was written so is compared at the end.
std::uint32_t number_from(const std::string& text) {
    std::uint32_t number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (fault != std::errc() || end != text.data() + text.size()) throw std::invalid_argument("no number");
    return number;
}

// The value of a key. nlohmann::json would convert a number of another kind or range without an error.
template <class Whole>
Whole whole(const Json& object, const char* key) {
    const Json& value = object.at(key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<Whole>::max()) {
        throw std::invalid_argument(std::string(key) + " is no whole number in bounds");
    }
    return value.get<Whole>();
}

Json to_json(const JobRecord& record) {
    return {{"state", static_cast<unsigned>(record.state)},
            {"result", static_cast<unsigned>(record.result)},
            {"starts", record.starts},
            {"start_epoch", record.start_epoch},
            {"start_seq", record.start_seq},
            {"start_time_ms", record.start_time_ms},
            {"end_time_ms", record.end_time_ms},
            {"file_sha256", to_hex(record.file_sha256)},
            {"last_block", record.last_block}};
}

JobRecord record_from(const Json& json) {
    JobRecord record;
    record.state = static_cast<JobState>(whole<std::uint16_t>(json, "state"));
    record.result = static_cast<JobResult>(whole<std::uint16_t>(json, "result"));
    record.starts = whole<std::uint32_t>(json, "starts");
    record.start_epoch = whole<std::uint32_t>(json, "start_epoch");
    record.start_seq = whole<std::uint32_t>(json, "start_seq");
    record.start_time_ms = whole<std::uint64_t>(json, "start_time_ms");
    record.end_time_ms = whole<std::uint64_t>(json, "end_time_ms");
    record.file_sha256.bytes = id_from<32>(json.at("file_sha256").get<std::string>());
    record.last_block = whole<std::uint32_t>(json, "last_block");
    if (record.state > JobState::cancelled || record.result > JobResult::rehearsal_failed) {
        throw std::invalid_argument("a job has a state or a result that is not defined");
    }
    return record;
}

CellMemory from_text(std::string_view text) {
    const Json json = Json::parse(text);
    if (whole<std::uint16_t>(json, "schema") != schema) throw std::invalid_argument("another schema");
    CellMemory memory;
    memory.store_id = id_from<16>(json.at("store_id").get<std::string>());
    memory.store_created_ms = whole<std::uint64_t>(json, "store_created_ms");
    memory.mark = whole<std::uint64_t>(json, "mark");
    for (const auto& [number, epoch] : json.at("grants").items()) {
        memory.grants[number_from(number)] = epoch.get<std::uint32_t>();
    }
    memory.boot_count = whole<std::uint32_t>(json, "boot_count");
    memory.epoch_held = whole<std::uint32_t>(json, "epoch_held");
    memory.starts_total = whole<std::uint32_t>(json, "starts_total");
    for (const auto& [id, record] : json.at("jobs").items()) memory.jobs[id_from<16>(id)] = record_from(record);
    // Compares the checksum as well.
    if (to_json(memory) != text) throw std::invalid_argument("it is not, to the last byte, what a cell wrote");
    return memory;
}

}  // namespace

std::string to_json(const CellMemory& memory) {
    Json jobs = Json::object();
    for (const auto& [id, record] : memory.jobs) jobs[to_hex(id)] = to_json(record);
    Json grants = Json::object();
    for (const auto& [number, epoch] : memory.grants) grants[std::to_string(number)] = epoch;
    Json all = {{"schema", schema},
                {"store_id", to_hex(memory.store_id)},
                {"store_created_ms", memory.store_created_ms},
                {"mark", memory.mark},
                {"grants", std::move(grants)},
                {"boot_count", memory.boot_count},
                {"epoch_held", memory.epoch_held},
                {"starts_total", memory.starts_total},
                {"jobs", std::move(jobs)}};
    const std::string text = all.dump(1);
    all["sha256"] = to_hex(sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    return all.dump(1) + "\n";
}

CellMemory memory_from_json(std::string_view text, const std::string& name) {
    const auto refuse = [&](const std::string& why) {
        throw InputError(InputFault::config, "the memory of the simulated cell, " + name + ", cannot be used: " + why,
                         "Give another store folder, or delete the file if no dispatcher may rely on it any more.");
    };
    try {
        return from_text(text);
    } catch (const Json::exception&) {  // its text is about the library
        refuse("it is no JSON, or a value is missing");
    } catch (const std::invalid_argument& fault) {
        refuse(fault.what());
    }
    return {};
}

CellMemory load_memory(const std::filesystem::path& file) {
    std::error_code error;
    const bool is_new = std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::not_found;
    if (is_new) return {};
    const Bytes bytes = read_file(file, record_limit);
    return memory_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

void save_memory(const std::filesystem::path& file, const CellMemory& memory) {
    write_file(file, to_json(memory));
}

SaveMarks load_marks(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    SaveMarks marks;
    try {
        const Bytes bytes = read_file(file, record_limit);
        const Json json = Json::parse(bytes.begin(), bytes.end());
        marks = {whole<std::uint64_t>(json, "last"), whole<std::uint64_t>(json, "next")};
    } catch (const InputError&) {
        return {};
    } catch (const Json::exception&) {
        return {};
    } catch (const std::invalid_argument&) {
        return {};
    }
    return marks;
}

void save_marks(const std::filesystem::path& file, const SaveMarks& marks) {
    write_file(file, Json{{"schema", 1}, {"last", marks.last}, {"next", marks.next}}.dump(1) + "\n");
}

}  // namespace qchopper
