#include "engine/core/system.h"

#include <windows.h>
//
#include <fcntl.h>
#include <io.h>
#include <psapi.h>
#include <shellapi.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "engine/core/windows_text.h"

namespace rowland {

namespace {

/// The file of a module; null: of the program.
std::filesystem::path module_file(HMODULE module) {
    std::wstring name(MAX_PATH, L'\0');
    while (true) {
        const DWORD size = GetModuleFileNameW(module, name.data(), static_cast<DWORD>(name.size()));
        if (size < name.size()) return name.substr(0, size);
        name.resize(2 * name.size());
    }
}

std::optional<std::filesystem::path> named_folder(const char* variable) {
    const auto folder = environment_variable(variable);
    if (!folder || folder->empty()) return std::nullopt;
    return std::filesystem::path(utf16(*folder));
}

/// A console's code page before this program; 0: unknown.
UINT former_code_page = 0;

}  // namespace

std::filesystem::path program_file() {
    return module_file(nullptr);
}

std::filesystem::path code_file() {
    HMODULE module = nullptr;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<const wchar_t*>(&code_file), &module);
    return module_file(module);
}

std::optional<std::filesystem::path> find_program(const std::filesystem::path& folder, const std::string& name) {
    std::filesystem::path program = folder / utf16(name);
    if (program.extension() != ".exe") program += ".exe";
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(program, unknown)) return std::nullopt;
    return program;
}

bool takes_files(const std::filesystem::path& folder) {
    // Access lists say less than a trial.
    const std::wstring name = long_path(folder / (".rowland-" + std::to_string(GetCurrentProcessId())));
    const HANDLE trial =
        CreateFileW(name.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW, FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (trial == INVALID_HANDLE_VALUE) return false;
    CloseHandle(trial);
    return true;
}

std::optional<std::string> environment_variable(const std::string& name) {
    const std::wstring wide_name = utf16(name);
    std::wstring value(256, L'\0');
    while (true) {
        SetLastError(ERROR_SUCCESS);
        const DWORD size = GetEnvironmentVariableW(wide_name.c_str(), value.data(), static_cast<DWORD>(value.size()));
        if (size == 0 && GetLastError() == ERROR_ENVVAR_NOT_FOUND) return std::nullopt;
        if (size < value.size()) return utf8(std::wstring_view(value).substr(0, size));
        value.resize(size);
    }
}

void set_default_variable(const std::string& name, const std::string& value) {
    // Sets the system's variable as well as that of the C library.
    if (!environment_variable(name)) _wputenv_s(utf16(name).c_str(), utf16(value).c_str());
}

std::vector<std::string> utf8_arguments(int argc, const char* const* argv) {
    std::vector<std::string> given(argv, argv + argc);
    int count = 0;
    const std::unique_ptr<wchar_t*, void (*)(wchar_t**)> wide(CommandLineToArgvW(GetCommandLineW(), &count),
                                                              [](wchar_t** texts) { LocalFree(texts); });
    if (!wide || count != argc) return given;
    std::vector<std::string> original;
    for (int i = 0; i < count; ++i) {
        const std::wstring_view text = wide.get()[i];
        // `argv` is not main()'s if it is not what the C library made of the command line.
        std::string narrow(3 * text.size(), '\0');
        narrow.resize(static_cast<std::size_t>(WideCharToMultiByte(CP_ACP, 0, text.data(),
                                                                   static_cast<int>(text.size()), narrow.data(),
                                                                   static_cast<int>(narrow.size()), nullptr, nullptr)));
        if (narrow != given[static_cast<std::size_t>(i)]) return given;
        original.push_back(utf8(text));
    }
    return original;
}

void prepare_standard_streams() {
    for (std::FILE* stream : {stdin, stdout, stderr}) _setmode(_fileno(stream), _O_BINARY);
    if (former_code_page != 0) return;
    former_code_page = GetConsoleOutputCP();
    if (former_code_page == 0) return;  // no console
    SetConsoleOutputCP(CP_UTF8);
    std::atexit([] { SetConsoleOutputCP(former_code_page); });
    // Progress erases its line with an escape sequence.
    const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
    if (DWORD mode = 0; GetConsoleMode(console, &mode) != 0)
        SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

bool error_stream_is_terminal() {
    DWORD mode = 0;
    return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

std::size_t resident_set_bytes() {
    PROCESS_MEMORY_COUNTERS counters{};
    if (K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) == 0) return 0;
    return counters.WorkingSetSize;
}

std::optional<std::filesystem::path> home_folder() {
    return named_folder("USERPROFILE");
}

std::optional<std::filesystem::path> settings_folder() {
    return named_folder("APPDATA");
}

std::optional<std::filesystem::path> cache_folder() {
    return named_folder("LOCALAPPDATA");
}

}  // namespace rowland
