#pragma once

#include <string_view>

#include "engine/core/file.h"
#include "tests/support/files.h"

namespace rowland::test {

/// A fixture with a folder for the test's files.
class FolderTest : public testing::Test {
 protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::filesystem::path write(const std::string& name, std::string_view content) const {
        write_file_atomic(path(name), content);
        return path(name);
    }
    std::string text(const std::string& name) const { return read_text_file(path(name), 1 << 24); }

    TemporaryFolder folder_;
};

}  // namespace rowland::test
