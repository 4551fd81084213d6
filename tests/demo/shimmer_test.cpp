// Pixels average what they cover: pictures hold still while the camera moves by less than a pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/platform/headless_context.h"
#include "tests/demo/shimmer.h"
#include "tests/support/temporary_folder.h"

namespace rowland {
namespace {

constexpr glm::ivec2 kSize{1280, 720};
constexpr const char* kFoil = "foil card";

demo::Options cabinet() {
    demo::Options options;
    options.watch = false;
    options.content_folder = std::filesystem::path(ROWLAND_SOURCE_TREE) / "content";
    options.cooked_folder = std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked";
    options.scene = options.cooked_folder / "cabinet.glb";
    options.probe = options.cooked_folder / "studio.probe";
    return options;
}

/// The scene with another text of the same JSON in place of one. A GLB file begins with its length at byte 8 and the
/// length of its JSON at byte 12; the JSON begins at byte 20, and spaces fill its last word.
std::string with_json(std::string glb, const std::string& old_text, const std::string& new_text) {
    const auto length_at = [&](std::size_t at) -> std::uint32_t {
        std::uint32_t length = 0;
        std::memcpy(&length, glb.data() + at, sizeof length);
        return length;
    };
    const std::uint32_t old_length = length_at(12);
    std::string json = glb.substr(20, old_length);
    const std::size_t found = json.find(old_text);
    EXPECT_NE(found, std::string::npos) << old_text;
    if (found == std::string::npos) return glb;
    json.replace(found, old_text.size(), new_text);
    json.append((4 - json.size() % 4) % 4, ' ');
    const auto new_length = static_cast<std::uint32_t>(json.size());
    const std::uint32_t whole = length_at(8) + new_length - old_length;
    glb.replace(20, old_length, json);
    std::memcpy(glb.data() + 8, &whole, sizeof whole);
    std::memcpy(glb.data() + 12, &new_length, sizeof new_length);
    return glb;
}

/// Prints what the goals are about: four views under the procedural probes. Most jumps that are left are the contents',
/// which move: pictures of 16 samples per pixel jump by 6.9 % on the foil and 2.7 % on the beetle (opening view,
/// studio).
TEST(Shimmer, FewPixelsOfTheCabinetsGratingsJump) {
    const platform::HeadlessContext context;
    const demo::Options options = cabinet();
    test::Shimmer shimmer(options, kSize);
    const auto views = shimmer.session().scene().views();
    for (const std::string probe : {"studio", "clear_sky", "night"}) {
        shimmer.session().use_probe(options.cooked_folder / (probe + ".probe"));
        for (const std::size_t view : {0, 1, 3, 4})
            for (const auto& [object, found] : shimmer.measure(views[view], true)) {
                const std::string where = fmt::format("{}, view {}, {}", probe, view, object);
                fmt::print("{:36} {:6} pixels  jump {:4.1f} %  error {:5.1f} %  up to white {:5.1f} %\n", where,
                           found.pixels, 100.0 * found.jumping, 100.0 * found.error, 100.0 * found.displayed);
                EXPECT_LE(found.jumping, view == 0 ? 0.04 : 0.06) << where;
                if (object == "record" || object == "CD") {
                    EXPECT_LE(found.error, 0.03) << where;
                }
            }
    }
}

TEST(Shimmer, OfAFoilThatSparklesIsTwiceAsMuch) {
    const platform::HeadlessContext context;
    const rowland::test::TemporaryFolder folder;
    demo::Options options = cabinet();
    const std::vector<std::byte> glb = read_file(*options.scene, 1 << 26);
    const std::string text(reinterpret_cast<const char*>(glb.data()), glb.size());
    const auto jumping = [&](const demo::Options& scene) {
        test::Shimmer shimmer(scene, kSize / 2);
        return shimmer.measure(shimmer.session().scene().views()[0], false).at(kFoil).jumping;
    };
    const double filtered = jumping(options);
    options.scene = folder.path() / "sparkle.glb";
    write_file_atomic(*options.scene, with_json(text, R"("grooveTexture":{"index":0})",
                                                R"("grooveTexture":{"index":0,"sparkle":true})"));
    EXPECT_GT(jumping(options), 2.0 * filtered);
}

}  // namespace
}  // namespace rowland
