#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "editor/inspector/control_map.h"
#include "engine/platform/input.h"

namespace rowland::inspector {

/// Something that the user can do by a menu, a key, or both.
struct Command {
    std::string menu;    ///< commands of one menu follow each other; empty: in no menu
    std::string name;    ///< empty: a line between others
    std::string keys{};  ///< "Ctrl+Shift+S"; Ctrl and Shift must be down exactly if they are named
    std::optional<platform::Key> key{};
    std::function<void()> run{};
    bool enabled = true;
    bool checked = false;
};

/// Runs the enabled commands whose keys were pressed in this frame.
void run_pressed(std::span<const Command> commands, const platform::InputState& input);

void draw_menu_bar(std::span<const Command> commands, ControlMap& controls);

/// A window that lists what mouse and keys do: the preview, the fields, then each menu's keys.
void draw_help(std::span<const Command> commands, bool& open, ControlMap& controls);

}  // namespace rowland::inspector
