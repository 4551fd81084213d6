#include <imgui.h>

#include <algorithm>

#include "content/demo/hud/windows.h"
#include "content/demo/play/action.h"
#include "engine/platform/key.h"

namespace rowland::demo {

void help_window(bool& open) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = std::min(34.0F * ImGui::GetFontSize(), size.x - 20.0F);
    ImGui::SetNextWindowPos({size.x - 10.0F, 10.0F}, ImGuiCond_Always, {1.0F, 0.0F});
    ImGui::SetNextWindowSize({width, size.y - 20.0F});
    ImGui::SetNextWindowBgAlpha(0.96F);
    if (ImGui::Begin("Controls", &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove) &&
        ImGui::BeginTable("controls", 2, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("control", ImGuiTableColumnFlags_WidthFixed, 12.5F * ImGui::GetFontSize());
        ImGui::TableSetupColumn("what");
        std::string group;
        for (const HelpLine& line : help_lines()) {
            if (group != line.group) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", (group = line.group).c_str());
            }
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.control.c_str());
            ImGui::TableNextColumn();
            ImGui::TextWrapped("%s", line.what.c_str());
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void hint_line() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto key = [](Action action) { return std::string(platform::name_of(row_of(action).key)); };
    const std::string text = key(Action::Help) + " controls    " + key(Action::Hud) + " panels    " +
                             key(Action::FrameGraph) + " times    " + key(Action::Wipe) + " wipe    " +
                             key(Action::Close) + " quit";
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 at(20.0F, size.y - extent.y - 14.0F);
    list->AddRectFilled({at.x - 10.0F, at.y - 4.0F}, {at.x + extent.x + 10.0F, at.y + extent.y + 4.0F},
                        ImGui::GetColorU32(ImGuiCol_WindowBg), 5.0F);
    list->AddText(at, ImGui::GetColorU32(ImGuiCol_TextDisabled), text.c_str());
}

}  // namespace rowland::demo
