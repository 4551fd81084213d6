#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rowland::test {

/// A text file of the source tree, by its path from the top.
struct TreeFile {
    std::string path;
    std::string text;
};

/// Sources, pages, CMake files and scripts under engine, modules, editor, content, tests and at the top, but no data.
std::vector<TreeFile> tree_files();

/// Calls body(line, number) for each line; numbers begin at 1.
void for_each_line(const std::string& text, const std::function<void(const std::string& line, int number)>& body);

}  // namespace rowland::test
