#include "content/demo/pixel/whole_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/file.h"
#include "tests/support/message_of.h"
#include "tests/support/small_sky.h"
#include "tests/support/temporary_folder.h"

namespace rowland::demo {
namespace {

using ::testing::HasSubstr;

TEST(WholeProbe, OfACookedProbeIsThatOfItsRecipe) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.path() / name; };
    const std::filesystem::path probe = path("sky.probe");  // not read
    const auto load = [&] { return load_whole_probe(probe, "auto", path("shipped")); };
    EXPECT_THAT(test::message_of(load), HasSubstr((path("shipped") / "sky.json").string()));
    std::filesystem::create_directory(path("recipes"));
    write_file_atomic(path("recipes") / "sky.json", test::small_sky(64));
    EXPECT_EQ(load().image.image().width, 64) << "what a build cooked from recipes that it wrote itself";
    std::filesystem::create_directory(path("shipped"));
    write_file_atomic(path("shipped") / "sky.json", test::small_sky(128));
    EXPECT_EQ(load().image.image().width, 128);
}

}  // namespace
}  // namespace rowland::demo
