#include "engine/core/outputs.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland {

namespace {

/// Two paths lead to one file exactly if they have a key in common: the path without links, or the inode.
std::vector<std::string> keys_of(const std::filesystem::path& path) {
    std::error_code code;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(path), code);
    std::vector<std::string> keys{code ? path.string() : canonical.string()};
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0) keys.push_back(fmt::format("{}:{}", status.st_dev, status.st_ino));
    return keys;
}

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return text;
}

}  // namespace

void check_outputs(std::span<const std::filesystem::path> inputs, std::span<const Output> outputs) {
    std::map<std::string, std::string> users;  // of each key
    for (const std::filesystem::path& input : inputs)
        for (const std::string& key : keys_of(input)) users.emplace(key, "an input");
    for (const auto& [option, path, extension] : outputs) {
        const std::string file = fmt::format("{} {}", option, path.string());
        if (!extension.empty() && lower_case(path.extension().string()) != lower_case(extension))
            refuse_input(file, {}, fmt::format("the extension \"{}\"", path.extension().string()), extension,
                         "name the file by its format");
        const std::vector<std::string> keys = keys_of(path);
        for (const std::string& key : keys)
            if (const auto user = users.find(key); user != users.end())
                refuse_input(file, {}, "the same file as " + user->second, "a file of its own", "name another file");
        for (const std::string& key : keys) users.emplace(key, "the output of " + option);
        try {
            require_writable(path);
        } catch (const Error& error) {
            refuse_input(file, {}, error.info().found, "a file that can be written", "name another file");
        }
    }
}

}  // namespace rowland
