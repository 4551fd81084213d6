#include "tests/support/test_data.h"

#include <cstdlib>
#include <string_view>

namespace rowland::test {

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
