#include "engine/core/program.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/system.h"

namespace rowland {

int run_program(const std::function<int()>& body) {
    try {
        prepare_standard_streams();
        const int code = body();
        // A full disk or a closed pipe is noticed only when the buffer is written.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            fail_system("standard output", fmt::format("writing failed: {}", std::strerror(errno)));
        return code;
    } catch (const Error& error) {
        log_error("{}", error.what());
        return error.info().fault == Fault::Input ? 2 : 1;
    } catch (const std::bad_alloc&) {
        log_error("out of memory");
        return 1;
    } catch (const std::exception& error) {
        log_error("{}", error.what());
        return 1;
    }
}

[[gnu::weak]] const char* installed_helper_folder() {
    return ROWLAND_INSTALLED_HELPER_FOLDER;
}

namespace {

std::vector<std::filesystem::path> helper_folders() {
    if (const auto named = environment_variable("ROWLAND_HELPER_FOLDER")) return {*named};
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& file : {program_file(), code_file()}) {
        const std::filesystem::path folder = file.parent_path();
        // The path of the code may be relative, or into the same folder.
        if (!folder.is_absolute() || (!folders.empty() && folder == folders.front())) continue;
        folders.push_back(folder);
        folders.push_back((folder / ROWLAND_HELPER_FOLDER_FROM_BIN).lexically_normal());
    }
    folders.emplace_back(installed_helper_folder());
    return folders;
}

}  // namespace

std::filesystem::path helper_program(const std::string& name) {
    std::string looked_at;
    for (const std::filesystem::path& folder : helper_folders()) {
        if (const auto program = find_program(folder, name)) return *program;
        looked_at += (looked_at.empty() ? "" : ", ") + folder.string();
    }
    fail_system(name, "not in " + looked_at, "install Rowland again, or name its folder in ROWLAND_HELPER_FOLDER",
                "a helper program of Rowland");
}

std::filesystem::path program_prefix() {
    return program_file().parent_path().parent_path();
}

std::filesystem::path resources_folder(const std::filesystem::path& sources) {
    std::error_code unknown;
    if (std::filesystem::exists(sources / "content", unknown)) return sources;
    return program_prefix();
}

std::string version_text(const std::string& program) {
    std::string commit;
    for (const std::filesystem::path& folder : helper_folders())
        if (std::ifstream file(folder / "commit"); commit.empty()) std::getline(file, commit);
    return fmt::format("{} {}, commit {}, {}", program, ROWLAND_VERSION, commit.empty() ? "unknown" : commit,
                       ROWLAND_COMPILER);
}

}  // namespace rowland
