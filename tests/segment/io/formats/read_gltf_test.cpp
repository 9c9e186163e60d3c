#include "segment/io/formats/read_gltf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "segment/io/read_mesh.h"
#include "segment/io/write_glb.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"
#include "tests/segment/io/wrappings.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});

RawMesh read(const std::string& json) {
    return parse_mesh(bytes_of(json), "bone.gltf");
}
std::string refused(const std::string& json) {
    return refusal([&] { read(json); });
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(from + " is not in the text");
    return text.replace(at, from.size(), to);
}
void expect_words(const std::string& json, const std::string& words) {
    const std::string what = refused(json);
    EXPECT_NE(what.find(words), std::string::npos) << what;
    EXPECT_NE(what.find("bone.gltf"), std::string::npos) << what;
}

TEST(ReadGltf, HasMetresAndComesOutWithZUp) {
    const RawMesh scan = read(gltf_of(box));
    EXPECT_EQ(scan.format, MeshFormat::gltf);
    EXPECT_EQ(scan.mm_per_unit, 1000.0);
    const Box all = bounds(scan.mesh);  // what was 2 high is 2 high
    EXPECT_EQ(all.min, (Vec3{0, -3, 0}));
    EXPECT_EQ(all.max, (Vec3{1, 0, 2}));
    EXPECT_DOUBLE_EQ(volume_mm3(scan.mesh), 6);
}

// What we write for viewers comes back where it was: the root of it turns and scales, and so do we.
TEST(ReadGltf, GivesBackWhatWasWrittenForViewers) {
    GlbScene scene;
    scene.nodes.push_back({"piece/A", &box, {10, 20, 30}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {}});
    const RawMesh scan = parse_mesh(to_glb(scene), "a.glb");
    EXPECT_EQ(scan.format, MeshFormat::glb);
    ASSERT_EQ(scan.mesh.points.size(), box.points.size());
    for (std::size_t i = 0; i < box.points.size(); ++i) {
        EXPECT_LT(norm(1000 * scan.mesh.points[i] - (box.points[i] + Vec3{10, 20, 30})), 1e-9);
    }
    EXPECT_EQ(scan.mesh.triangles, box.triangles);
}

TEST(ReadGltf, NodesAreTurnedOneInTheOther) {
    const std::string nested =
        replaced(gltf_of(box, R"("children":[1],"translation":[100,0,0])"), R"(}],"scenes")",
                 R"(},{"mesh":0,"scale":[2,1,1],"rotation":[0,0,0.7071067811865476,0.7071067811865476]}],"scenes")");
    const Box all = bounds(read(nested).mesh);  // 2 wide, turned from x to y, which is up: z of the scan
    EXPECT_LT(norm(all.min - Vec3{98, -3, 0}), 1e-12);
    EXPECT_LT(norm(all.max - Vec3{100, 0, 2}), 1e-12);
    const std::string matrix = gltf_of(box, R"("mesh":0,"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1])");
    EXPECT_EQ(bounds(read(matrix).mesh).min, (Vec3{3, -10, 6}));
}

TEST(ReadGltf, AMirroredNodeStillFacesOutward) {
    EXPECT_DOUBLE_EQ(volume_mm3(read(gltf_of(box, R"("mesh":0,"scale":[-1,1,1])")).mesh), 6);
}

TEST(ReadGltf, OneMeshMayHangOnManyNodes) {
    const std::string twice =
        replaced(replaced(gltf_of(box), R"(}],"scenes")", R"(},{"mesh":0,"translation":[9,0,0]}],"scenes")"),
                 R"("nodes":[0])", R"("nodes":[0,1])");
    EXPECT_EQ(read(twice).mesh.triangles.size(), 24U);
    EXPECT_DOUBLE_EQ(volume_mm3(read(twice).mesh), 12);
    expect_words(replaced(twice, R"("nodes":[0,1])", R"("nodes":[0,0])"), "node 0 occurs twice in the scene");
    expect_words(gltf_of(box, R"("mesh":0,"children":[0])"), "occurs twice in the scene");
}

TEST(ReadGltf, WithoutScenesEveryRootIsShown) {
    EXPECT_EQ(read(replaced(gltf_of(box), R"(,"scenes":[{"nodes":[0]}],"scene":0)", "")).mesh.triangles.size(), 12U);
    expect_words(replaced(gltf_of(box), R"("scene":0)", R"("scene":3)"), "there is no scene 3");
}

