// Two tables: a row per field, which writes and reads it, and a row per kind, which lists its fields. O(length of the
// text).

#include "devices/journal/journal_event.h"

#include <array>
#include <charconv>
#include <type_traits>

#include "base/hex.h"
#include "devices/wire/register_writer.h"

namespace qchopper {
namespace {

template <class Value>
concept Number = std::is_integral_v<Value> || std::is_enum_v<Value>;
template <Number Value>
constexpr std::uint64_t largest = sizeof(Value) == 2   ? 0xFFFF
                                  : sizeof(Value) == 4 ? 0xFFFFFFFF
                                                       : ~std::uint64_t{0};
template <>
constexpr std::uint64_t largest<StartOutcome> = static_cast<std::uint64_t>(StartOutcome::unknown);

std::string written(Number auto number) {
    return std::to_string(static_cast<std::uint64_t>(number));
}
std::string written(const Uuid& id) {
    return to_hex(std::span<const std::uint8_t>(id));
}
std::string written(const Sha256& digest) {
    return to_hex(digest);
}
std::string written(const std::vector<std::uint16_t>& registers) {
    return to_hex(std::span<const std::uint8_t>(bytes_of(registers)));
}

template <Number Value>
bool read(std::string_view text, Value& value) {
    std::uint64_t number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (fault != std::errc() || end != text.data() + text.size() || number > largest<Value>) return false;
    value = static_cast<Value>(number);
    return text == std::to_string(number);
}
bool read(std::string_view text, Uuid& id) {
    return read_hex(text, id);
}
bool read(std::string_view text, Sha256& digest) {
    return read_hex(text, digest.bytes);
}
bool read(std::string_view text, std::vector<std::uint16_t>& registers) {
    constexpr std::size_t max_registers = 125;
    if (text.size() % 4 != 0 || text.size() > 4 * max_registers) return false;
    std::vector<std::uint8_t> bytes(text.size() / 2);
    if (!read_hex(text, bytes)) return false;
    registers = RegisterWriter().bytes(bytes).registers();
    return true;
}

struct FieldRow {
    const char* name;
    std::string (*write)(const JournalEvent&);
    bool (*read)(std::string_view, JournalEvent&);
};

// `path`: a member of the event, or a member of the event and one of that.
template <auto... path>
constexpr FieldRow field(const char* name) {
    return {name, [](const JournalEvent& event) { return written((event.*....*path)); },
            [](std::string_view text, JournalEvent& event) { return read(text, (event.*....*path)); }};
}

namespace f {
constexpr FieldRow job = field<&JournalEvent::job_id>("job");
constexpr FieldRow sha256 = field<&JournalEvent::file_sha256>("sha256");
constexpr FieldRow ticket = field<&JournalEvent::ticket>("ticket");
constexpr FieldRow epoch = field<&JournalEvent::epoch>("epoch");
constexpr FieldRow seq = field<&JournalEvent::seq>("seq");
constexpr FieldRow owner = field<&JournalEvent::owner>("owner");
constexpr FieldRow secret = field<&JournalEvent::secret>("secret");
constexpr FieldRow command = field<&JournalEvent::command>("command");
constexpr FieldRow token = field<&JournalEvent::token>("token");
constexpr FieldRow receipt = field<&JournalEvent::receipt>("receipt");
constexpr FieldRow grant = field<&JournalEvent::grant>("grant");
constexpr FieldRow progress = field<&JournalEvent::progress>("progress");
constexpr FieldRow refusal = field<&JournalEvent::refusal>("refusal");
constexpr FieldRow state = field<&JournalEvent::job_state>("state");
constexpr FieldRow result = field<&JournalEvent::job_result>("result");
constexpr FieldRow starts = field<&JournalEvent::starts>("starts");
constexpr FieldRow start_outcome = field<&JournalEvent::start_outcome>("verdict");
constexpr FieldRow store = field<&JournalEvent::store, &SeenStore::store_id>("store");
constexpr FieldRow version = field<&JournalEvent::store, &SeenStore::version>("version");
constexpr FieldRow boots = field<&JournalEvent::store, &SeenStore::boot_count>("boots");
constexpr FieldRow held = field<&JournalEvent::store, &SeenStore::epoch_held>("held");
constexpr FieldRow total = field<&JournalEvent::store, &SeenStore::starts_total>("total");
constexpr FieldRow created_ms = field<&JournalEvent::created_ms>("created");
constexpr FieldRow started_ms = field<&JournalEvent::started_ms>("started");
constexpr FieldRow ended_ms = field<&JournalEvent::ended_ms>("ended");
constexpr FieldRow marks = field<&JournalEvent::marks>("marks");
constexpr FieldRow rows = field<&JournalEvent::rows>("rows");
constexpr FieldRow hash = field<&JournalEvent::file_sha256>("hash");
}  // namespace f

struct KindRow {
    JournalKind kind;
    const char* name;
    std::array<FieldRow, 9> fields;  // those without a name are not there
};
using Is = JournalKind;
constexpr std::array<KindRow, journal_kinds> kind_rows{{
    {Is::created, "CREATED", {f::job, f::sha256, f::ticket}},
    {Is::resumed, "RESUMED", {f::job}},
    {Is::identity, "IDENTITY", {f::store, f::version, f::boots, f::held, f::total}},
    {Is::claim, "CLAIM", {f::epoch, f::seq, f::owner, f::secret}},
    {Is::command, "COMMAND", {f::job, f::epoch, f::seq, f::owner, f::command}},
    {Is::start_intent, "START_INTENT", {f::job, f::epoch, f::seq, f::owner, f::token}},
    {Is::start_void, "START_VOID", {f::job}},
    {Is::started, "STARTED", {f::job, f::epoch}},
    {Is::receipt, "RECEIPT", {f::job, f::receipt}},
    {Is::progress, "PROGRESS", {f::job, f::progress}},
    {Is::refused, "REFUSED", {f::job, f::command, f::refusal}},
    {Is::result, "RESULT", {f::job, f::state, f::result, f::starts}},
    {Is::closed, "CLOSED", {f::job, f::start_outcome}},
    {Is::store_lost, "STORE_LOST", {f::store, f::version, f::boots, f::held, f::total}},
    {Is::store_accepted, "STORE_ACCEPTED", {f::store, f::version, f::boots, f::held, f::total}},
    {Is::granted, "GRANTED", {f::epoch, f::owner, f::grant}},
    {Is::exported,
     "EXPORTED",
     {f::job, f::sha256, f::ticket, f::result, f::start_outcome, f::marks, f::created_ms, f::started_ms, f::ended_ms}},
    {Is::head, "HEAD", {f::rows, f::hash, f::epoch, f::seq, f::owner, f::secret, f::grant, f::marks}},
}};

const KindRow& row_of(JournalKind kind) {
    return kind_rows[static_cast<std::size_t>(kind)];
}

std::string of_store(const JournalEvent& event) {
    const SeenStore& store = event.store;
    const std::string counters = "BOOT_COUNT " + std::to_string(store.boot_count) + ", EPOCH_HELD " +
                                 std::to_string(store.epoch_held) + ", STARTS_TOTAL " +
                                 std::to_string(store.starts_total);
    return "STORE_ID " + to_text(store.store_id) + ", " + counters;
}

}  // namespace

const char* name(JournalKind kind) {
    return row_of(kind).name;
}

std::optional<JournalKind> journal_kind_from(std::string_view text) {
    for (const KindRow& row : kind_rows) {
        if (text == row.name) return row.kind;
    }
    return std::nullopt;
}

std::string text_of(const JournalEvent& event) {
    std::string text;
    for (const FieldRow& field : row_of(event.kind).fields) {
        if (field.name == nullptr) break;
        if (!text.empty()) text += ' ';
        text += std::string(field.name) + "=" + field.write(event);
    }
    return text;
}

std::optional<JournalEvent> event_from(JournalKind kind, std::string_view text) {
    const std::string whole(text);
    JournalEvent event;
    event.kind = kind;
    for (const FieldRow& field : row_of(kind).fields) {
        if (field.name == nullptr) break;
        const std::string_view word = text.substr(0, text.find(' '));
        const std::string begin = std::string(field.name) + "=";
        if (!word.starts_with(begin) || !field.read(word.substr(begin.size()), event)) return std::nullopt;
        text.remove_prefix(word.size());
        if (!text.empty()) text.remove_prefix(1);
    }
    if (text_of(event) != whole) return std::nullopt;
    return event;
}

std::string describe(const JournalEvent& event) {
    const auto numbered = [&](const std::string& what) {
        return what + " (epoch " + std::to_string(event.epoch) + ", number " + std::to_string(event.seq) + ")";
    };
    switch (event.kind) {
        case Is::created:
            return "a job was made for the file " + to_hex(event.file_sha256).substr(0, 12);
        case Is::resumed:
            return "the job of an earlier dispatcher was taken up";
        case Is::identity:
            return "the cell showed " + of_store(event);
        case Is::claim:
            return numbered("about to send CLAIM");
        case Is::command:
            return numbered(std::string("about to send ") + name(event.command));
        case Is::start_intent:
            return numbered("about to send START");
        case Is::start_void:
            return "the START before had no effect and can have none any more";
        case Is::started:
            return "the cell has started the job";
        case Is::receipt:
            return "the rehearsal passed";
        case Is::progress:
            return "at " + std::to_string(event.progress / 100) + " %";
        case Is::refused:
            return std::string("the cell refused ") + name(event.command) + ": " + describe(event.refusal) + " (" +
                   name(event.refusal) + ")";
        case Is::result:
            return std::string("the cell reports the job as ") + name(event.job_state) + " (" + name(event.job_result) +
                   "), STARTS " + std::to_string(event.starts);
        case Is::closed:
            return std::string("the hand-off ended: ") + describe(event.start_outcome);
        case Is::store_lost:
            return "CELL_STORE_LOST: the cell showed " + of_store(event);
        case Is::store_accepted:
            return "the operator accepted the memory of the cell: " + of_store(event);
        case Is::granted:
            return "the cell granted epoch " + std::to_string(event.epoch) + " under the number " +
                   std::to_string(event.grant);
        case Is::exported:
            return "the rows of this job were exported and removed";
        case Is::head:
            return "the rows up to " + std::to_string(event.rows) +
                   " were exported and removed; the last one had the hash " + to_hex(event.file_sha256).substr(0, 12);
    }
    return {};
}

}  // namespace qchopper
