#include "content/demo/hud/panel.h"

#include <imgui.h>

#include "content/demo/play/key_name.h"

namespace rowland::demo {

namespace {

void key_tooltip(Action action) {
    const ActionKey& row = row_of(action);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s  (%s)", row.help, std::string(name_of(row.key)).c_str());
}

}  // namespace

void action_button(const Panel& panel, Action action, const char* label) {
    if (ImGui::Button(label)) panel.call_for(action);
    key_tooltip(action);
}

void action_check_box(const Panel& panel, Action action, const char* label, bool on) {
    bool wanted = on;
    if (ImGui::Checkbox(label, &wanted)) panel.call_for(action);
    key_tooltip(action);
}

}  // namespace rowland::demo
