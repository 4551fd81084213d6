#include "engine/core/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "engine/core/file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rowland {
namespace {

using testing::HasSubstr;

class Outputs : public testing::Test {
 protected:
    Outputs() { write_file_atomic(path("source.json"), "{}"); }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::string refusal(const std::vector<Output>& outputs) const {
        const std::vector<std::filesystem::path> inputs{path("source.json")};
        return test::message_of([&] { check_outputs(inputs, outputs); });
    }

    test::TemporaryFolder folder_;
};

TEST_F(Outputs, FilesOfTheirOwnPassAndNothingIsWritten) {
    const std::vector<std::filesystem::path> inputs{path("source.json"), path("source.json"), path("missing.json")};
    const std::vector<Output> outputs{{"--capture", path("a.PNG"), ".png"},
                                      {"--benchmark", path("new/folder/a.json")},
                                      {"--record", "relative.jsonl"}};
    EXPECT_NO_THROW(check_outputs(inputs, outputs));
    EXPECT_FALSE(std::filesystem::exists(path("new")));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Outputs, AnInputIsRefusedByWhateverName) {
    std::filesystem::create_symlink("source.json", path("link.json"));
    std::filesystem::create_hard_link(path("source.json"), path("hard.json"));
    std::filesystem::create_directory_symlink(folder_.path(), path("folder"));
    for (const char* name : {"source.json", "./source.json", "new/../source.json", "link.json", "hard.json",
                             "folder/source.json", "folder/folder/link.json"})
        EXPECT_THAT(refusal({{"--output", path(name)}}), HasSubstr("--output")) << name;
}

TEST_F(Outputs, AnotherOutputIsRefusedWhetherOrNotItExists) {
    write_file_atomic(path("old.png"), "");
    for (const char* name : {"new.png", "old.png"})
        EXPECT_THAT(refusal({{"--capture", path(name)}, {"--capture-linear", folder_.path() / "." / name}}),
                    HasSubstr("the same file as the output of --capture"));
}

TEST_F(Outputs, AnExtensionOfAnotherFormatIsRefused) {
    for (const char* name : {"a.jpg", "a", "a.png.exr", ".png"})
        EXPECT_THAT(refusal({{"--capture", path(name), ".png"}}), HasSubstr("expected .png")) << name;
}

TEST_F(Outputs, WhatCannotBeWrittenIsRefused) {
    const std::vector<std::filesystem::path> names{"/dev/full",           "/proc/nowhere/a.png", "/dev/null/a.png",
                                                   path("source.json/a"), folder_.path(),        path("new/")};
    for (const std::filesystem::path& name : names)
        EXPECT_THAT(refusal({{"--capture", name}}), HasSubstr("--capture")) << name;
}

}  // namespace
}  // namespace rowland
