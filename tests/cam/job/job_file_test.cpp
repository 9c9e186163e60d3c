#include "cam/job/read_job.h"
#include "cam/job/write_job.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "base/error.h"
#include "base/files/zip.h"
#include "segment/io/read_mesh.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

std::string refusal(const Bytes& bytes) {
    try {
        parse_job(bytes, "AB.qjob");
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        EXPECT_EQ(std::string(error.what()).find("AB.qjob"), 0U) << error.what();
        return error.what();
    }
    return "taken";
}

// Packed, after the sizes and hashes in the manifest are made to agree.
Bytes agreeing(std::map<std::string, Bytes> files) {
    auto manifest = nlohmann::ordered_json::parse(text_of(files["manifest.json"]));
    for (auto& entry : manifest["files"]) {
        const Bytes& bytes = files[entry["name"].get<std::string>()];
        entry["size"] = bytes.size();
        entry["sha256"] = to_hex(sha256(bytes));
    }
    const std::string listed = manifest.dump(2) + "\n";
    files["manifest.json"] = {listed.begin(), listed.end()};
    return zip(files);
}

// With a few bytes in place of each picture, which no reader looks into: quicker to hash.
Bytes small_job_file(const JobInput& input) {
    std::map<std::string, Bytes> files = unzip(job_file(input), "AB.qjob");
    for (const char* name : {"setup-1.png", "setup-2.png"}) files[name] = {0x89, 'P', 'N', 'G'};
    return agreeing(std::move(files));
}

using Change = std::function<void(nlohmann::ordered_json&)>;

// The job file with one of its files changed; if it is not the manifest, the manifest is made to agree.
Bytes forged(std::map<std::string, Bytes> files, const std::string& name, const Change& change) {
    auto json = nlohmann::ordered_json::parse(text_of(files[name]));
    change(json);
    const std::string text = json.dump(2) + "\n";
    files[name] = {text.begin(), text.end()};
    return name == "manifest.json" ? zip(files) : agreeing(std::move(files));
}

Bytes forged(const std::string& name, const Change& change) {
    static const std::map<std::string, Bytes> sound = unzip(small_job_file(tilting_job(3)), "AB.qjob");
    return forged(sound, name, change);
}

TEST(Job, SameInputSameBytesWhateverTimeAndTimeZone) {
    const Bytes first = job_file(some_job());
    setenv("TZ", "Pacific/Kiritimati", 1);
    tzset();
    const std::timespec a_tick{1, 100'000'000};  // a clock that went in would show by now
    nanosleep(&a_tick, nullptr);
    const Bytes second = job_file(some_job());
    unsetenv("TZ");
    tzset();
    EXPECT_EQ(first, second);
}

TEST(Job, WhatIsReadIsWhatWasWritten) {
    const JobInput input = some_job();
    const Bytes bytes = job_file(input);
    const ReadJob job = parse_job(bytes, "AB.qjob");
    EXPECT_EQ(job.piece, "AB");
    EXPECT_EQ(job.piece_no, 2);
    EXPECT_EQ(job.piece_count, 5);
    EXPECT_EQ(job.cell_id, input.cell.id);
    EXPECT_EQ(job.program_version, "0.1.0");
    EXPECT_EQ(job.project_id, input.project_id);
    EXPECT_EQ(job.scan_sha256, input.scan_sha256);
    EXPECT_EQ(job.setup, input.setup);
    EXPECT_EQ(job.half_spaces, input.piece.half_spaces);
    EXPECT_EQ(job.stock_fit, input.stock_fit);
    EXPECT_EQ(job.block_name, input.cell.stock[input.setup.block.stock].name);
    EXPECT_EQ(job.faces, input.piece.mesh->triangles.size());
    EXPECT_EQ(job.volume_mm3, volume_mm3(*input.piece.mesh));
    EXPECT_EQ(job.ticket, ticket_template(input));
    EXPECT_EQ(job.file_size, bytes.size());
    EXPECT_EQ(job.file_sha256, sha256(bytes));
    std::vector<std::string> names;
    for (const JobEntry& entry : job.entries) {
        names.push_back(entry.name);
        EXPECT_EQ(entry.sha256, sha256(job.files.at(entry.name)));
    }
    const std::vector<std::string> listed{"details.html", "envelope.json", "piece.stl",  "preview.glb",
                                          "setup-1.png",  "setup-2.png",   "setup.html", "ticket.json"};
    EXPECT_EQ(names, listed);
}

