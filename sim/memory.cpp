#include "sim/memory.h"

#include <nlohmann/json.hpp>

#include "segment/error.h"

namespace qchopper {
namespace {

using Json = nlohmann::json;

constexpr int schema = 1;

template <std::size_t N>
std::string hex(const std::array<std::uint8_t, N>& bytes) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += digits[byte >> 4U];
        text += digits[byte & 0xFU];
    }
    return text;
}

// Throws std::invalid_argument, caught below.
template <std::size_t N>
std::array<std::uint8_t, N> unhex(const std::string& text) {
    std::array<std::uint8_t, N> bytes{};
    if (text.size() != 2 * N || text.find_first_not_of("0123456789abcdef") != std::string::npos) {
        throw std::invalid_argument("'" + text + "' is not an id");
    }
    for (std::size_t i = 0; i < N; ++i) {
        bytes[i] = static_cast<std::uint8_t>(std::stoul(text.substr(2 * i, 2), nullptr, 16));
    }
    return bytes;
}

Json to_json(const JobRecord& record) {
    return {{"state", static_cast<unsigned>(record.state)},
            {"result", static_cast<unsigned>(record.result)},
            {"starts", record.starts},
            {"start_epoch", record.start_epoch},
            {"start_seq", record.start_seq},
            {"start_time_ms", record.start_time_ms},
            {"end_time_ms", record.end_time_ms},
            {"file_sha256", hex(record.file_sha256)},
            {"last_block", record.last_block}};
}

JobRecord record_from(const Json& json) {
    JobRecord record;
    record.state = static_cast<JobState>(json.at("state").get<std::uint16_t>());
    record.result = static_cast<JobResult>(json.at("result").get<std::uint16_t>());
    json.at("starts").get_to(record.starts);
    json.at("start_epoch").get_to(record.start_epoch);
    json.at("start_seq").get_to(record.start_seq);
    json.at("start_time_ms").get_to(record.start_time_ms);
    json.at("end_time_ms").get_to(record.end_time_ms);
    record.file_sha256 = unhex<32>(json.at("file_sha256").get<std::string>());
    json.at("last_block").get_to(record.last_block);
    return record;
}

}  // namespace

std::string to_json(const CellMemory& memory) {
    Json jobs = Json::object();
    for (const auto& [id, record] : memory.jobs) jobs[hex(id)] = to_json(record);
    const Json all = {{"schema", schema},
                      {"boot_count", memory.boot_count},
                      {"epoch_held", memory.epoch_held},
                      {"starts_total", memory.starts_total},
                      {"jobs", jobs}};
    return all.dump(1) + "\n";
}

CellMemory load_memory(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error) && !error) return {};
    const Bytes bytes = read_file(file);
    try {
        const Json json = Json::parse(bytes.begin(), bytes.end());
        if (json.at("schema").get<int>() != schema) throw std::invalid_argument("another schema");
        CellMemory memory;
        json.at("boot_count").get_to(memory.boot_count);
        json.at("epoch_held").get_to(memory.epoch_held);
        json.at("starts_total").get_to(memory.starts_total);
        for (const auto& [id, record] : json.at("jobs").items()) memory.jobs[unhex<16>(id)] = record_from(record);
        return memory;
    } catch (const std::exception& fault) {
        throw InputError(InputFault::config,
                         "the memory of the simulated cell, " + file.string() + ", cannot be read: " + fault.what(),
                         "Give another store folder, or delete the file if no dispatcher may rely on it any more.");
    }
}

void save_memory(const std::filesystem::path& file, const CellMemory& memory) {
    write_file(file, to_json(memory));
}

}  // namespace qchopper
