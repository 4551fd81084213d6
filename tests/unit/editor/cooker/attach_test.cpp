// rowland-cook attach and list, through the program.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using OrderedJson = nlohmann::ordered_json;

constexpr std::uint64_t kMost = 1 << 24;
constexpr const char* kExtension = "ROWLAND_materials_diffraction";

const char* const kScene = R"({
  "asset": { "version": "2.0" },
  "materials": [
    { "name": "Chrome" },
    { "name": "Paint", "extras": { "a": 1.0e0 } },
    { "name": "Paint" }
  ],
  "meshes": [
    { "name": "body", "primitives": [ { "attributes": {}, "material": 1 }, { "attributes": {}, "material": 0 } ] },
    { "name": "wheel", "primitives": [ { "attributes": {}, "material": 0 } ] },
    { "primitives": [ { "attributes": {} } ] }
  ]
})";

class Attach : public testing::Test {
 protected:
    Attach() { write("scene.gltf", kScene); }

    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string write(const std::string& name, std::string_view text) const {
        write_file_atomic(path(name), text);
        return path(name);
    }
    std::string text(const std::string& name = "scene.gltf") const { return read_text_file(path(name), kMost); }
    OrderedJson material(std::size_t index, const std::string& name = "scene.gltf") const {
        return OrderedJson::parse(text(name))["materials"][index];
    }

    /// attach scene.gltf ARGUMENTS
    test::Ended attach(std::vector<std::string> arguments, const std::string& scene = "scene.gltf") const {
        arguments.insert(arguments.begin(), {ROWLAND_COOK, "attach", path(scene)});
        return test::run(arguments);
    }
    /// The message of a refusal, which leaves the scene as it was.
    std::string refusal(std::vector<std::string> arguments) const {
        const test::Ended ended = attach(std::move(arguments));
        EXPECT_EQ(ended.code, 2) << ended.err;
        EXPECT_EQ(text(), kScene);
        return ended.err;
    }

    std::string list(const std::string& scene = "scene.gltf") const {
        return test::run({ROWLAND_COOK, "list", path(scene)}).out;
    }

    const std::string dvd = test::content_path("materials/dvd.json").string();
    test::TemporaryFolder folder_;
};

TEST_F(Attach, ReplacesTheSceneAndListShowsIt) {
    const test::Ended ended = attach({"--material", "Chrome", dvd});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out + ended.err, "");
    OrderedJson expected = OrderedJson::parse(read_text_file(dvd, kMost));
    expected.erase("base");
    EXPECT_EQ(material(0)["extensions"][kExtension], expected) << "the material's own surface is under the grating";
    EXPECT_EQ(material(1), OrderedJson::parse(R"({"name": "Paint", "extras": {"a": 1.0}})"));
    EXPECT_EQ(list(),
              "material\tname\tattached\tmeshes\n"
              "#0\tChrome\t740 nm lamellar\tbody, wheel\n"
              "#1\tPaint\tnone\tbody\n"
              "#2\tPaint\tnone\t\n"
              "none\t\tnone\tmesh 2\n");
    const std::string once = text();
    EXPECT_EQ(attach({"--material", "Chrome", dvd}).code, 0);
    EXPECT_EQ(text(), once) << "again, as a build does";
    EXPECT_EQ(attach({"--remove", "Chrome"}).code, 0);
    EXPECT_EQ(OrderedJson::parse(text()), OrderedJson::parse(kScene)) << "in the order of its members";
    write("SCENE.GLTF", kScene);
    EXPECT_EQ(attach({"--material", "Chrome", dvd}, "SCENE.GLTF").code, 0);
}

TEST_F(Attach, WritesAnOutputAndWhatWasRead) {
    fs::create_directory(path("m"));
    fs::copy_file(test::content_path("materials/vinyl.json"), path("m/vinyl.json"));
    fs::copy_file(test::content_path("materials/vinyl_efficiency.csv"), path("m/vinyl_efficiency.csv"));
    ASSERT_EQ(attach({"--material", "Chrome", path("m/vinyl.json"), "--material", "#2", dvd, "-o",
                      path("out/scene.gltf"), "--depfile", path("scene.d")})
                  .code,
              0);
    EXPECT_EQ(text(), kScene);
    EXPECT_EQ(material(0, "out/scene.gltf")["extensions"][kExtension]["grating"]["profile"]["file"],
              "../m/vinyl_efficiency.csv");
    EXPECT_TRUE(material(2, "out/scene.gltf").contains("extensions"));
    for (const std::string& name : {path("scene.gltf"), path("m/vinyl.json"), path("m/vinyl_efficiency.csv"), dvd})
        EXPECT_THAT(text("scene.d"), HasSubstr(fs::path(name).generic_string()));
    EXPECT_EQ(attach({"--remove", "#2", "-o", path("scene2.gltf")}, "out/scene.gltf").code, 0);
    EXPECT_EQ(material(0, "scene2.gltf")["extensions"][kExtension]["grating"]["profile"]["file"],
              "m/vinyl_efficiency.csv")
        << "what was attached before finds its table from another folder";
    EXPECT_THAT(list("scene2.gltf"), HasSubstr("100000 nm table"));
}

