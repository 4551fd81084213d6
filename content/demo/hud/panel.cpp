#include "content/demo/hud/panel.h"

#include <imgui.h>
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/hud/windows.h"
#include "content/demo/play/body.h"
#include "engine/core/system.h"
#include "engine/platform/input.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/representations/representation.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::demo {

namespace {

void key_tooltip(Action action) {
    const ActionKey& row = key_row(action);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s  (%s)", row.help, platform::name_of(row.key).c_str());
}

/// Controls for an action, with its key in the tooltip.
void action_button(const Panel& panel, Action action, const char* label) {
    if (ImGui::Button(label)) panel.act(action);
    key_tooltip(action);
}

void action_check_box(const Panel& panel, Action action, const char* label, bool on) {
    if (ImGui::Checkbox(label, &on)) panel.act(action);
    key_tooltip(action);
}

void text_choice(const Panel& panel, Setting setting, const char* label, const std::vector<std::string>& names,
                 const std::string& present) {
    if (!ImGui::BeginCombo(label, present.c_str())) return;
    for (const std::string& name : names)
        if (ImGui::Selectable(name.c_str(), name == present)) panel.set(setting, name);
    ImGui::EndCombo();
}

void slider(const Panel& panel, Setting setting, const char* label, float value, const char* format) {
    const SettingKind::Range range = kind_of(setting).range.value();
    if (ImGui::SliderFloat(label, &value, static_cast<float>(range.minimum), static_cast<float>(range.maximum), format,
                           ImGuiSliderFlags_AlwaysClamp))
        panel.set(setting, static_cast<double>(value));
}

/// A check box for an effect and, while it is on, a slider for one of its settings.
template <typename Effect>
void effect_row(const Panel& panel, Action action, Setting setting, const char* label,
                const std::optional<Effect>& effect, float Effect::*value = &Effect::strength,
                const char* format = "%.2f") {
    action_check_box(panel, action, label, effect.has_value());
    if (!effect) return;
    ImGui::SameLine(ImGui::GetFontSize() * 7.5F);
    ImGui::SetNextItemWidth(-1.0F);
    slider(panel, setting, (std::string("##") + label).c_str(), (*effect).*value, format);
}

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

void look_choice(const Panel& panel, const Object& object, Side side) {
    Comparison& comparison = panel.comparison();
    const ecs::Entity example = object.parts.front();
    ImGui::PushID(static_cast<int>(side));
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::BeginCombo("##look", comparison.title(example, side).c_str(), ImGuiComboFlags_HeightLargest)) {
        const LookSubject subject = comparison.subject(example);
        for (const Detail detail : {Detail::Medium, Detail::Coarse, Detail::Fine})
            for (const Look& look : suitable_looks(subject, detail)) {
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
    const auto count = [&](ecs::Entity grating, Side side) {
        const GpuMaterialPointer material = comparison.shown(grating, side);
        if (std::ranges::find(counted, material.get()) != counted.end()) return;
        counted.push_back(material.get());
        const diffraction::BakedTables& tables = material->cooked()->tables;
        const auto layout = comparison.layout(grating);
        const bool own = &diffraction::drawn_info(tables, layout) == &info(tables);
        bytes += shading_cost(own ? tables : drawn_tables(tables, layout)).table_bytes;
    };
    for (const ecs::Entity grating : gratings) {
        count(grating, Side::Left);
        if (comparison.wiping()) count(grating, Side::Right);
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
    ImGui::TextDisabled("%s", format_bytes(bytes_of_tables(comparison, object.parts)).c_str());
    ImGui::PopID();
}

}  // namespace

void light_panel(const Panel& panel) {
    Play& play = panel.session.play();
    std::vector<std::string> probes;
    for (const std::filesystem::path& path : probe_paths(panel.options)) probes.push_back(path.stem().string());
    text_choice(panel, Setting::Probe, "probe", probes, panel.session.probe_path().stem().string());
    action_button(panel, Action::TurnEnvironmentLeft, " < ");
    ImGui::SameLine();
    action_button(panel, Action::TurnEnvironmentRight, " > ");
    ImGui::SameLine();
    ImGui::Text("environment at %.0f°", play.environment_turn() * 180.0 / std::numbers::pi);
    action_button(panel, Action::RemoveLight, " - ");
    ImGui::SameLine();
    action_button(panel, Action::AddLight, " + ");
    ImGui::SameLine();
    ImGui::Text("%zu lights added", play.lights().entities().size());
    action_check_box(panel, Action::Lamp, "lamp with shadow", panel.session.scene().sun());
}

void picture_panel(const Panel& panel) {
    const post::PostSettings& post = panel.session.picture().post_settings();
    slider(panel, Setting::Exposure, "exposure", post.exposure_stops, "%+.2f stops");
    action_check_box(panel, Action::AutoExposure, "automatic", post.auto_exposure.has_value());
    ImGui::SameLine();
    ImGui::TextDisabled("%+.2f stops in all", static_cast<double>(panel.session.picture().exposure_stops()));
    effect_row(panel, Action::Bloom, Setting::Bloom, "blur", post.bloom);
    effect_row(panel, Action::Vignette, Setting::Vignette, "vignette", post.vignette);
    effect_row(panel, Action::DepthOfField, Setting::FNumber, "focus", post.depth_of_field,
               &post::DepthOfFieldSettings::f_number, "f/%.1f");
    effect_row(panel, Action::Grain, Setting::Grain, "grain", post.grain, &post::GrainSettings::strength, "%.3f");
    const std::string sheet = panel.session.sheet();
    action_check_box(panel, Action::Glare, (sheet.empty() ? "glare###glare" : "glare: " + sheet + "###glare").c_str(),
                     !sheet.empty());
    action_check_box(panel, Action::Dither, "dither", post.dither.has_value());
    text_choice(panel, Setting::View, "view", panel.session.views(), panel.session.view());
}

void play_panel(const Panel& panel) {
    const Play& play = panel.session.play();
    action_check_box(panel, Action::Pause, "paused", play.paused());
    ImGui::SameLine();
    action_button(panel, Action::OneStep, "step");
    ImGui::SameLine();
    action_button(panel, Action::PutBack, "put back");
    action_check_box(panel, Action::SlowMotion, "slow motion", play.speed() < 1.0);
    ImGui::SameLine();
    ImGui::TextDisabled("%.1f s, %s", play.time_s(), play.walking() ? "walking" : "orbiting");
}

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
    slider(panel, Setting::GratingsMs, "GPU time", static_cast<float>(panel.session.gratings_ms()),
           panel.session.gratings_ms() > 0.0 ? "%.1f ms" : "not limited");
    if (const diffraction::FrameBudgetReport* report = panel.session.budget_report()) {
        ImGui::Text("%.2f ms taken, %.2f expected", report->spent_ms, report->predicted_ms);
        ImGui::Text("%d of %d at their best, %d changing; error × %.2f, at best × %.2f", report->at_best,
                    report->objects, report->fading, report->error, report->least_error);
    }
    ImGui::TextDisabled("tables %s, process %s", format_bytes(bytes_of_tables(comparison, gratings)).c_str(),
                        format_bytes(resident_set_bytes()).c_str());
}

}  // namespace rowland::demo
