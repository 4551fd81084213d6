#include "engine/cook/depfile.h"

#include "engine/core/error.h"

namespace rowland::cook {

namespace {

/// As gcc writes names: spaces and # behind a backslash, backslashes before them doubled, $ doubled.
std::string escaped(const std::filesystem::path& path) {
    std::string text;
    std::size_t backslashes = 0;
    for (const char c : path.string()) {
        if (c == '\n' || c == '\r' || c == '\0')
            refuse_input(path.string(), "name", "a line break", "a name that a dependency file can hold",
                         "rename the file");
        if (c == ' ' || c == '\t') text.append(backslashes, '\\');
        if (c == ' ' || c == '\t' || c == '#') text += '\\';
        if (c == '$') text += '$';
        backslashes = c == '\\' ? backslashes + 1 : 0;
        text += c;
    }
    return text;
}

}  // namespace

std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& dependencies) {
    std::string text = escaped(output) + ":";
    for (const std::filesystem::path& dependency : dependencies)
        text += " \\\n  " + escaped(std::filesystem::absolute(dependency));
    return text + "\n";
}

}  // namespace rowland::cook
