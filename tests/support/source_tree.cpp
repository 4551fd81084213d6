#include "tests/support/source_tree.h"

namespace rowland::test {

std::filesystem::path source_path(const std::string& path) {
    const std::filesystem::path root = ROWLAND_SOURCE_TREE;
    return path.empty() ? root : root / path;
}

std::filesystem::path content_path(const std::string& path) {
    return source_path("content") / path;
}

}  // namespace rowland::test
