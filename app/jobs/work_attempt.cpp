// The name of a file has a random number: a process number comes again after a restart.

#include "app/jobs/work_attempt.h"

#include <unistd.h>

#include <algorithm>
#include <random>
#include <utility>

#include "base/enum_names.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/json_fields.h"
#include "base/process.h"
#include "segment/picture/png.h"

namespace qchopper {

namespace fs = std::filesystem;
using namespace json_values;

constexpr auto names_of(AttemptState) {
    return EnumNames<AttemptState, 3>{
        {{AttemptState::at_work, "at work"}, {AttemptState::made, "made"}, {AttemptState::failed, "failed"}}};
}

template <class V, Of<WorkAttempt> T>
void fields(V& v, T& attempt) {
    v.constant("format", "qchopper attempt", "is not a qchopper attempt");
    v.version("schema", 1);
    v("piece", attempt.piece);
    v("state", attempt.state);
    v("stage", attempt.stage);
    v("because", attempt.because);
    v("host", attempt.host);
    v("process", attempt.process);
    v("libraries", attempt.libraries);
    v("process_cpu_s", attempt.process_cpu_s, not_negative);
    v("process_bytes", attempt.process_bytes);
}

namespace {

constexpr std::chrono::seconds between_signs{5};
constexpr std::chrono::seconds between_stages{1};
constexpr double silent_s = 120;

}  // namespace

AttemptRecord::AttemptRecord(std::string piece, const std::string& result, const fs::path& attempts) {
    attempt_.piece = std::move(piece);
    attempt_.host = host_name();
    attempt_.process = static_cast<std::uint64_t>(::getpid());
    attempt_.libraries = png_libraries();
    std::error_code error;  // that it cannot be made is told by the first file
    fs::create_directories(attempts, error);
    file_ = attempts / (result + "-" + attempt_.host + "-" + std::to_string(attempt_.process) + "-" +
                        std::to_string(std::random_device{}()) + ".json");
    unfinished_.emplace(file_);
    write();
}

AttemptRecord::~AttemptRecord() {
    std::error_code error;
    if (attempt_.state == AttemptState::at_work) fs::remove(file_, error);
}

Context AttemptRecord::watched(const Context& context) {
    Context watched = context;
    watched.on_progress = [this, on_progress = context.on_progress](const Progress& progress) {
        const bool is_next = attempt_.stage != progress.what;
        attempt_.stage = progress.what;
        if (std::chrono::steady_clock::now() - written_ >= (is_next ? between_stages : between_signs)) write();
        if (on_progress) on_progress(progress);
    };
    return watched;
}

void AttemptRecord::end(AttemptState state, const std::string& because) {
    attempt_.state = state;
    attempt_.because = because;
    write();
    unfinished_.reset();
}

void AttemptRecord::write() {
    attempt_.process_cpu_s = cpu_seconds();
    attempt_.process_bytes = peak_memory();
    write_file(file_, to_document(attempt_));
    written_ = std::chrono::steady_clock::now();
}

std::vector<SeenAttempt> attempts_at(const std::string& result, const fs::path& attempts) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(attempts, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(result + "-") && entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<SeenAttempt> seen;
    for (const fs::path& file : files) {
        SeenAttempt own;
        try {
            const Bytes bytes = read_file(file, record_limit);
            from_document({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, own.attempt);
        } catch (const std::runtime_error&) {
            continue;
        }
        const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, error);
        own.age_s = error ? 0 : std::max(0.0, std::chrono::duration<double>(age).count());
        const bool is_here = own.attempt.host == host_name();
        own.has_ended = own.attempt.state != AttemptState::at_work ||
                        (is_here ? has_process_ended(static_cast<long>(own.attempt.process)) : own.age_s > silent_s);
        seen.push_back(std::move(own));
    }
    return seen;
}

std::size_t failures(const std::vector<SeenAttempt>& attempts) {
    return static_cast<std::size_t>(std::ranges::count_if(
        attempts, [](const SeenAttempt& own) { return own.has_ended && own.attempt.state != AttemptState::made; }));
}

}  // namespace qchopper