// Four corners of a square, as they are in a list.
std::string square(const std::string& primitive,
                   const std::string& accessors = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4})",
                   Bytes numbers = float_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})) {
    const std::string size = std::to_string(numbers.size());
    return gltf_text(numbers, R"("bufferViews":[{"buffer":0,"byteLength":)" + size + R"(}],"accessors":[)" + accessors +
                                  R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0})" + primitive +
                                  R"(}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])");
}

TEST(ReadGltf, ReadsStripsAndFans) {
    const RawMesh strip = read(square(R"(,"mode":5)"));
    EXPECT_EQ(strip.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_EQ(read(square(R"(,"mode":6)")).mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    for (std::size_t t = 0; t < 2; ++t) EXPECT_LT(area_vector(strip.mesh, t).y, 0);  // it faced +z, which is -y now
    expect_words(square(""), "4 corners, which is no multiple of 3");
}

TEST(ReadGltf, LinesAndPointsAreLeftOut) {
    const std::string json =
        replaced(gltf_of(box), R"("primitives":[)", R"("primitives":[{"attributes":{"POSITION":0},"mode":1},)");
    const RawMesh scan = read(json);
    EXPECT_EQ(scan.mesh.triangles.size(), 12U);
    ASSERT_EQ(scan.warnings.size(), 1U);
    expect_words(square(R"(,"mode":0)"), "holds no faces");
}

TEST(ReadGltf, ReadsQuantizedPoints) {
    const Bytes shorts{0, 0, 0, 0, 0, 0, 0xff, 0x7f, 0, 0, 0, 0, 0, 0, 0xff, 0x7f, 0, 0, 0, 0, 0, 0, 1, 0x80};
    const auto with = [&](const std::string& more) {
        return read(square(R"(,"mode":5)",
                           R"({"bufferView":0,"componentType":5122,"type":"VEC3","count":4)" + more + "}", shorts))
            .mesh.points;
    };
    const std::vector<Vec3> whole{{0, 0, 0}, {32767, 0, 0}, {0, 0, 32767}, {0, 32767, 0}};
    EXPECT_EQ(with(""), whole);
    const std::vector<Vec3> fractions{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
    EXPECT_EQ(with(R"(,"normalized":true)"), fractions);
}

TEST(ReadGltf, ReadsSparsePoints) {
    Bytes numbers = float_points({{5, 6, 7}});
    numbers.push_back(3);
    const std::string sparse =
        R"({"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":1,)"
        R"("indices":{"bufferView":0,"byteOffset":12,"componentType":5121},"values":{"bufferView":0}}})";
    const RawMesh scan = read(square(R"(,"mode":5)", sparse, numbers));
    EXPECT_EQ(scan.mesh.points, (std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {5, -7, 6}}));
    numbers.back() = 4;
    expect_words(square(R"(,"mode":5)", sparse, numbers), "replaces a point that is not there");
    expect_words(square(R"(,"mode":5)", replaced(sparse, R"("count":4)", R"("count":40000000)"), numbers),
                 "more points than bytes");
}

TEST(ReadGltf, NeedsNoExtensionThatChangesFaces) {
    const auto with = [&](const std::string& extension) {
        return replaced(gltf_of(box), R"("buffers")", R"("extensionsRequired":[")" + extension + R"("],"buffers")");
    };
    EXPECT_EQ(read(with("KHR_materials_unlit")).mesh.triangles.size(), 12U);
    EXPECT_EQ(read(with("KHR_mesh_quantization")).mesh.triangles.size(), 12U);
    expect_words(with("KHR_draco_mesh_compression"), "needs KHR_draco_mesh_compression");
    expect_words(with("EXT_meshopt_compression"), "needs EXT_meshopt_compression");
}

class Folder {
 public:
    Folder() : path(fs::temp_directory_path() / ("gltf_test." + std::to_string(::getpid()))) {
        fs::create_directories(path / "sub");
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    fs::path path;
};

TEST(ReadGltf, FindsItsNumbersBesideItAndNowhereElse) {
    const Folder folder;
    const std::string inside = gltf_of(box);
    const std::size_t begin = inside.find("data:");
    const auto named = [&](const std::string& uri) {
        std::string json = inside;
        json.replace(begin, json.find('"', begin) - begin, uri);
        write_file(folder.path / "bone.gltf", json);
        return folder.path / "bone.gltf";
    };
    Bytes numbers = float_points(box.points);
    for (const Triangle& t : box.triangles) {
        for (const std::uint32_t corner : t)
            numbers.insert(numbers.end(), {static_cast<std::uint8_t>(corner), 0, 0, 0});
    }
    write_file(folder.path / "a b.bin", numbers);
    write_file(folder.path / "sub" / "a.bin", numbers);
    const RawMesh scan = read_mesh(named("a%20b.bin"));
    EXPECT_EQ(scan.mesh, read(inside).mesh);
    EXPECT_EQ(scan.beside, std::vector<Sha256>{sha256(numbers)});
    EXPECT_EQ(read_mesh(named("sub/a.bin")).mesh, scan.mesh);
    for (const std::string& uri :
         {std::string("../a.bin"), std::string("sub/../../a.bin"), (folder.path / "a b.bin").string(),
          std::string("file:///a.bin"), std::string("http://a/b.bin")}) {
        const std::string what = refusal([&] { read_mesh(named(uri)); });
        EXPECT_NE(what.find("not beside it"), std::string::npos) << what;
    }
    EXPECT_NE(refusal([&] { parse_mesh(read_file(named("sub/a.bin")), "bytes"); }).find("no folder to search"),
              std::string::npos);
    numbers.pop_back();
    write_file(folder.path / "sub" / "a.bin", numbers);
    EXPECT_NE(refusal([&] { read_mesh(named("sub/a.bin")); }).find("do not fit together"), std::string::npos);
    try {
        read_mesh(named("none.bin"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::missing);
        EXPECT_NE(std::string(error.what()).find("none.bin"), std::string::npos) << error.what();
    }
}

TEST(ReadGltf, SaysWhatIsWrong) {
    const std::string good = gltf_of(box);
    expect_words("{\"asset\":", "its JSON is damaged at byte");
    expect_words("{}", "it has no \"asset\"");
    expect_words(replaced(good, "\"2.0\"", "\"1.0\""), "only version 2 is read");
    expect_words(replaced(good, R"("count":8)", R"("count":9000000000000000)"), "more than 50 million points");
    expect_words(replaced(good, R"("count":8)", R"("count":9)"), "mesh 0 has more numbers than its buffer");
    expect_words(replaced(good, R"("count":8)", R"("count":-8)"), "accessors 0: \"count\" is no whole number");
    expect_words(replaced(good, R"("count":8)", R"("count":7)"), "names point 7, but there are 7");
    expect_words(replaced(good, R"("count":36)", R"("count":37)"), "more numbers than its buffer");
    expect_words(replaced(good, R"("byteOffset":96)", R"("byteOffset":97)"), "more numbers than its buffer");
    expect_words(replaced(good, R"("byteOffset":96)", R"("byteOffset":9007199254740992)"),
                 "more numbers than its buffer");
    expect_words(replaced(good, "5125", "5126"), "no plain whole numbers");
    expect_words(replaced(good, "VEC3", "VEC2"), "another type than three numbers");
    expect_words(replaced(good, R"("POSITION":0)", R"("POSITION":9)"), "names accessor 9");
    expect_words(replaced(good, R"([{"mesh":0)", R"([{"mesh":9)"), "names a mesh that is not there");
    expect_words(replaced(good, R"([{"mesh":0)", R"([{"mesh":0,"scale":[1,2])"), "\"scale\" needs 3 numbers");
    expect_words(replaced(good, R"([{"mesh":0)", R"([{"mesh":0,"scale":[1e300,1,1],"translation":[1e400,0,0])"),
                 "JSON is damaged");
    expect_words(replaced(good, R"([{"mesh":0)",
                          R"([{"mesh":0,"matrix":[1e308,0,0,0,0,1e308,0,0,0,0,1e308,0,1e308,1e308,1e308,1])"),
                 "not a finite number");
    expect_words(replaced(good, R"("nodes":[0])", R"("nodes":[7])"), "there is no node 7");
    expect_words(replaced(good, "base64,", "base64,!"), "is not a valid glTF file");
}

// Nested as deep as the file is long: nothing may follow that on the stack.
TEST(ReadGltf, DeepNestingIsNoTrap) {
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    EXPECT_EQ(
        read(replaced(gltf_of(box), R"("buffers")", R"("extras":)" + deep + R"(,"buffers")")).mesh.triangles.size(),
        12U);
    EXPECT_EQ(read(replaced(gltf_of(box), R"([{"mesh":0)", R"([{"mesh":0,"extras":)" + deep)).mesh.triangles.size(),
              12U);
    EXPECT_FALSE(refused(replaced(gltf_of(box), R"("count":8)", R"("count":)" + deep)).empty());
    std::string chain;
    for (int i = 1; i <= 5000; ++i) chain += "{\"children\":[" + std::to_string(i) + "]},";
    expect_words(replaced(gltf_of(box), R"("nodes":[{)", "\"nodes\":[" + chain + "{"), "1000 nodes deep");
}

}  // namespace
}  // namespace qchopper
