#include "engine/app/drawing_program.h"

#include "engine/core/file.h"
#include "tests/support/environment.h"
#include "tests/support/files.h"

namespace rowland::app {
namespace {

TEST(UnusedFile, IsTheFirstNumberThatNoFileHas) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(unused_file(folder.path(), "shot", ".png"), folder.path() / "shot_0000.png");
    write_file_atomic(folder.path() / "shot_0000.png", "x");
    if (!test::make_link("nowhere", folder.path() / "shot_0001.png"))
        write_file_atomic(folder.path() / "shot_0001.png", "x");
    write_file_atomic(folder.path() / "shot_0003.png", "x");
    EXPECT_EQ(unused_file(folder.path(), "shot", ".png"), folder.path() / "shot_0002.png");
    EXPECT_EQ(unused_file(folder.path(), "shot", ".exr"), folder.path() / "shot_0000.exr");
}

}  // namespace
}  // namespace rowland::app