TEST(Job, WhatTheToolReachesIsReadBack) {
    JobInput input = tilting_job();
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_EQ(job.setup, input.setup);
    EXPECT_TRUE(job.setup.access.further);
    EXPECT_EQ(job.max_unreachable, 0.02);
    EXPECT_TRUE(is_unreachable(job.setup, job.max_unreachable));
    const std::vector<Alternative> others{
        {1, "without a cap, lying on its side", AccessMethod::mapped, 0.225, 12345, 890, {58, 56, 44}, 2},
        {3, "without a cap, lying on its side", AccessMethod::sampled, 0.225, 12345, 890, {58, 56, 44}, 2}};
    EXPECT_EQ(job.alternatives, others);
    const auto manifest = nlohmann::json::parse(text_of(job.files.at("manifest.json")));
    EXPECT_EQ(manifest["schema"], 8);
    EXPECT_EQ(manifest["state"], "unreachable");
    EXPECT_EQ(manifest["setup"]["reach"]["method"], "mapped");
    EXPECT_EQ(manifest["setup"]["reach"]["unreachable_share"], 0.05);
}

TEST(Job, AShareAtTheLimitIsReady) {
    JobInput input = tilting_job(3);
    input.max_unreachable = input.setup.access.unreachable_share();
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_EQ(nlohmann::json::parse(text_of(job.files.at("manifest.json")))["state"], "ready");
    EXPECT_FALSE(is_unreachable(job.setup, job.max_unreachable));
}

TEST(Job, WhatDoesNotCountDoesNotMakeItUnreachable) {
    SurfaceAccess access = some_access(some_job(3));
    EXPECT_EQ(access.unreachable_mm2(), 100);
    access.steep_counts = false;
    EXPECT_EQ(access.unreachable_mm2(), 80);
    access.narrow_counts = true;
    EXPECT_EQ(access.unreachable_mm2(), 124);
}

TEST(Job, ThePieceLiesInTheFileAsInTheSetup) {
    const JobInput input = some_job();
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    const TriangleMesh read = parse_mesh(job.files.at("piece.stl"), "piece.stl").mesh;
    EXPECT_EQ(read.triangles.size(), input.piece.mesh->triangles.size());
    const Box box = bounds(read);
    EXPECT_LT(norm(box.min - input.setup.box.min), 1e-4);
    EXPECT_LT(norm(box.max - input.setup.box.max), 1e-4);
    EXPECT_NEAR(volume_mm3(read), volume_mm3(*input.piece.mesh), 1e-5 * volume_mm3(read)) << "turned, not mirrored";
}

TEST(Job, TicketSpeaksOfTheFile) {
    const auto folder = std::filesystem::temp_directory_path() / ("qjob." + std::to_string(::getpid()));
    std::filesystem::create_directory(folder);
    const JobInput input = some_job();
    const Bytes bytes = job_file(input);
    const auto path = folder / job_file_name(input.piece.name);
    write_file(path, bytes);
    const ReadJob job = parse_job(read_job(path), path.string());
    const JobTicket ticket = job_ticket(job, path.filename().string());
    EXPECT_THROW(job_ticket(job, "no good name.qjob"), InputError);
    std::filesystem::remove_all(folder);
    EXPECT_THROW(read_job(path), InputError) << "missing by now";
    EXPECT_EQ(ticket.file_name, "AB.qjob");
    EXPECT_EQ(ticket.file_size, bytes.size());
    EXPECT_EQ(ticket.file_sha256, sha256(bytes));
    EXPECT_EQ(ticket.about, ticket_template(input));
    EXPECT_EQ(ticket.about.base_plane, 4);
    EXPECT_EQ(ticket.about.stock, input.setup.block.size);
}

