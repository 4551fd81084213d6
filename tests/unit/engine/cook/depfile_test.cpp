#include "engine/cook/depfile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {
namespace {

TEST(Depfile, ListsOutputAndSources) {
    EXPECT_EQ(depfile_text("out/a.cooked", {"/s/a.tiles", "/s/b.txt"}),
              "out/a.cooked: \\\n  /s/a.tiles \\\n  /s/b.txt\n");
}

TEST(Depfile, RelativeSourcesAreMadeAbsoluteAndTheOutputIsLeftAlone) {
    EXPECT_EQ(depfile_text("a.cooked", {"a.tiles"}),
              "a.cooked: \\\n  " + (std::filesystem::current_path() / "a.tiles").string() + "\n");
}

TEST(Depfile, SpecialCharactersAreEscapedAsCompilersDo) {
    EXPECT_EQ(depfile_text("a b", {"/x y", "/a#b", "/$HOME", "/a\\b", "/a\\ b", "/a:b", "/\xff\u00e9"}),
              "a\\ b: \\\n  /x\\ y \\\n  /a\\#b \\\n  /$$HOME \\\n  /a\\b \\\n  /a\\\\\\ b \\\n  /a:b \\\n"
              "  /\xff\u00e9\n");
}

TEST(Depfile, LineBreakInANameIsRefused) {
    EXPECT_THAT(test::refusal_of([] { depfile_text("a", {"/x\ny"}); }), testing::HasSubstr("a line break"));
    EXPECT_THAT(test::refusal_of([] { depfile_text("a\r", {"/x"}); }), testing::HasSubstr("a line break"));
}

}  // namespace
}  // namespace rowland::cook
