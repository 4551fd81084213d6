#include "tests/unit/tree_text.h"
#include "tests/support/source_tree.h"

#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

namespace rowland::test {

namespace {

bool is_text(const std::filesystem::path& path) {
    static const std::array<std::string_view, 8> extensions = {".h",  ".cpp", ".glsl",  ".md",
                                                               ".sh", ".py",  ".cmake", ".in"};
    const std::string extension = path.extension().string();
    for (const std::string_view known : extensions)
        if (extension == known) return true;
    return path.filename() == "CMakeLists.txt" || path.filename() == "rowland" ||
           path.filename() == "CMakePresets.json";
}

TreeFile read(const std::filesystem::path& top, const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return {path.lexically_relative(top).string(), text.str()};
}

}  // namespace

std::vector<TreeFile> tree_files() {
    const std::filesystem::path top = test::source_path("");
    std::vector<TreeFile> files;
    const auto add = [&](const std::filesystem::directory_entry& entry) {
        if (entry.is_regular_file() && is_text(entry.path())) files.push_back(read(top, entry.path()));
    };
    for (const auto& entry : std::filesystem::directory_iterator(top)) add(entry);
    for (const char* part : {"engine", "modules", "editor", "content", "tests"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(top / part)) add(entry);
    return files;
}

void for_each_line(const std::string& text, const std::function<void(const std::string& line, int number)>& body) {
    std::istringstream stream(text);
    int number = 0;
    for (std::string line; std::getline(stream, line);) body(line, ++number);
}

}  // namespace rowland::test
