#pragma once

struct ImGuiIO;
struct ImGuiStyle;

namespace rowland::ui {

/// The style of all our programs: dark and neutral, so that it does not affect the perception of colours beside it.
ImGuiStyle make_style(float scale);

/// Loads the font at `scale`: DejaVu Sans with Greek letters, arrows and mathematical signs; or ImGui's own, with Latin
/// letters only, if the system does not have it.
void load_font(ImGuiIO& io, float scale);

}  // namespace rowland::ui
