#pragma once

#include <functional>
#include <string>

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// The questions that stop everything else: which file, and whether to lose edits.
class Dialogs {
 public:
    explicit Dialogs(Session& session) : session_(session) {}

    void ask_open() { ask(Kind::Open, {}); }
    void ask_save_as();
    /// Saves the document; asks for a file if it has none.
    void save();
    /// Runs an action that drops the document; asks first if it has unsaved edits.
    void unless_lost(std::function<void()> action);

    void draw(ControlMap& controls);

 private:
    enum class Kind { Open, SaveAs, Discard };

    void ask(Kind kind, std::string path);
    void draw_path(const char* button, ControlMap& controls);
    void draw_discard(ControlMap& controls);

    Session& session_;
    Kind kind_ = Kind::Open;
    bool asked_ = false;  ///< since the last frame
    std::string path_;    ///< as typed so far
    std::function<void()> after_discard_;
};

}  // namespace rowland::inspector
