#include "engine/ui/style.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "engine/core/log.h"

namespace rowland::ui {

namespace {

constexpr float kFontSize = 15.0F;         ///< pixels at scale 1
constexpr float kBuiltInFontSize = 13.0F;  ///< of ImGui's own font

/// First and last of each range, then 0: Latin, Greek, general punctuation, super- and subscripts, arrows, mathematics,
/// geometric shapes.
constexpr std::array<ImWchar, 15> kGlyphs = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2044, 0x2070, 0x209F,
                                             0x2190, 0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF, 0};

ImVec4 grey(float value, float alpha = 1.0F) {
    return {value, value, value, alpha};
}

/// A blue that is distinguishable with all kinds of colour vision.
ImVec4 accent(float alpha) {
    return {0.26F, 0.55F, 0.85F, alpha};
}

void set_colours(ImGuiStyle& style) {
    ImGui::StyleColorsDark(&style);
    const auto set = [&style](ImGuiCol which, const ImVec4& colour) { style.Colors[which] = colour; };
    set(ImGuiCol_Text, grey(0.93F));
    set(ImGuiCol_TextDisabled, grey(0.60F));
    set(ImGuiCol_WindowBg, grey(0.08F, 0.86F));
    set(ImGuiCol_PopupBg, grey(0.10F, 0.96F));
    set(ImGuiCol_Border, grey(1.0F, 0.10F));
    set(ImGuiCol_TitleBg, grey(0.12F, 0.92F));
    set(ImGuiCol_TitleBgActive, grey(0.18F, 0.96F));
    set(ImGuiCol_TitleBgCollapsed, grey(0.12F, 0.70F));
    set(ImGuiCol_FrameBg, grey(1.0F, 0.09F));
    set(ImGuiCol_FrameBgHovered, grey(1.0F, 0.15F));
    set(ImGuiCol_FrameBgActive, grey(1.0F, 0.20F));
    set(ImGuiCol_Button, grey(1.0F, 0.12F));
    set(ImGuiCol_ButtonHovered, accent(0.60F));
    set(ImGuiCol_ButtonActive, accent(0.90F));
    set(ImGuiCol_Header, grey(1.0F, 0.10F));
    set(ImGuiCol_HeaderHovered, accent(0.45F));
    set(ImGuiCol_HeaderActive, accent(0.70F));
    set(ImGuiCol_CheckMark, accent(1.0F));
    set(ImGuiCol_SliderGrab, accent(0.85F));
    set(ImGuiCol_SliderGrabActive, accent(1.0F));
    set(ImGuiCol_PlotLines, accent(1.0F));
    set(ImGuiCol_PlotHistogram, accent(0.85F));
    set(ImGuiCol_NavHighlight, accent(1.0F));
}

}  // namespace

ImGuiStyle make_style(float scale) {
    ImGuiStyle style;
    set_colours(style);
    style.WindowRounding = 5.0F;
    style.FrameRounding = 3.0F;
    style.GrabRounding = 3.0F;
    style.PopupRounding = 4.0F;
    style.ScrollbarRounding = 4.0F;
    style.WindowPadding = {10.0F, 8.0F};
    style.FramePadding = {6.0F, 3.0F};
    style.ItemSpacing = {7.0F, 4.0F};
    style.ScaleAllSizes(scale);
    return style;
}

void load_font(ImGuiIO& io, float scale) {
    io.Fonts->Clear();
    // Checked first, since ImGui asserts that the file exists.
    std::error_code ignored;
    if (std::filesystem::is_regular_file(ROWLAND_UI_FONT, ignored) &&
        io.Fonts->AddFontFromFileTTF(ROWLAND_UI_FONT, std::round(kFontSize * scale), nullptr, kGlyphs.data()) !=
            nullptr)
        return;
    log_warning("{} is missing: text of the user interface has Latin letters only", ROWLAND_UI_FONT);
    ImFontConfig config;
    config.SizePixels = std::round(kBuiltInFontSize * scale);
    io.Fonts->AddFontDefault(&config);
}

}  // namespace rowland::ui
