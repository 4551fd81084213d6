#include "editor/inspector/command.h"

#include <imgui.h>

#include <algorithm>

namespace rowland::inspector {

namespace {

constexpr std::pair<const char*, const char*> kPreview[] = {
    {"Drag", "orbit"},
    {"Drag the lamp's handle", "move the lamp"},
    {"Drag the line of A/B", "more of the saved version, or less"},
    {"Wheel", "zoom"},
    {"Click", "pick the point that the physics is of"},
};
constexpr std::pair<const char*, const char*> kFields[] = {
    {"Drag a number", "change it"},
    {"Ctrl+click a number", "type it"},
    {"Hover", "meaning, range and source of the formula"},
    {"Tab, arrows", "move through all controls"},
    {"Space, Enter", "use a control"},
    {"Ctrl+Tab", "the next panel"},
};

void help_heading(const char* name) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
}

void help_row(const char* keys, const char* what) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(keys);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", what);
}

}  // namespace

void run_pressed(std::span<const Command> commands, const platform::InputState& input) {
    using platform::Key;
    // A long frame may hold both the press and the release of a modifier.
    const auto held = [&](Key left, Key right) {
        return input.key(left).down || input.key(left).released || input.key(right).down || input.key(right).released;
    };
    const bool control = held(Key::LeftControl, Key::RightControl);
    const bool shift = held(Key::LeftShift, Key::RightShift);
    for (const Command& command : commands)
        if (command.enabled && command.key && input.key(*command.key).pressed &&
            control == command.keys.starts_with("Ctrl+") && shift == (command.keys.find("Shift+") != std::string::npos))
            command.run();
}

void draw_menu_bar(std::span<const Command> commands, ControlMap& controls) {
    if (!ImGui::BeginMainMenuBar()) return;
    for (auto menu = commands.begin(); menu != commands.end();) {
        const auto end =
            std::find_if(menu, commands.end(), [&](const Command& other) { return other.menu != menu->menu; });
        if (!menu->menu.empty() && ImGui::BeginMenu(menu->menu.c_str())) {
            for (const Command& command : std::span(menu, end)) {
                if (command.name.empty()) {
                    ImGui::Separator();
                    continue;
                }
                if (ImGui::MenuItem(command.name.c_str(), command.keys.c_str(), command.checked, command.enabled))
                    command.run();
                controls.mark("menu " + command.name);
            }
            ImGui::EndMenu();
        } else if (!menu->menu.empty()) {
            controls.mark("menu " + menu->menu);
        }
        menu = end;
    }
    ImGui::EndMainMenuBar();
}

void draw_help(std::span<const Command> commands, bool& open, ControlMap& controls) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x / 2.0F, screen.y / 2.0F}, ImGuiCond_Appearing, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(34.0F * font, screen.x), std::min(36.0F * font, screen.y - 4.0F * font)},
                             ImGuiCond_Appearing);
    if (ImGui::Begin("Keys", &open, ImGuiWindowFlags_NoSavedSettings) && ImGui::BeginTable("keys", 2)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 13.0F * font);
        ImGui::TableSetupColumn("what");
        help_heading("Preview");
        for (const auto& [keys, what] : kPreview) help_row(keys, what);
        help_heading("Fields");
        for (const auto& [keys, what] : kFields) help_row(keys, what);
        std::string menu;
        for (const Command& command : commands) {
            if (command.menu.empty() || command.keys.empty()) continue;
            if (menu != command.menu) help_heading((menu = command.menu).c_str());
            help_row(command.keys.c_str(), command.name.c_str());
        }
        ImGui::EndTable();
    }
    controls.note("help", "open");
    ImGui::End();
}

}  // namespace rowland::inspector
