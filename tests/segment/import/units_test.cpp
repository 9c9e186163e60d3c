// The unit of a scan: from the file or from the operator, never guessed; if both give one they must agree.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "segment/import/import_scan.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"
#include "tests/segment/io/wrappings.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});

class Units : public testing::Test {
 protected:
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    // The size of the scan in mm.
    Vec3 size(const Bytes& bytes, std::optional<double> mm_per_unit) {
        write_file(folder / "scan", bytes);
        ImportOptions options;
        options.mm_per_unit = mm_per_unit;
        return bounds(import_scan(folder / "scan", options).mesh).size();
    }

    // The message with which it is refused as wrong use.
    std::string refused(const Bytes& bytes, std::optional<double> mm_per_unit) {
        try {
            size(bytes, mm_per_unit);
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::use) << error.what();
            return error.what() + std::string(". To do: ") + error.to_do.text;
        }
        ADD_FAILURE() << "nothing was refused";
        return {};
    }

    const fs::path folder = fs::temp_directory_path() / ("units_test." + std::to_string(::getpid()));
    const Bytes ply = to_ply(box);
    const Bytes gltf = bytes_of(gltf_of(box));  // metres
    const Bytes inches =
        package_3mf({{"3D/a.model", model_3mf(object_3mf(box, 1), "<item objectid=\"1\"/>", "unit=\"inch\"")}});
    const Bytes no_word = package_3mf({{"3D/a.model", model_3mf(object_3mf(box, 1), "<item objectid=\"1\"/>")}});
};

TEST_F(Units, AScanWithoutOneNeedsOne) {
    EXPECT_EQ(size(ply, 10), (Vec3{10, 20, 30}));
    const std::string what = refused(ply, {});
    EXPECT_NE(
        what.find("PLY, binary little-endian, which has no unit. To do: give the unit of the scan: mm, cm, m or in"),
        std::string::npos)
        << what;
    EXPECT_NE(refused(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {}).find("OBJ, which has no unit"),
              std::string::npos);
}

TEST_F(Units, TheFilesOwnIsTaken) {
    EXPECT_EQ(size(gltf, {}), (Vec3{1000, 3000, 2000}));
    EXPECT_EQ(size(inches, {}), (Vec3{25.4, 50.8, 3 * 25.4}));
    EXPECT_EQ(size(no_word, {}), (Vec3{1, 2, 3}));  // 3MF: millimetres unless the file has another unit
}

TEST_F(Units, TheSameAsThatOfTheFileIsAccepted) {
    EXPECT_EQ(size(gltf, 1000), size(gltf, {}));
    EXPECT_EQ(size(inches, 25.4), size(inches, {}));
}

TEST_F(Units, AnotherThanThatOfTheFileIsRefused) {
    EXPECT_NE(refused(gltf, 1).find("has the unit m, but it is to be read in mm"), std::string::npos);
    EXPECT_NE(refused(inches, 1000).find("has the unit in, but it is to be read in m"), std::string::npos);
    EXPECT_NE(refused(no_word, 25.4).find("has the unit mm, but it is to be read in in"), std::string::npos);
}

// A project identifies its scan by this hash, so it must depend on every file of the scan.
TEST_F(Units, TheHashOfAScanCoversTheFilesBesideIt) {
    std::string json = gltf_of(box);
    const std::size_t begin = json.find("data:");
    json.replace(begin, json.find('"', begin) - begin, "bone.bin");
    Bytes numbers = float_points(box.points);
    for (const Triangle& t : box.triangles) {
        for (const std::uint32_t corner : t)
            numbers.insert(numbers.end(), {static_cast<std::uint8_t>(corner), 0, 0, 0});
    }
    write_file(folder / "bone.gltf", json);
    write_file(folder / "bone.bin", numbers);
    const Sha256 before = import_scan(folder / "bone.gltf", {}).sha256;
    EXPECT_EQ(import_scan(folder / "bone.gltf", {}).sha256, before);
    numbers[95] ^= 0x80;  // the sign of a coordinate that is not zero, or of one that is
    write_file(folder / "bone.bin", numbers);
    EXPECT_NE(import_scan(folder / "bone.gltf", {}).sha256, before);
}

}  // namespace
}  // namespace qchopper
