#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "editor/inspector/control_map.h"
#include "editor/inspector/file_list.h"
#include "editor/inspector/layout.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// The questions that stop everything else: which file, and what becomes of unsaved edits.
class Dialogs {
 public:
    /// `layout` holds the files that were opened last.
    Dialogs(Session& session, Layout& layout) : session_(session), layout_(layout) {}

    void ask_open();
    void ask_save_as() { ask_save_as(nullptr); }
    /// Opens a file; asks first if that would drop unsaved edits.
    void open(const std::filesystem::path& path);
    /// Saves the document; asks for a file if it has none.
    void save() { save(nullptr); }
    /// Runs an action that drops the document; asks first whether to save unsaved edits.
    void unless_lost(std::function<void()> action);

    void draw(ControlMap& controls);

 private:
    enum class Kind { Open, SaveAs, Unsaved };

    void ask(Kind kind, std::string path);
    void ask_save_as(std::function<void()> after);
    void save(std::function<void()> after);
    void draw_file(ControlMap& controls);
    bool draw_path(const FileList& list, ControlMap& controls);
    void draw_list(const FileList& list, ControlMap& controls);
    void draw_kinds(ControlMap& controls);
    void draw_recent(ControlMap& controls);
    void choose(const std::filesystem::path& path);
    void draw_unsaved(ControlMap& controls);

    Session& session_;
    Layout& layout_;
    Kind kind_ = Kind::Open;
    bool asked_ = false;              ///< since the last frame
    bool type_ = false;               ///< the path takes the keyboard in the next frame
    std::string path_;                ///< as typed so far
    std::filesystem::path folder_;    ///< that a relative path is relative to
    std::filesystem::path replaced_;  ///< the file that the user was asked whether to replace
    FileKind shown_ = FileKind::All;
    std::function<void()> after_;  ///< once the edits are saved or discarded
};

}  // namespace rowland::inspector
