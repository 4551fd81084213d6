#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "engine/core/system.h"

namespace rowland {

namespace {

/// The folder that a variable names; nullopt if it is not set or empty.
std::optional<std::filesystem::path> named_folder(const char* variable) {
    const char* folder = std::getenv(variable);
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return folder;
}

/// The folder that `variable` names, else `below` in the home folder: the XDG Base Directory Specification.
std::optional<std::filesystem::path> xdg_folder(const char* variable, const char* below) {
    if (auto named = named_folder(variable)) return named;
    const auto home = home_folder();
    return home ? std::optional(*home / below) : std::nullopt;
}

}  // namespace

std::filesystem::path program_file() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
}

std::filesystem::path code_file() {
    Dl_info library{};
    // For code in the program itself dladdr() gives argv[0].
    if (dladdr(reinterpret_cast<const void*>(&code_file), &library) == 0) return {};
    return library.dli_fname;
}

std::optional<std::filesystem::path> find_program(const std::filesystem::path& folder, const std::string& name) {
    std::filesystem::path program = folder / name;
    if (::access(program.c_str(), X_OK) != 0) return std::nullopt;
    return program;
}

bool takes_files(const std::filesystem::path& folder) {
    return ::access(folder.c_str(), W_OK) == 0;
}

std::optional<std::string> environment_variable(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

void set_default_variable(const std::string& name, const std::string& value) {
    constexpr int kKeep = 0;
    ::setenv(name.c_str(), value.c_str(), kKeep);
}

std::vector<std::string> utf8_arguments(int argc, const char* const* argv) {
    return {argv, argv + argc};
}

void prepare_standard_streams() {}

bool error_stream_is_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
}

std::size_t resident_set_bytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t all_pages = 0;
    std::size_t resident_pages = 0;
    if (!(file >> all_pages >> resident_pages)) return 0;
    return resident_pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::optional<std::filesystem::path> home_folder() {
    return named_folder("HOME");
}

std::optional<std::filesystem::path> settings_folder() {
    return xdg_folder("XDG_CONFIG_HOME", ".config");
}

std::optional<std::filesystem::path> cache_folder() {
    return xdg_folder("XDG_CACHE_HOME", ".cache");
}

}  // namespace rowland