TEST_F(Attach, NamesThatAreMissingOrNotUniqueAreRefused) {
    EXPECT_THAT(refusal({"--material", "Chrom", dvd}), HasSubstr("no material \"Chrom\"; expected one of its 3 "
                                                                 "materials; is \"Chrome\" meant?"));
    EXPECT_THAT(refusal({"--material", "Paint", dvd}),
                HasSubstr("2 materials called \"Paint\"; expected one of #1, #2"));
    EXPECT_THAT(refusal({"--material", "#3", dvd}), HasSubstr("no material \"#3\""));
    EXPECT_THAT(refusal({"--material", "#99999999999999999999", dvd}), HasSubstr("no material"));
    EXPECT_THAT(refusal({"--remove", "Gold"}), HasSubstr("rowland-cook list"));
    EXPECT_THAT(refusal({}), HasSubstr("--material, --remove: neither"));
    EXPECT_EQ(attach({"--material", "#1", dvd}).code, 0);
    EXPECT_TRUE(material(1).contains("extensions"));
}

TEST_F(Attach, ARefusedGratingChangesNothing) {
    const std::string bad = write("bad.json", R"({"grating": {"pitch_nm": -1, "profile": {"type": "slit"}}})");
    EXPECT_THAT(refusal({"--material", "#1", dvd, "--material", "Chrome", bad}),
                HasSubstr("bad.json: /grating/pitch_nm"));
    const std::string probe = test::content_path("probes/studio.json").string();
    EXPECT_THAT(refusal({"--material", "Chrome", probe}), HasSubstr("a probe source"));
    EXPECT_THAT(refusal({"--material", "Chrome", path("missing.json")}), HasSubstr("missing.json"));
    EXPECT_THAT(refusal({"--material", "Chrome", dvd, "-o", path("scene.glb")}), HasSubstr("expected .gltf"));
    const std::string copy = write("dvd.gltf", "x");
    EXPECT_THAT(refusal({"--material", "Chrome", copy, "-o", copy}), HasSubstr("the same file as an input"));
}

TEST_F(Attach, TurnsGroovesAndVariesThemByAnImage) {
    const std::string image = test::source_path("tests/golden/images").string();
    fs::path png;
    for (const fs::directory_entry& entry : fs::directory_iterator(image))
        if (entry.path().extension() == ".png") png = entry.path();
    ASSERT_FALSE(png.empty());
    fs::copy_file(png, path("foil.png"));
    const std::vector<std::string> arguments = {"--material",       "Chrome",        dvd, "--groove-rotation-deg", "90",
                                                "--groove-texture", path("foil.png")};
    ASSERT_EQ(attach(arguments).code, 0);
    const OrderedJson object = material(0)["extensions"][kExtension];
    EXPECT_NEAR(object["grooveRotation"].get<double>(), 1.5707963267948966, 1e-15);
    EXPECT_EQ(object["grooveTexture"]["index"], 0);
    EXPECT_EQ(OrderedJson::parse(text())["images"][0]["uri"], "foil.png") << "it lies beside the scene already";
    EXPECT_THAT(list(), HasSubstr("740 nm lamellar, grooves turned by 90 degrees, groove texture 0"));
    const std::string once = text();
    ASSERT_EQ(attach(arguments).code, 0);
    EXPECT_EQ(text(), once);
    write("scene.gltf", kScene);
    EXPECT_THAT(refusal({"--material", "#0", dvd, "--material", "#1", dvd, "--groove-rotation-deg", "90"}),
                HasSubstr("2 materials; expected one --material"));
}

