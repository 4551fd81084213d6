#pragma once

struct ImGuiIO;
struct ImGuiStyle;

namespace rowland::ui {

/// The look of all our programs: dark and neutral, so that it tints no judgement of colours beside it, with one accent.
ImGuiStyle make_style(float scale);

/// Loads the one font at `scale`: DejaVu Sans with Greek letters, arrows and mathematical signs; where the system has
/// not got it, ImGui's own, which has Latin letters only.
void load_font(ImGuiIO& io, float scale);

}  // namespace rowland::ui
