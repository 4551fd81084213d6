// What a pixel covers is averaged: pictures hold still while the camera moves by less than a pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "engine/platform/headless_context.h"
#include "tests/demo/shimmer.h"

namespace rowland {
namespace {

constexpr glm::ivec2 kSize{1280, 720};

demo::Options cabinet() {
    demo::Options options;
    options.watch = false;
    options.content_folder = std::filesystem::path(ROWLAND_SOURCE_TREE) / "content";
    options.cooked_folder = std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked";
    options.scene = options.cooked_folder / "cabinet.glb";
    return options;
}

TEST(Shimmer, OfTheCabinetInEveryView) {
    const platform::HeadlessContext context;
    const demo::Options options = cabinet();
    test::Shimmer shimmer(options, kSize);
    const auto views = shimmer.session().scene().views();
    const char* asked = std::getenv("SHIMMER_VIEWS");
    const std::string chosen = asked ? asked : "01234";
    for (const std::filesystem::path& probe : demo::probe_paths(options)) {
        shimmer.session().use_probe(probe);
        for (std::size_t view = 0; view < views.size(); ++view) {
            if (chosen.find(char('0' + view)) == std::string::npos) continue;
            for (const auto& [object, figures] : shimmer.measure(views[view], std::getenv("SHIMMER_ERROR") != nullptr))
                fmt::print("{:10} view {} {:14} {:7} pixels  jumping {:5.1f} %  error {:5.1f} %  displayed {:5.1f} % floor {:5.1f} %\n", probe.stem().string(),
                           view, object, figures.pixels, 100.0 * figures.jumping, 100.0 * figures.error, 100.0 * figures.displayed, 100.0 * figures.floor);
            std::fflush(stdout);
        }
    }
}

}  // namespace
}  // namespace rowland
