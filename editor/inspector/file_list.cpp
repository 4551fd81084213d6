#include "editor/inspector/file_list.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <system_error>

namespace rowland::inspector {

namespace {

/// ASCII letters in lower case; other bytes as they are.
std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

/// Extensions as file_kind_name() lists them.
bool names_extension(FileKind kind, const std::string& extension) {
    const std::string name = file_kind_name(kind);
    return !extension.empty() &&
           (name.find(extension + ",") != std::string::npos || name.find(extension + ")") != std::string::npos);
}

/// The letters that all names begin with.
std::string common_beginning(const std::vector<ListedFile>& files) {
    if (files.empty()) return {};
    std::string common = files.front().name;
    for (const ListedFile& file : files)
        common.resize(static_cast<std::size_t>(std::ranges::mismatch(common, file.name).in1 - common.begin()));
    return common;
}

}  // namespace

const char* file_kind_name(FileKind kind) {
    constexpr std::array kNames = {"all kinds",
                                   "materials (.json)",
                                   "models (.gltf, .glb)",
                                   "lights (.hdr, .exr, .pic, .json)",
                                   "tables of efficiencies (.csv)",
                                   "pictures of grooves (.png, .jpg, .jpeg)"};
    return kNames.at(static_cast<std::size_t>(kind));
}

bool is_of_kind(const std::filesystem::path& file, FileKind kind) {
    const std::string extension = lower(file.extension().string());
    if (kind != FileKind::All) return names_extension(kind, extension);
    return std::ranges::any_of(kFileKinds, [&](FileKind each) { return names_extension(each, extension); });
}

std::filesystem::path resolved(const std::string& typed, const std::filesystem::path& folder) {
    const char* home = std::getenv("HOME");
    if (home != nullptr && typed.starts_with("~/")) return std::filesystem::path(home) / typed.substr(2);
    return folder / typed;
}

FileList list_files(const std::string& typed, const std::filesystem::path& folder, FileKind kind) {
    const std::filesystem::path path = resolved(typed, folder);
    const std::string beginning = path.filename().string();
    FileList list{.folder = path.parent_path(), .files = {}, .completed = typed};
    std::error_code failure;
    std::filesystem::directory_iterator entry(list.folder, failure);
    for (; !failure && entry != std::filesystem::directory_iterator(); entry.increment(failure)) {
        const std::string name = entry->path().filename().string();
        if (!lower(name).starts_with(lower(beginning)) || (name.starts_with('.') && !beginning.starts_with('.')))
            continue;
        std::error_code unknown;
        const bool is_folder = entry->is_directory(unknown);
        if (is_folder || is_of_kind(name, kind)) list.files.push_back({name, is_folder});
    }
    std::ranges::sort(list.files, [](const ListedFile& a, const ListedFile& b) {
        return a.folder != b.folder ? a.folder : std::pair(lower(a.name), a.name) < std::pair(lower(b.name), b.name);
    });
    const std::string common = common_beginning(list.files);
    if (common.size() >= beginning.size() && !list.files.empty())
        list.completed = typed.substr(0, typed.size() - beginning.size()) + common +
                         (list.files.size() == 1 && list.files.front().folder ? "/" : "");
    return list;
}

}  // namespace rowland::inspector
