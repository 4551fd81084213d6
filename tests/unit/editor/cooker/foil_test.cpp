// `rowland-cook foil`: from a recipe and pictures to a card.

#include <gmock/gmock.h>

#include "engine/image/byte_image.h"
#include "tests/support/folder_test.h"
#include "tests/support/program.h"

namespace rowland::editor {
namespace {

using testing::HasSubstr;

class FoilCommand : public test::FolderTest {
 protected:
    FoilCommand() {
        std::vector<std::uint8_t> rgba;
        for (int i = 0; i < 64 * 64; ++i)
            for (const int value : {i % 64 * 4, i / 64 * 4, 120, 255}) rgba.push_back(static_cast<std::uint8_t>(value));
        write_file_atomic(path("a.png"), image::encode_png(64, 64, 4, rgba));
    }

    test::Ended foil(const std::string& recipe, const std::vector<std::string>& more = {}) {
        write("card.json", recipe);
        test::Command command = {ROWLAND_COOK, "foil", path("card.json").string(), "-o", path("card.glb").string()};
        command.insert(command.end(), more.begin(), more.end());
        return test::run(command);
    }

    void expect_refused(const std::string& recipe, const std::string& message) {
        const test::Ended ended = foil(recipe);
        EXPECT_EQ(ended.code, 2) << recipe;
        EXPECT_THAT(ended.err, HasSubstr(message));
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        EXPECT_FALSE(std::filesystem::exists(path("card.glb"))) << recipe;
    }
};

TEST_F(FoilCommand, MakesACardAndNamesWhatItRead) {
    const test::Ended ended = foil(R"({"artwork": "a.png", "texture_px": 512})", {"--depfile", path("d").string()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    const std::string first = text("card.glb");
    EXPECT_THAT(text("d"), HasSubstr("a.png"));
    EXPECT_EQ(foil(R"({"artwork": "a.png", "texture_px": 512})", {"--threads", "1"}).code, 0);
    EXPECT_EQ(text("card.glb"), first);
    const test::Ended checked =
        test::run({ROWLAND_COOK, "check", path("card.glb").string(), path("card.json").string()});
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("foil source"));
}

TEST_F(FoilCommand, CardsOfAllTypesAreValidGltf) {
    for (const std::string type :
         {"pillars", "rainbow", "radial", "tiles", "hexagons", "cosmos", "cracked_ice", "glitter", "brushed", "lens",
          R"(two_pictures", "picture_a": "a.png", "picture_b": "a.png)", R"(own", "drawing": "a.png)"}) {
        const std::string recipe = R"({"artwork": "a.png", "mask": "a.png", "texture_px": 512, "foil": {"type": ")" +
                                   type + R"("}, "card": {"back": "a.png"}})";
        ASSERT_EQ(foil(recipe).code, 0) << type;
        const test::Ended ended =
            test::run({"/usr/bin/env", "node", test::source_path("tests/unit/engine/scene/validate_gltf.cjs").string(),
                       path("card.glb").string()});
        if (ended.code == 77 || ended.code == 127) GTEST_SKIP() << "no gltf-validator";
        EXPECT_EQ(ended.code, 0) << type << ": " << ended.out << ended.err;
    }
}

TEST_F(FoilCommand, BadInputIsRefusedInOneLineAndWritesNothing) {
    expect_refused("{", "card.json: line 1");
    expect_refused(R"({"grating": 1})", "card.json");
    expect_refused(R"({"mesh": {"type": "sphere", "radius": 1}})", "a foil recipe: JSON with at least an artwork");
    expect_refused(R"({"artwork": "none.png"})", "none.png");
    expect_refused(R"({"artwork": "card.json"})", "expected PNG or JPEG");
    expect_refused(R"({"artwork": "a.png", "foil": {"type": "tile"}})", "is \"tiles\" meant?");
    expect_refused(R"({"artwork": "a.png", "foil": {"type": "tiles", "scale": 0}})", "/foil/scale: 0");
    const std::string whole = text("a.png");
    write("a.png", whole.substr(0, whole.size() - 40));
    expect_refused(R"({"artwork": "a.png"})", "a.png");
}

TEST_F(FoilCommand, AnOutputThatIsNoGlbOrAnInputIsRefused) {
    write("card.json", R"({"artwork": "a.png"})");
    const test::Ended png =
        test::run({ROWLAND_COOK, "foil", path("card.json").string(), "-o", path("card.png").string()});
    EXPECT_EQ(png.code, 2);
    EXPECT_THAT(png.err, HasSubstr(".glb"));
    EXPECT_FALSE(std::filesystem::exists(path("card.png")));
}

TEST_F(FoilCommand, PrintsItsSchema) {
    const test::Ended ended = test::run({ROWLAND_COOK, "schema", "foil"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, HasSubstr("cracked_ice"));
}

}  // namespace
}  // namespace rowland::editor
