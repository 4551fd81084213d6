#include "content/demo/hud/panel.h"

#include <imgui.h>

#include "content/demo/play/key_name.h"
#include "engine/scene/node_label.h"
#include "engine/scene/transform.h"

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

std::string name_of_object(ecs::World& world, ecs::Entity entity) {
    while (world.alive(entity)) {
        if (const auto* label = world.find<scene::NodeLabel>(entity); label != nullptr && !label->name.empty())
            return label->name;
        const auto* parent = world.find<scene::Parent>(entity);
        if (parent == nullptr) break;
        entity = parent->entity;
    }
    return "grating";
}

}  // namespace rowland::demo
