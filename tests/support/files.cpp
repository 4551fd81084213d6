#include "tests/support/files.h"

#include <fmt/format.h>

#include <cstdlib>
#include <random>
#include <string_view>

namespace rowland::test {

TemporaryFolder::TemporaryFolder() {
    std::random_device random;
    do {
        path_ = std::filesystem::temp_directory_path() / fmt::format("rowland-test-{:08x}{:08x}", random(), random());
    } while (!std::filesystem::create_directory(path_));  // false: another test has the name
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path source_path(const std::string& path) {
    const std::filesystem::path root = ROWLAND_SOURCE_TREE;
    return path.empty() ? root : root / path;
}

std::filesystem::path content_path(const std::string& path) {
    return source_path("content") / path;
}

std::optional<std::filesystem::path> find_data(const std::string& relative_path) {
    const char* folder = std::getenv("ROWLAND_DATA");
    const std::filesystem::path path = std::filesystem::path(folder ? folder : ROWLAND_DEFAULT_DATA) / relative_path;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return path.lexically_normal();
}

bool data_is_required() {
    const char* ci = std::getenv("CI");
    return (ci && std::string_view(ci) == "true") || std::getenv("ROWLAND_DATA") != nullptr;
}

}  // namespace rowland::test