TEST(Job, TheEstimateIsFoamOverRemovalRate) {
    const JobInput input = some_job();
    const Vec3 block = input.setup.block.size;
    const double foam = block.x * block.y * block.z - volume_mm3(*input.piece.mesh);
    EXPECT_EQ(ticket_template(input).estimated_time_s, static_cast<std::uint32_t>(foam / 24000) + 1);
}

TEST(Job, ACutOffFileIsRefusedAtEveryLength) {
    const Bytes bytes = small_job_file(some_job(3));
    for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 300) {
        EXPECT_NE(refusal(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length))), "taken")
            << length;
    }
}

// Dates and rights too: what does not describe the job has only one form.
TEST(Job, EveryDamagedByteIsFound) {
    const Bytes bytes = small_job_file(some_job(3));
    std::mt19937 random(3);
    for (std::size_t at = 0; at < bytes.size(); at += 1 + random() % 5) {
        Bytes damaged = bytes;
        damaged[at] ^= static_cast<std::uint8_t>(1 + random() % 255);
        EXPECT_NE(refusal(damaged), "taken") << at;
    }
}

// The same content in another form is another file: only the form that job_file writes is taken.
TEST(Job, TheTextsInsideHaveOneForm) {
    const std::map<std::string, Bytes> files = unzip(job_file(some_job()), "AB.qjob");
    const auto with = [&](const std::function<std::string(std::string)>& change) {
        auto changed = files;
        const std::string text = change(text_of(files.at("manifest.json")));
        changed["manifest.json"] = {text.begin(), text.end()};
        return refusal(zip(changed));
    };
    const auto compact = [](const std::string& text) { return nlohmann::ordered_json::parse(text).dump(); };
    EXPECT_NE(with(compact).find("the one form"), std::string::npos) << with(compact);
    EXPECT_NE(with([](const std::string& text) { return text + " "; }).find("the one form"), std::string::npos);
    const auto twice = [](const std::string& text) { return "{\n  \"schema\": 8," + text.substr(1); };
    EXPECT_NE(with(twice).find("the one form"), std::string::npos) << with(twice);
    const auto huge = [](std::string text) {
        return text.replace(text.find("\"schema\": 8"), 11, "\"schema\": 1e999");
    };
    EXPECT_NE(with(huge).find("out of range"), std::string::npos) << with(huge);
    const auto deep = [](const std::string&) { return std::string(5'000'000, '['); };
    EXPECT_NE(with(deep), "taken");
    const auto cut = [](const std::string& text) { return text.substr(0, text.size() / 2); };
    EXPECT_NE(with(cut).find("is not JSON from byte"), std::string::npos) << with(cut);
    for (const auto& change : {std::function<std::string(std::string)>(compact), {twice}, {huge}, {deep}, {cut}}) {
        EXPECT_EQ(with(change).find("json.exception"), std::string::npos) << "a message of the library";
    }
}

// Any value of another kind in any place is refused by us or does not matter; nothing else comes out.
TEST(Job, AnyValueOfAnotherKindEndsInOneWay) {
    using Json = nlohmann::ordered_json;
    const std::vector<Json> others{nullptr, true, -1, 0, 4294967296ULL, 1e300, "text", Json::array(), Json::object()};
    for (const char* name : {"manifest.json", "ticket.json", "envelope.json"}) {
        const std::map<std::string, Bytes> files = unzip(job_file(some_job()), "AB.qjob");
        const Json places = Json::parse(text_of(files.at(name))).flatten();
        for (const auto& [place, old] : places.items()) {
            for (std::string at = place; !at.empty(); at.resize(at.rfind('/'))) {
                for (const Json& other : others)
                    refusal(forged(name, [&](Json& j) { j[Json::json_pointer(at)] = other; }));
            }
        }
    }
}

