#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace rowland::inspector {

/// What the names of files say of them. A recipe of a light is a .json file, as a material is.
enum class FileKind { All, Materials, Models, Lights, Tables, Pictures };
inline constexpr std::array kFileKinds = {FileKind::All,    FileKind::Materials, FileKind::Models,
                                          FileKind::Lights, FileKind::Tables,    FileKind::Pictures};

/// "materials (.json)".
const char* file_kind_name(FileKind kind);
/// Whether a file's name is of a kind; All: of any other kind.
bool is_of_kind(const std::filesystem::path& file, FileKind kind);

struct ListedFile {
    std::string name;
    bool folder = false;
};

/// What the file dialog shows for a typed path.
struct FileList {
    std::filesystem::path folder;   ///< absolute
    std::vector<ListedFile> files;  ///< folders first, then files of the kind, each by name
    std::string completed;          ///< the typed path, as far as all listed names go on with the same letters
};

/// The absolute path that a typed one means: relative to `folder`, or to the user's home if it begins with "~/".
std::filesystem::path resolved(const std::string& typed, const std::filesystem::path& folder);

/// Lists the folder of a typed path. What is typed after the last slash is the beginning of the names, in capitals or
/// not. Hidden files are listed if the typed name begins with a dot. A folder that cannot be read gives no files.
FileList list_files(const std::string& typed, const std::filesystem::path& folder, FileKind kind);

}  // namespace rowland::inspector
