#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "editor/inspector/layout.h"
#include "editor/inspector/session.h"
#include "editor/inspector/widgets.h"

namespace rowland::inspector {

/// Kinds of files by their extensions. Both materials and recipes of lights are .json files.
enum class FileKind { All, Materials, Models, Lights, Tables, Pictures, Films };
inline constexpr std::array kFileKinds = {FileKind::All,    FileKind::Materials, FileKind::Models,
                                          FileKind::Lights, FileKind::Tables,    FileKind::Pictures};

/// "materials (.json)".
const char* file_kind_name(FileKind kind);
/// Whether the extension of a file is of the kind; All: of any of the other kinds.
bool is_of_kind(const std::filesystem::path& file, FileKind kind);

struct ListedFile {
    std::string name;
    bool folder = false;
};

/// The files that the dialog shows for a typed path.
struct FileList {
    std::filesystem::path folder;   ///< absolute
    std::vector<ListedFile> files;  ///< folders first, then files of the kind, each by name
    std::string completed;          ///< the typed path with the longest common beginning of all listed names
};

/// The absolute path of a typed one: relative to `folder`, or to the user's home if it begins with "~/".
std::filesystem::path resolved(const std::string& typed, const std::filesystem::path& folder);

/// Lists the files in the folder of a typed path whose names begin with the text after the last slash, in upper or
/// lower case. Hidden files are listed if that text begins with a dot. A folder that cannot be read gives no files.
FileList list_files(const std::string& typed, const std::filesystem::path& folder, FileKind kind);

/// The modal dialogs: open, save as, unsaved edits, their recovery, overwriting the changes of another program.
class Dialogs {
 public:
    /// `layout` holds the files that were opened last.
    Dialogs(Session& session, Layout& layout) : session_(session), layout_(layout) {}

    using Use = std::function<void(const std::filesystem::path&)>;

    void ask_open();
    void ask_save_as() { ask_save_as(nullptr); }
    /// Asks for a picture, which `use` gets. `words`: what for.
    void ask_picture(std::string words, Use use);
    /// Asks for a file to write, which `use` gets; one that exists must be confirmed.
    void ask_file(FileKind kind, std::string words, const std::filesystem::path& suggested, Use use);
    /// Opens a file; asks first if unsaved edits would be lost.
    void open(const std::filesystem::path& path);
    /// Saves the document; asks for a file if it has none.
    void save() { save(nullptr); }
    /// Runs an action that replaces the document; asks first whether to save unsaved edits.
    void ask_unsaved(std::function<void()> action);
    /// Offers to open the edits of a session that ended before they were saved.
    void offer_recovery(const std::filesystem::path& unsaved);

    void draw(ControlMap& controls);

 private:
    enum class Kind { Open, SaveAs, Unsaved, Recovery };

    void ask(Kind kind, std::string path);
    std::string folder_of_recent() const;
    void ask_save_as(std::function<void()> after);
    void save(std::function<void()> after);
    void draw_file(ControlMap& controls);
    bool draw_path(const FileList& list, ControlMap& controls);
    void draw_list(const FileList& list, ControlMap& controls);
    void draw_kinds(ControlMap& controls);
    void draw_recent(ControlMap& controls);
    void choose(const std::filesystem::path& path);
    void draw_unsaved(ControlMap& controls);
    void draw_recovery(ControlMap& controls);
    void draw_overwrite(ControlMap& controls);

    Session& session_;
    Layout& layout_;
    Kind kind_ = Kind::Open;
    bool asked_ = false;              ///< the dialog opens in the next frame
    bool focus_path_ = false;         ///< the path takes the keyboard in the next frame
    std::string path_;                ///< as typed so far
    std::filesystem::path folder_;    ///< of relative paths
    std::filesystem::path replaced_;  ///< the file whose replacement the user has to confirm
    FileKind shown_ = FileKind::All;
    std::string words_;            ///< above the path
    Use use_;                      ///< of the chosen file; null: it is the document's
    std::function<void()> after_;  ///< once the edits are saved or discarded
};

}  // namespace rowland::inspector