TEST(Job, ForgedManifestsAreRefusedAndSayWhere) {
    using Json = nlohmann::ordered_json;
    const std::vector<std::pair<std::function<void(Json&)>, std::string>> cases{
        {[](Json& j) { j["schema"] = 7; }, "schema 7 is not 8, the one that this program reads"},
        {[](Json& j) { j["format"] = "other"; }, "format"},
        {[](Json& j) { j.erase("piece"); }, "piece is missing"},
        {[](Json& j) { j["piece"]["number"] = 70000; }, "number is not a whole number"},
        {[](Json& j) { j["piece"]["number"] = -1; }, "number is not a whole number"},
        {[](Json& j) { j["piece"]["number"] = 0; }, "number is not one of 1 to count"},
        {[](Json& j) { j["piece"]["number"] = 6; }, "number is not one of 1 to count"},
        {[](Json& j) { j["cell"]["id"] = 0; }, "id is the number of no cell"},
        {[](Json& j) { j["half_spaces"] = nullptr; }, "half_spaces is not a list"},
        {[](Json& j) { j["piece"]["volume_mm3"] = "much"; }, "volume_mm3"},
        {[](Json& j) { j["scan_sha256"] = "00"; }, "scan_sha256 is not 64"},
        {[](Json& j) {
             j["setup"]["piece_in_setup"]["rows"][2] = {0, 0, -1};
         },
         "not a rotation"},
        {[](Json& j) {
             j["setup"]["box"]["max"] = {1, 2};
         },
         "max is not three numbers"},
        {[](Json& j) { j["setup"]["box"]["max"][0] = 1; }, "different jobs"},
        {[](Json& j) { j["stock_fit"]["fits"] = false; }, "contradicts"},
        {[](Json& j) { j["state"] = "ready"; }, "state contradicts the unreachable share and its limit"},
        {[](Json& j) { j["state"] = "maybe"; }, "state contradicts the unreachable share and its limit"},
        {[](Json& j) { j["max_unreachable"] = 0.9; }, "state contradicts the unreachable share and its limit"},
        {[](Json& j) { j["max_unreachable"] = 1.5; }, "max_unreachable"},
        {[](Json& j) { j["setup"]["reach"]["hidden_mm2"] = 1; }, "unreachable_share is not that of the areas"},
        {[](Json& j) { j["setup"]["reach"]["hidden_mm2"] = -1; }, "hidden_mm2"},
        {[](Json& j) { j["setup"]["workholding"]["passes"] = false; }, "passes contradicts the forces"},
        {[](Json& j) { j["setup"]["workholding"]["joint_force_n"] = 3; }, "passes contradicts the forces"},
        {[](Json& j) { j["setup"]["workholding"]["base_width"] = -1; }, "base_width"},
        {[](Json& j) { j["setup"]["reach"]["method"] = "guessed"; }, "method is neither sampled nor mapped"},
        {[](Json& j) {
             j["setup"]["reach"]["orientations"][1]["tool_axis"] = {1, 2, 3};
         },
         "tool_axis is not of length 1"},
        {[](Json& j) { j["setup"]["reach"]["further"].erase("tilt_deg"); }, "tilt_deg is missing"},
        {[](Json& j) { j["setup"]["reach"].erase("further"); }, "further is missing"},
        {[](Json& j) { j["setup"].erase("base_number"); }, "base_number is missing"},
        {[](Json& j) { j["setup"]["spoil"] = -1; }, "spoil"},
        {[](Json& j) { j["setup"]["placement"]["x_mm"] = 5; }, "different jobs"},
        {[](Json& j) { j["setup"]["placement"]["table_angles_deg"] = {0.5}; }, "table_angles_deg is not one per"},
        {[](Json& j) { j["setup"]["setup_in_cell"] = Json::array(); }, "setup_in_cell is not one per angle"},
        {[](Json& j) {
             j["setup"]["setup_in_cell"][0]["rows"][2] = {0, 0, -1};
         },
         "setup_in_cell is not a rotation"},
        {[](Json& j) { j["work_envelope"]["holds"] = false; }, "different jobs"},
        {[](Json& j) { j["work_envelope"].erase("arm_checked"); }, "arm_checked is missing"},
        {[](Json& j) { j["stock"]["offcuts_mm"][0] = 3; }, "offcuts_mm is not three numbers"},
        {[](Json& j) { j["alternatives"][0]["base_number"] = -1; }, "base_number is not a whole number"},
        {[](Json& j) { j["stock_fit"]["margins"] = Json::array(); }, "margins is empty"},
        {[](Json& j) { j["files"][0]["sha256"] = std::string(64, '0'); }, "details.html does not match its SHA-256"},
        {[](Json& j) { j["files"][0]["size"] = 1; }, "details.html has another size"},
        {[](Json& j) { j["files"][0]["name"] = "../piece.stl"; }, "../piece.stl is missing"},
        {[](Json& j) { j["files"].erase(0); }, "lists other files"},
        {[](Json& j) { j = Json::array(); }, "manifest.json"},
        {[](Json& j) { j["files"] = 3; }, "files is not a list"},
    };
    for (const auto& [change, word] : cases) {
        const std::string why = refusal(forged("manifest.json", change));
        EXPECT_NE(why.find(word), std::string::npos) << word << " <- " << why;
    }
}

