#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspector/preview_object.h"

namespace rowland::inspector {

/// The state of the window that is restored at the next start.
struct Layout {
    int width = 1280;
    int height = 800;
    float scale = 1.0F;         ///< of text and controls
    float material_width = 22;  ///< of the column of fields; this and the next two are in font heights
    float physics_width = 26;
    float price_height = 17;
    std::string shape = "disc";
    std::vector<std::string> recent{};  ///< absolute paths of files that were opened or saved, newest first
    std::string light;                  ///< path of the last probe; empty: the first shipped one
    std::string unsaved{};              ///< path of edits that no other file holds; empty: none
    Stage stage{};
};

/// Moves a file to the front of `recent`, which keeps ten.
void remember(Layout& layout, const std::filesystem::path& path);

/// Reads a layout. Missing members have their defaults, and numbers are clamped to their ranges. A missing file gives
/// the default layout. Wrong syntax or a member of another type is logged as a warning and ends the reading.
Layout load_layout(const std::filesystem::path& path);

/// Throws Error (system).
void save_layout(const Layout& layout, const std::filesystem::path& path);

/// $XDG_CONFIG_HOME/rowland/inspector.json, else ~/.config/rowland/inspector.json; nullopt without either variable.
std::optional<std::filesystem::path> default_layout_file();

}  // namespace rowland::inspector
