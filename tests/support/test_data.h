#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

namespace rowland::test {

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