TEST_F(Attach, AFilmReplacesAGratingAndIsReplacedAndTheSurfacesOwnIndexStays) {
    constexpr const char* kFilm = "KHR_materials_iridescence";
    const std::string titanium = test::content_path("materials/anodised_titanium.json").string();
    fs::copy_file(test::content_path("materials/wing_cell.png"), path("bands.png"));
    write("scene.gltf", R"({"asset": {"version": "2.0"}, "materials": [{"name": "Ring", "extensions":
        {"KHR_materials_ior": {"ior": 1.4}}}]})");
    const std::string bare = text();
    ASSERT_EQ(attach({"--material", "Ring", dvd}).code, 0);
    const test::Ended ended = attach({"--material", "Ring", titanium, "--thickness-texture", path("bands.png")});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const OrderedJson extensions = material(0)["extensions"];
    EXPECT_FALSE(extensions.contains(kExtension));
    EXPECT_EQ(extensions[kFilm], OrderedJson::parse(R"({"iridescenceFactor": 1, "iridescenceIor": 2.4,
        "iridescenceThicknessMinimum": 0, "iridescenceThicknessMaximum": 45, "extras": {"base": {"ior": 2.5, "k": 3.3}},
        "iridescenceThicknessTexture": {"index": 0}})"));
    EXPECT_THAT(list(), HasSubstr("#0\tRing\t0 to 45 nm of ior 2.4, factor 1\t"));
    EXPECT_EQ(test::run({ROWLAND_COOK, "check", path("scene.gltf")}).code, 0);
    const test::Ended turned = attach({"--material", "Ring", titanium, "--groove-rotation-deg", "90"});
    EXPECT_EQ(turned.code, 2);
    EXPECT_THAT(turned.err, HasSubstr("a film source; expected a grating"));
    const std::string layers = write("layers.json", R"({"film": [{"ior": 2.4, "thickness_nm": 57},
        {"ior": 1.46, "thickness_nm": 94}], "base": {"ior": 1.52}})");
    EXPECT_THAT(attach({"--material", "Ring", layers}).err, HasSubstr("/film: 2 layers; expected one layer"));
    ASSERT_EQ(attach({"--material", "Ring", dvd}).code, 0);
    EXPECT_FALSE(material(0)["extensions"].contains(kFilm));
    ASSERT_EQ(attach({"--remove", "Ring"}).code, 0);
    EXPECT_EQ(material(0), OrderedJson::parse(bare)["materials"][0]);
}

TEST_F(Attach, ListGoesOnAfterARefusedGrating) {
    write("bad.gltf", R"({"asset":{"version":"2.0"},"materials":[
        {"name":"a\tb","extensions":{"ROWLAND_materials_diffraction":{"grating":{"pitch_nm":-1}}}},{"name":"c"}]})");
    const test::Ended ended = test::run({ROWLAND_COOK, "list", path("bad.gltf")});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("/materials/0/extensions/ROWLAND_materials_diffraction/grating/pitch_nm"));
    EXPECT_THAT(ended.out, AllOf(HasSubstr("#0\ta\\tb\trefused\t\n"), HasSubstr("#1\tc\tnone\t\n")));
    EXPECT_EQ(test::run({ROWLAND_COOK, "check", path("bad.gltf")}).code, 2) << "so does check";
}

/// 2 000 nodes, 200 MB: an importer that holds the file twice still stays below a gigabyte.
TEST_F(Attach, LargeFilesTakeLittleMoreThanTheirSize) {
    OrderedJson scene = OrderedJson::parse(kScene);
    constexpr std::uint32_t kBytes = 200'000'000;
    for (int i = 0; i < 2000; ++i) scene["nodes"].push_back({{"name", "node"}, {"mesh", i % 3}});
    scene["buffers"] = {{{"byteLength", kBytes}}};
    std::string json = scene.dump(2);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    const auto put = [&](std::uint32_t number) { glb.append(reinterpret_cast<const char*>(&number), sizeof(number)); };
    put(2);
    put(static_cast<std::uint32_t>(28 + json.size() + kBytes));
    put(static_cast<std::uint32_t>(json.size()));
    glb += "JSON" + json;
    put(kBytes);
    glb += std::string("BIN\0", 4);
    const std::size_t begin = glb.size();
    glb.resize(begin + kBytes, 'x');
    write("large.glb", glb);
    const test::Ended ended = attach({"--material", "Chrome", dvd}, "large.glb");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_LT(ended.peak_bytes, 400'000'000U);
    const std::string now = read_text_file(path("large.glb"), std::uint64_t{1} << 30);
    EXPECT_NE(now.find(kExtension), std::string::npos);
    EXPECT_TRUE(std::string_view(now).ends_with(std::string_view(glb).substr(begin)));
}

}  // namespace
}  // namespace rowland
