#include "editor/inspector/file_list.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"

namespace rowland::inspector {
namespace {

class FileListTest : public testing::Test {
 protected:
    FileListTest() {
        for (const char* name : {"b.json", "A.JSON", "disc.glb", "sky.hdr", "notes.txt", ".hidden.json"})
            write_file_atomic(folder_.path() / name, "x");
        std::filesystem::create_directory(folder_.path() / "models");
    }
    std::vector<std::string> names(const std::string& typed, FileKind kind) const {
        std::vector<std::string> result;
        for (const ListedFile& file : list_files(typed, folder_.path(), kind).files) result.push_back(file.name);
        return result;
    }

    test::TemporaryFolder folder_;
};

TEST_F(FileListTest, FoldersComeFirstThenFilesByName) {
    EXPECT_THAT(names("", FileKind::All), testing::ElementsAre("models", "A.JSON", "b.json", "disc.glb", "sky.hdr"));
    EXPECT_THAT(names("", FileKind::Materials), testing::ElementsAre("models", "A.JSON", "b.json"));
    EXPECT_THAT(names("", FileKind::Models), testing::ElementsAre("models", "disc.glb"));
    EXPECT_THAT(names(".h", FileKind::All), testing::ElementsAre(".hidden.json"));
}

TEST_F(FileListTest, TypedLettersSelectAndAreCompleted) {
    EXPECT_THAT(names("a", FileKind::All), testing::ElementsAre("A.JSON"));
    EXPECT_EQ(list_files("a", folder_.path(), FileKind::All).completed, "A.JSON");
    EXPECT_EQ(list_files("mo", folder_.path(), FileKind::All).completed, "models/");
    EXPECT_EQ(list_files("nothing", folder_.path(), FileKind::All).completed, "nothing");
    const std::string typed = (folder_.path() / "d").string();
    EXPECT_EQ(list_files(typed, "/", FileKind::All).completed, (folder_.path() / "disc.glb").string());
}

TEST_F(FileListTest, ATypedPathIsRelativeToTheFolderOrTheHome) {
    EXPECT_EQ(resolved("b.json", folder_.path()), folder_.path() / "b.json");
    EXPECT_EQ(resolved("/tmp/b.json", folder_.path()), "/tmp/b.json");
    const char* home = std::getenv("HOME");
    const std::filesystem::path expected = home == nullptr ? folder_.path() / "~" : std::filesystem::path(home);
    EXPECT_EQ(resolved("~/b.json", folder_.path()), expected / "b.json");
}

TEST_F(FileListTest, AFolderThatIsMissingHasNoFiles) {
    EXPECT_TRUE(names("missing/x", FileKind::All).empty());
}

}  // namespace
}  // namespace rowland::inspector
