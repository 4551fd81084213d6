// What the engine takes from the system, for a page's worker: one thread, no files, nothing to print on.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"

namespace fmt {

std::string fill(std::string_view pattern, const std::string* texts, std::size_t count) {
    std::string text;
    std::size_t next = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char c = pattern[i];
        if ((c == '{' || c == '}') && i + 1 < pattern.size() && pattern[i + 1] == c) {
            text += c;
            ++i;
        } else if (c == '{') {
            const char number = pattern[i + 1];
            const std::size_t which = number >= '0' && number <= '9' ? static_cast<std::size_t>(number - '0') : next++;
            if (which < count) text += texts[which];
            i = pattern.find('}', i);
        } else {
            text += c;
        }
    }
    return text;
}

}  // namespace fmt

namespace rowland {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
}

Progress::Progress(std::string, std::size_t) : total_(0), visible_(false) {}
Progress::~Progress() = default;
void Progress::advance(std::size_t) {}

void log_line(LogLevel, std::string_view) {}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t, const std::string&) {
    refuse_input(path.string(), "", "a file beside the material", "a material that names no file");
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t) {
    read_file(path, 0);
    return {};
}

}  // namespace rowland
