#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

namespace rowland::test {

/// A fresh folder, removed with everything in it at the end of the scope.
class TemporaryFolder {
 public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

/// A file or folder of the source tree, by its path from the root.
std::filesystem::path source_path(const std::string& path);

/// The source of an asset: a path under content/.
std::filesystem::path content_path(const std::string& path);

/// The path of a file of the test data (`ROWLAND_DATA`, else `../shared` beside the source tree), if it is there.
std::optional<std::filesystem::path> find_data(const std::string& relative_path);

/// True where missing test data is a failure: under CI=true or with ROWLAND_DATA set.
bool data_is_required();

}  // namespace rowland::test

/// Declares `variable` as the path of a file of the test data. Missing: the test is skipped by name, or fails where
/// the data is required.
#define ROWLAND_TEST_DATA(variable, relative_path)                                                      \
    const auto variable##_found = ::rowland::test::find_data(relative_path);                            \
    if (!variable##_found) {                                                                            \
        if (::rowland::test::data_is_required()) FAIL() << "test data is missing: " << (relative_path); \
        GTEST_SKIP() << "test data is missing: " << (relative_path);                                    \
    }                                                                                                   \
    const std::filesystem::path& variable = *variable##_found  // NOLINT(bugprone-macro-parentheses): it declares
