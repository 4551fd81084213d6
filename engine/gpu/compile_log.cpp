#include "engine/gpu/compile_log.h"

#include <algorithm>
#include <regex>

#include "engine/gpu/shader_library.h"

namespace rowland::gpu {

namespace {

/// A line's position up to its message: NVIDIA's, Mesa's and others'. The number before the line's is the source
/// string's, always 0 here.
const std::regex& position_pattern() {
    static const std::regex pattern(
        R"(\d{1,9}\((\d{1,9})\) : |\d{1,9}:(\d{1,9})\(\d{1,9}\): |(?:ERROR|WARNING): \d{1,9}:(\d{1,9}): )");
    return pattern;
}

CompileMessage parse_line(std::string_view line, std::span<const std::string> files) {
    std::cmatch match;
    if (std::regex_search(line.data(), line.data() + line.size(), match, position_pattern(),
                          std::regex_constants::match_continuous)) {
        std::size_t number = 0;
        for (std::size_t i = 1; i < match.size(); ++i)
            if (match[i].matched) number = std::stoul(match[i].str());
        if (number / lines_per_file < files.size())
            return {files[number / lines_per_file], number % lines_per_file, match.suffix().str()};
    }
    return {"", 0, std::string(line)};
}

bool is_error(const CompileMessage& message) {
    return message.text.find("warning") == std::string::npos && message.text.find("WARNING") == std::string::npos;
}

}  // namespace

std::vector<CompileMessage> parse_compile_log(std::string_view log, std::span<const std::string> files) {
    std::vector<CompileMessage> messages;
    for (std::size_t start = 0; start < log.size();) {
        const std::size_t end = std::min(log.find('\n', start), log.size());
        const std::string_view line = log.substr(start, end - start);
        if (line.find_first_not_of(" \t\r") != std::string_view::npos) messages.push_back(parse_line(line, files));
        start = end + 1;
    }
    std::stable_partition(messages.begin(), messages.end(), is_error);
    return messages;
}

}  // namespace rowland::gpu
