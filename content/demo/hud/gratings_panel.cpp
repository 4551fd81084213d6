#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "content/demo/hud/memory.h"
#include "content/demo/hud/panel.h"
#include "content/demo/play/hierarchy.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::demo {

namespace {

/// The gratings of one object, which have its name.
struct Object {
    std::string name;
    std::vector<ecs::Entity> parts;
};

std::vector<Object> objects_of(ecs::World& world, const std::vector<ecs::Entity>& gratings) {
    std::vector<Object> objects;
    for (const ecs::Entity grating : gratings) {
        const std::string name = name_of_object(world, grating);
        auto at = std::find_if(objects.begin(), objects.end(), [&](const Object& o) { return o.name == name; });
        if (at == objects.end()) at = objects.insert(objects.end(), {.name = name, .parts = {}});
        at->parts.push_back(grating);
    }
    return objects;
}

/// The name of a look; the own look by its representation.
std::string title_of(Comparison& comparison, ecs::Entity grating, Side side) {
    const Look& look = comparison.look(grating, side);
    if (!look.own()) return look_name(look);
    return std::string(info(comparison.shown(grating, side)->cooked()->tables).name) + " (cooked)";
}

void look_choice(const Panel& panel, const Object& object, Side side) {
    Comparison& comparison = panel.comparison();
    const ecs::Entity example = object.parts.front();
    ImGui::PushID(static_cast<int>(side));
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::BeginCombo("##look", title_of(comparison, example, side).c_str(), ImGuiComboFlags_HeightLargest)) {
        const LookSubject subject = comparison.subject(example);
        for (const Detail detail : {Detail::Medium, Detail::Coarse, Detail::Fine})
            for (const Look& look : looks_of(subject, detail)) {
                if (look.own() && detail != Detail::Medium) continue;
                const std::string name = look_name(look);
                if (ImGui::Selectable(name.c_str(), look == comparison.look(example, side)))
                    panel.set(look_setting(side), name, object.name);
            }
        ImGui::EndCombo();
    }
    ImGui::PopID();
}

/// Bytes of all tables; tables of several objects count once.
std::size_t bytes_of_tables(Comparison& comparison, const std::vector<ecs::Entity>& gratings) {
    std::vector<const diffraction::GpuMaterial*> counted;
    std::size_t bytes = 0;
    const auto count = [&](const GpuMaterialPointer& material) {
        for (const auto* known : counted)
            if (known == material.get()) return;
        counted.push_back(material.get());
        bytes += diffraction::shading_cost(material->cooked()->tables).table_bytes;
    };
    for (const ecs::Entity grating : gratings) {
        count(comparison.shown(grating, Side::Left));
        if (comparison.wiping()) count(comparison.shown(grating, Side::Right));
    }
    return bytes;
}

void object_row(const Panel& panel, const Object& object) {
    Comparison& comparison = panel.comparison();
    ImGui::PushID(object.name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(object.name.c_str());
    ImGui::TableNextColumn();
    look_choice(panel, object, Side::Left);
    if (comparison.wiping()) {
        ImGui::TableNextColumn();
        look_choice(panel, object, Side::Right);
    }
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", readable_bytes(bytes_of_tables(comparison, object.parts)).c_str());
    ImGui::PopID();
}

}  // namespace

void gratings_panel(const Panel& panel) {
    Comparison& comparison = panel.comparison();
    action_check_box(panel, Action::Wipe, "wipe", comparison.wiping());
    ImGui::SameLine();
    action_check_box(panel, Action::Reference, "reference", panel.reference);
    ImGui::SameLine();
    action_button(panel, Action::NextLook, "next for all");
    if (comparison.baking()) {
        ImGui::SameLine();
        ImGui::TextDisabled("baking…");
    }
    const std::vector<ecs::Entity> gratings = comparison.gratings();
    if (ImGui::BeginTable("gratings", comparison.wiping() ? 4 : 3, ImGuiTableFlags_None)) {
        ImGui::TableSetupColumn("object", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("left", ImGuiTableColumnFlags_WidthStretch, 1.0F);
        if (comparison.wiping()) ImGui::TableSetupColumn("right", ImGuiTableColumnFlags_WidthStretch, 1.0F);
        ImGui::TableSetupColumn("bytes", ImGuiTableColumnFlags_WidthFixed);
        for (const Object& object : objects_of(panel.session.play().world(), gratings)) object_row(panel, object);
        ImGui::EndTable();
    }
    ImGui::TextDisabled("tables %s, process %s", readable_bytes(bytes_of_tables(comparison, gratings)).c_str(),
                        readable_bytes(resident_bytes()).c_str());
}

}  // namespace rowland::demo
