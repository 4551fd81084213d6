#include "engine/gpu/compile_log.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "engine/gpu/shader_library.h"

namespace rowland::gpu {

namespace {

/// Parses a log line from its start.
struct Scanner {
    std::string_view rest;

    bool skip(std::string_view text) {
        if (!rest.starts_with(text)) return false;
        rest.remove_prefix(text.size());
        return true;
    }
    std::optional<std::size_t> number() {
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (error != std::errc()) return std::nullopt;
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        return value;
    }
};

/// Reads the position, up to the message; returns the line. The number before it is the source string's, always 0 here.
std::optional<std::size_t> scan_position(Scanner& scanner) {
    const bool has_severity_first = scanner.skip("ERROR: ") || scanner.skip("WARNING: ");
    if (!scanner.number()) return std::nullopt;
    if (scanner.skip("(")) {  // NVIDIA
        const std::optional<std::size_t> line = scanner.number();
        return scanner.skip(") : ") ? line : std::nullopt;
    }
    if (!scanner.skip(":")) return std::nullopt;
    const std::optional<std::size_t> line = scanner.number();
    if (has_severity_first) return scanner.skip(": ") ? line : std::nullopt;
    const bool has_column = scanner.skip("(") && scanner.number() && scanner.skip("): ");  // Mesa
    return has_column ? line : std::nullopt;
}

CompileMessage parse_line(std::string_view line, std::span<const std::string> files) {
    Scanner scanner{line};
    const std::optional<std::size_t> number = scan_position(scanner);
    if (number && *number / lines_per_file < files.size()) {
        return {files[*number / lines_per_file], *number % lines_per_file, std::string(scanner.rest)};
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
