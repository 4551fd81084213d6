#include "engine/core/error.h"

#include <fmt/format.h>

namespace rowland {

namespace {

/// Longest text of one field in the message; a hostile file may hold a key of megabytes.
constexpr std::size_t kMaximumFieldSize = 400;

/// `text` as part of a line: control characters as \xNN, the middle of an overlong text left out.
std::string printable(std::string text) {
    if (text.size() > kMaximumFieldSize) {
        // Whole UTF-8 characters only: a cut never falls before a continuation byte.
        const auto continues = [&text](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
        std::size_t head = kMaximumFieldSize / 2;
        std::size_t tail = text.size() - kMaximumFieldSize / 2;
        while (head > 0 && continues(head)) --head;
        while (tail < text.size() && continues(tail)) ++tail;
        text = text.substr(0, head) + "..." + text.substr(tail);
    }
    std::string line;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7f)
            line += fmt::format("\\x{:02x}", code);
        else
            line += c;
    }
    return line;
}

std::string one_line(const ErrorInfo& info) {
    std::string message = printable(info.file);
    const auto append = [&message](const char* separator, const std::string& text) {
        if (text.empty()) return;
        if (!message.empty()) message += separator;
        message += printable(text);
    };
    append(": ", info.location);
    append(": ", info.found);
    append("; expected ", info.expected);
    append("; ", info.remedy);
    return message;
}

}  // namespace

Error::Error(ErrorInfo info) : std::runtime_error(one_line(info)), info_(std::move(info)) {}

void refuse_input(std::string file, std::string location, std::string found, std::string expected, std::string remedy) {
    throw Error({.file = std::move(file),
                 .location = std::move(location),
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = std::move(remedy)});
}

void fail_system(std::string file, std::string found, std::string remedy, std::string expected) {
    throw Error({.file = std::move(file),
                 .location = {},
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = std::move(remedy),
                 .fault = Fault::System});
}

}  // namespace rowland
