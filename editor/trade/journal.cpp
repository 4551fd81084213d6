#include "editor/trade/journal.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::trade {

namespace {

constexpr std::uint64_t kLargestJournal = std::uint64_t{1} << 31;

FileLock open_alone(const std::filesystem::path& path) {
    if (path.has_parent_path()) create_folder(path.parent_path());
    std::optional<FileLock> file = FileLock::try_take(path);
    if (!file)
        refuse_input(path.string(), "", "a file that another process writes", "one sweep at a time in a folder",
                     "wait for it, or name another folder");
    return std::move(*file);
}

}  // namespace

Journal::Journal(std::filesystem::path path) : path_(std::move(path)), file_(open_alone(path_)) {
    const std::string text = read_text_file(path_, kLargestJournal);
    const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    int line_number = 0;
    for (std::size_t begin = 0; begin < whole;) {
        const std::size_t end = text.find('\n', begin);
        ++line_number;
        const auto line = nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                                text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        if (!line.is_object() || !line.contains("key") || !line["key"].is_string() || !line.contains("value"))
            refuse_input(path_.string(), fmt::format("line {}", line_number), "no entry of a journal",
                         "{\"key\": …, \"value\": …}", "remove the line, or the file");
        entries_[line["key"]] = line["value"];
        begin = end + 1;
    }
    if (whole < text.size()) file_.cut(whole);  // an incomplete line
}

const nlohmann::json* Journal::find(const std::string& key) const {
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : &found->second;
}

void Journal::add(const std::string& key, nlohmann::json value) {
    file_.append(nlohmann::json{{"key", key}, {"value", value}}.dump() + "\n");
    entries_[key] = std::move(value);
}

}  // namespace rowland::trade
