#include <imgui.h>

#include <algorithm>

#include "content/demo/hud/windows.h"

namespace rowland::demo {

namespace {

constexpr float kGrabWidth = 14.0F;
constexpr float kHandleRadius = 9.0F;

/// A label whose left edge, or right edge if `to_the_left`, is at `x`.
void draw_label(ImDrawList* list, float x, float y, const std::string& text, bool to_the_left) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const float left = to_the_left ? x - extent.x - 12.0F : x;
    list->AddRectFilled({left, y}, {left + extent.x + 12.0F, y + extent.y + 6.0F},
                        ImGui::GetColorU32(ImGuiCol_WindowBg), 4.0F);
    list->AddText({left + 6.0F, y + 3.0F}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace

std::optional<double> wipe_line(float line, const std::string& left, const std::string& right) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float x = line * size.x;
    ImGui::SetNextWindowPos({x - 0.5F * kGrabWidth, 0.0F});
    ImGui::SetNextWindowSize({kGrabWidth, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::Begin("##wipe", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton("line", {kGrabWidth, size.y});
    const bool held = ImGui::IsItemActive();
    std::optional<double> moved;
    if (held && size.x > 0.0F) moved = std::clamp(static_cast<double>(ImGui::GetIO().MousePos.x / size.x), 0.0, 1.0);
    const bool hot = held || ImGui::IsItemHovered();
    ImGui::End();
    ImGui::PopStyleVar(2);

    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImU32 colour = ImGui::GetColorU32(hot ? ImGuiCol_SliderGrabActive : ImGuiCol_Text);
    list->AddLine({x + 1.0F, 0.0F}, {x + 1.0F, size.y}, IM_COL32(0, 0, 0, 160), 3.0F);
    list->AddLine({x, 0.0F}, {x, size.y}, colour, 1.5F);
    list->AddCircleFilled({x, 0.5F * size.y}, kHandleRadius, colour);
    // Below the title of the folded panel.
    const float top = 10.0F + 1.5F * ImGui::GetFrameHeight();
    draw_label(list, x - 8.0F, top, left, true);
    draw_label(list, x + 8.0F, top, right, false);
    return moved;
}

}  // namespace rowland::demo