TEST(Job, FacesOfTheBlockThatAreSawnAreReadBack) {
    const JobInput input = sawn_job();
    ASSERT_TRUE(input.setup.base);
    ASSERT_EQ(input.setup.flush_caps.size(), 1U);
    EXPECT_GT(input.setup.milled_caps_mm2, 0);
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_EQ(job.setup, input.setup);
    ASSERT_EQ(job.foam_at_faces.size(), block_faces);
    for (std::size_t f = 0; f < block_faces; ++f) {
        const bool is_flush = f == static_cast<std::size_t>(input.setup.flush_caps[0].face);
        EXPECT_NEAR(job.foam_at_faces[f], is_flush ? 0 : job.foam_at_faces[f], 0.05) << f;
        EXPECT_TRUE(is_flush || job.foam_at_faces[f] > 1) << f;
    }
    EXPECT_TRUE(parse_job(job_file(some_job()), "AB.qjob").foam_at_faces.empty()) << "where nothing is sawn";
}

TEST(Job, FlushCapsThatAreNoneOfThePieceAreRefused) {
    using Json = nlohmann::ordered_json;
    const JobInput input = sawn_job();
    const std::map<std::string, Bytes> sound = unzip(small_job_file(input), "AB.qjob");
    const auto own = static_cast<std::size_t>(input.setup.flush_caps.at(0).face);
    const std::size_t other = own ^ 1U;
    ASSERT_LT(other, 4U) << "a side";
    const std::string other_face = names_of(BlockFace{})(static_cast<BlockFace>(other));
    const std::vector<std::pair<Change, std::string>> cases{
        {[](Json& j) { j["setup"]["flush_caps"][0]["cut"] = 77; }, "flush_caps name cut 77, which has no such cap"},
        {[&](Json& j) { j["setup"]["flush_caps"][0]["cut"] = *input.setup.base; }, "which has no such cap"},
        {[](Json& j) { j["setup"]["flush_caps"][0]["cut"] = -1; }, "cut"},
        {[](Json& j) { j["setup"]["flush_caps"][0]["face"] = "underside"; }, "face"},
        {[](Json& j) { j["setup"]["flush_caps"][0]["area_mm2"] = -1; }, "area_mm2"},
        {[](Json& j) { j["setup"]["flush_caps"][0].erase("area_mm2"); }, "area_mm2 is missing"},
        {[](Json& j) { j["setup"]["flush_caps"].push_back(j["setup"]["flush_caps"][0]); }, "flush_caps"},
        {[](Json& j) { j["setup"].erase("flush_caps"); }, "foam_at_faces_mm contradicts flush_caps"},
        {[](Json& j) { j["stock"].erase("foam_at_faces_mm"); }, "foam_at_faces_mm contradicts flush_caps"},
        {[](Json& j) { j["stock"]["foam_at_faces_mm"].erase(0); }, "foam_at_faces_mm is not one number for each face"},
        {[&](Json& j) { std::swap(j["stock"]["foam_at_faces_mm"][own], j["stock"]["foam_at_faces_mm"][other]); },
         "foam_at_faces_mm contradicts block, box and flush_caps"},
        {[](Json& j) { j["stock"]["foam_at_faces_mm"][4] = 1; },
         "foam_at_faces_mm contradicts block, box and flush_caps"},
        {[&](Json& j) { j["setup"]["flush_caps"][0]["face"] = other_face; },
         "foam_at_faces_mm contradicts block, box and flush_caps"},
        {[](Json& j) { j["setup"]["milled_caps_mm2"] = -1; }, "milled_caps_mm2"},
    };
    EXPECT_EQ(refusal(forged(sound, "manifest.json", [](Json&) {})), "taken");
    for (const auto& [change, word] : cases) {
        const std::string why = refusal(forged(sound, "manifest.json", change));
        EXPECT_NE(why.find(word), std::string::npos) << word << " <- " << why;
    }
}

