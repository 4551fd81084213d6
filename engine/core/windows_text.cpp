#include "engine/core/windows_text.h"

#include <windows.h>

namespace rowland {

std::wstring utf16(std::string_view text) {
    const int size = static_cast<int>(text.size());
    std::wstring wide(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), size, nullptr, 0)), L'\0');
    MultiByteToWideChar(CP_UTF8, 0, text.data(), size, wide.data(), static_cast<int>(wide.size()));
    return wide;
}

std::string utf8(std::wstring_view text) {
    const int size = static_cast<int>(text.size());
    std::string narrow(
        static_cast<std::size_t>(WideCharToMultiByte(CP_UTF8, 0, text.data(), size, nullptr, 0, nullptr, nullptr)),
        '\0');
    WideCharToMultiByte(CP_UTF8, 0, text.data(), size, narrow.data(), static_cast<int>(narrow.size()), nullptr,
                        nullptr);
    return narrow;
}

std::wstring long_path(const std::filesystem::path& path) {
    constexpr std::size_t kLongestPlain = 240;  // with room for the 8.3 name that a folder needs
    std::error_code failure;
    std::filesystem::path whole = std::filesystem::absolute(path, failure);
    if (failure || whole.native().size() < kLongestPlain || whole.native().starts_with(LR"(\\)")) return path.native();
    // With this prefix Windows takes the path as it is, so it must be in its normal form.
    return LR"(\\?\)" + whole.lexically_normal().make_preferred().native();
}

namespace {

/// In quotes, with backslashes doubled before quotes.
std::wstring quoted_argument(std::wstring_view argument) {
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t letter : argument) {
        if (letter == L'"') text.append(backslashes + 1, L'\\');
        backslashes = letter == L'\\' ? backslashes + 1 : 0;
        text += letter;
    }
    return text.append(backslashes, L'\\') + L'"';
}

}  // namespace

std::wstring command_line(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    std::wstring command = quoted_argument(program.native());
    for (const std::string& argument : arguments) command += L' ' + quoted_argument(utf16(argument));
    return command;
}

namespace {

/// std::system_category() may give the text in the user's code page.
class WindowsCategory : public std::error_category {
 public:
    const char* name() const noexcept override { return "windows"; }
    std::string message(int code) const override {
        wchar_t text[512];
        const DWORD size =
            FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS | FORMAT_MESSAGE_MAX_WIDTH_MASK,
                           nullptr, static_cast<DWORD>(code), 0, text, static_cast<DWORD>(std::size(text)), nullptr);
        std::string message = utf8({text, size});
        message.erase(message.find_last_not_of(" .") + 1);
        return message.empty() ? "error " + std::to_string(code) : message;
    }
};

}  // namespace

std::error_code last_windows_failure() {
    static const WindowsCategory category;
    return {static_cast<int>(GetLastError()), category};
}

}  // namespace rowland
