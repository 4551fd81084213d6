#include "engine/core/error.h"

namespace rowland {

namespace {

std::string one_line(const ErrorInfo& info) {
    std::string message = info.file;
    const auto append = [&message](const char* separator, const std::string& text) {
        if (text.empty()) return;
        if (!message.empty()) message += separator;
        message += text;
    };
    append(": ", info.place);
    append(": ", info.found);
    append("; expected ", info.expected);
    append("; ", info.remedy);
    return message;
}

}  // namespace

Error::Error(ErrorInfo info) : std::runtime_error(one_line(info)), info_(std::move(info)) {}

}  // namespace rowland
