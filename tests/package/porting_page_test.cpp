// The page that explains how to port shows the code of its examples as it is: C++ and GLSL of bare_gl, TypeScript of
// the package for three.js.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "engine/core/file.h"
#include "tests/support/source_tree.h"

namespace rowland {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 20;

/// All files of a folder, one after the other.
std::string source_of(const char* folder) {
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(test::content_path(folder)))
        if (entry.is_regular_file()) text += read_text_file(entry.path(), kMostBytes);
    return text;
}

TEST(PortingPage, EveryLineOfItsCodeIsTheExamples) {
    const std::string bare_gl = source_of("examples/bare_gl");
    const std::string three = source_of("web/three/src");
    std::istringstream page(read_text_file(test::source_path("modules/diffraction/PORTING.md"), kMostBytes));
    const std::string* source = nullptr;  // of the code that the line is of
    int lines = 0;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) {
            source = line == "```cpp" || line == "```glsl" ? &bare_gl : line == "```ts" ? &three : nullptr;
        } else if (source != nullptr && !line.empty()) {
            EXPECT_NE(source->find(line + "\n"), std::string::npos) << line;
            ++lines;
        }
    }
    EXPECT_GT(lines, 30);
}

}  // namespace
}  // namespace rowland