TEST(Job, ForgedTicketsAreRefused) {
    using Json = nlohmann::ordered_json;
    EXPECT_NE(refusal(forged("ticket.json", [](Json& j) { j["material"] = "gold"; })).find("material"),
              std::string::npos);
    EXPECT_NE(refusal(forged("ticket.json", [](Json& j) { j["piece"] = "C"; })).find("different jobs"),
              std::string::npos);
    EXPECT_NE(refusal(forged("ticket.json", [](Json& j) { j["tool_diameter"] = 1e10; })).find("tool_diameter"),
              std::string::npos);
    EXPECT_NE(refusal(forged("ticket.json", [](Json& j) { j["box"]["max"][0] = 1e10; })).find("box is out of range"),
              std::string::npos);
    EXPECT_EQ(refusal(forged("ticket.json", [](Json&) {})), "taken") << "forging without a change changes nothing";
}

TEST(Job, MissingAndForeignFilesAreRefused) {
    const std::map<std::string, Bytes> files = unzip(job_file(some_job()), "AB.qjob");
    for (const auto& [name, bytes] : files) {
        auto fewer = files;
        fewer.erase(name);
        EXPECT_NE(refusal(zip(fewer)), "taken") << name;
    }
    auto more = files;
    more["run.me"] = {1, 2, 3};
    EXPECT_NE(refusal(zip(more)).find("lists other files"), std::string::npos);
}

TEST(Job, NamesThatTheWireCannotCarryAreRefused) {
    EXPECT_EQ(job_file_name("AZ"), "AZ.qjob");
    EXPECT_EQ(job_file_name(std::string(27, 'A')).size(), 32U);
    for (const std::string& name : {std::string(), std::string(28, 'A'), std::string("a b"), std::string("../A")}) {
        EXPECT_THROW(job_file_name(name), InputError) << name;
    }
}

TEST(Job, ACutNumberThatNoTicketHoldsIsRefused) {
    JobInput input = some_job();
    input.setup.base = 65535;
    EXPECT_THROW(job_file(input), InputError);
}

TEST(Job, APieceWithoutBaseSaysSo) {
    JobInput input = some_job();
    input.piece = uncut(shapes::ball({0, 0, 0}, 10, 6));
    input.setup = choose_setup(input.piece, input.cell).setups.front();
    const ReadJob job = parse_job(job_file(input), "A.qjob");
    EXPECT_EQ(job.setup.base, std::nullopt);
    EXPECT_EQ(job.ticket.base_plane, no_base_plane);
}

}  // namespace
}  // namespace qchopper
