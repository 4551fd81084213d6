#include "engine/core/windows_text.h"

#include <windows.h>

#include <algorithm>
#include <cwchar>
#include <utility>

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

}  // namespace rowland

/// libstdc++ makes paths of narrow texts by mbrtowc(), which in msvcrt.dll knows the user's code page alone. The linker
/// puts this function in its stead (CMakeLists.txt), for UTF-8. A character that is two units of UTF-16 comes in two
/// calls: the first takes three of its four bytes and leaves in `state` what the second needs.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* unit, const char* text, std::size_t size, std::mbstate_t* state) {
    constexpr auto kWrong = static_cast<std::size_t>(-1);
    constexpr auto kIncomplete = static_cast<std::size_t>(-2);
    static std::mbstate_t own_state{};
    std::mbstate_t& left = state == nullptr ? own_state : *state;
    if (text == nullptr) {
        left = {};
        return 0;
    }
    if (size == 0) return kIncomplete;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xc0) == 0x80; };
    const auto give = [&](unsigned value, std::size_t length) {
        if (unit != nullptr) *unit = static_cast<wchar_t>(value);
        return value == 0 ? 0 : length;
    };
    if (left != 0) {
        const auto upper = static_cast<unsigned>(std::exchange(left, 0)) & 0xfU;
        return continues(0) ? give(0xdc00U | upper << 6 | (byte(0) & 0x3fU), 1) : kWrong;
    }
    if (byte(0) < 0x80) return give(byte(0), 1);
    const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4) return kWrong;
    for (std::size_t i = 1; i < std::min(size, length); ++i)
        if (!continues(i)) return kWrong;
    if (size < length) return kIncomplete;
    unsigned code = byte(0) & (0xffU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte(i) & 0x3fU);
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    if (overlong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return kWrong;
    if (length < 4) return give(code, length);
    left = static_cast<std::mbstate_t>(0x10U | (code >> 6 & 0xfU));
    return give(0xd800U + ((code - 0x10000) >> 10), 3);
}

namespace rowland {

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
