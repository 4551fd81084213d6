// The page that explains the bare OpenGL example shows its code as it is.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "engine/core/file.h"
#include "tests/support/source_tree.h"

namespace rowland {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 20;

/// All source of the example, one file after the other.
std::string example_source() {
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(test::content_path("examples/bare_gl")))
        text += read_text_file(entry.path(), kMostBytes);
    return text;
}

TEST(PortingPage, EveryLineOfItsCodeIsTheExamples) {
    const std::string source = example_source();
    std::istringstream page(read_text_file(test::source_path("modules/diffraction/PORTING.md"), kMostBytes));
    bool in_code = false;
    int lines = 0;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) {
            in_code = line == "```cpp" || line == "```glsl";
        } else if (in_code && !line.empty()) {
            EXPECT_NE(source.find(line + "\n"), std::string::npos) << line;
            ++lines;
        }
    }
    EXPECT_GT(lines, 20);
}

}  // namespace
}  // namespace rowland
