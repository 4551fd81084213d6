#include "editor/inspector/scene_panel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "editor/inspector/groove_picture.h"

namespace rowland::inspector {

namespace {

/// "1600 nm slit"; "–": none.
std::string summary_of(const Document& document, std::size_t material) {
    const auto& source = document.accepted(material);
    if (!source) return "–";
    const Field* profile = shown_field("/grating/profile", source->json);
    return fmt::format("{:g} nm {}", source->material.grating.pitch_nm,
                       profile != nullptr ? choice_of(*profile, source->json) : "");
}

const char* origin_of(scene::TangentSource tangents) {
    switch (tangents) {
        case scene::TangentSource::File:
            return "";
        case scene::TangentSource::Uvs:
            return "Meshes without tangents: the grating vector follows u of their texture coordinates.";
        case scene::TangentSource::Arbitrary:
            return "Meshes without tangents and texture coordinates: the grating vector is arbitrary; give them UVs.";
    }
    return "";
}

/// "3 meshes: a, b, c"
std::string meshes_text(const SceneMaterial& material) {
    constexpr std::size_t kNamed = 40;
    if (material.meshes.empty()) return "No mesh uses it.";
    const std::size_t named = std::min(kNamed, material.meshes.size());
    const std::span<const std::string> names(material.meshes.data(), named);
    return fmt::format("{} mesh{}: {}{}", material.meshes.size(), material.meshes.size() == 1 ? "" : "es",
                       fmt::join(names, ", "), named < material.meshes.size() ? ", …" : "");
}

void draw_wrapped(const std::string& text) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s", text.c_str());
    ImGui::PopTextWrapPos();
}

bool button(const char* label, const char* name, bool enabled, ControlMap& controls) {
    if (!enabled) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 0.4F);
    const bool pressed = ImGui::Button(label) && enabled;
    controls.mark(name);
    if (!enabled) ImGui::PopStyleVar();
    return pressed;
}

void draw_opening(Session& session, ControlMap& controls) {
    ImGui::Text("Opening %s…", session.opening().filename().string().c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) session.cancel_opening();
    controls.mark("cancel opening");
    ImGui::ProgressBar(-0.5F * static_cast<float>(ImGui::GetTime()), {-1.0F, 0.0F}, "");
}

void draw_attach(Session& session, const char* label, ControlMap& controls) {
    ImGui::SetNextItemWidth(7.0F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##attach", label, ImGuiComboFlags_HeightLargest)) {
        for (const char* preset : Session::presets()) {
            if (ImGui::Selectable(preset)) session.open_preset(preset);
            controls.mark(std::string("attach=") + preset);
        }
        ImGui::EndCombo();
    }
    controls.mark("attach");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Gives the chosen material a grating. Or open or drop a material file.");
}

void draw_patterns(Session& session, ControlMap& controls) {
    ImGui::SetNextItemWidth(9.0F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##pattern", "Foil pattern…", ImGuiComboFlags_HeightLargest)) {
        for (const char* pattern : kFoilPatterns) {
            if (ImGui::Selectable(pattern)) session.set_foil_pattern(pattern);
            controls.mark(std::string("pattern=") + pattern);
        }
        ImGui::TextDisabled("or drop a picture");
        ImGui::EndCombo();
    }
    controls.mark("pattern");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("A groove texture. A dropped picture turns the grooves by its brightness.");
}

void draw_actions(Session& session, ControlMap& controls) {
    const Document& document = session.document();
    const bool has = document.has_grating();
    draw_attach(session, has ? "Replace…" : "Attach…", controls);
    ImGui::SameLine();
    if (button("Copy", "copy grating", has, controls)) ImGui::SetClipboardText(format_json(document.json()).c_str());
    ImGui::SameLine();
    const char* clipboard = ImGui::GetClipboardText();
    const bool pasteable = clipboard != nullptr && std::string_view(clipboard).starts_with('{');
    if (button("Paste", "paste grating", pasteable, controls)) session.paste_grating(clipboard);
    ImGui::SameLine();
    if (button("Remove", "remove grating", has, controls)) session.remove_grating();
}

}  // namespace

void ScenePanel::draw(Session& session, ControlMap& controls) {
    if (!session.opening().empty()) draw_opening(session, controls);
    const SceneObject* scene = session.scene();
    if (scene == nullptr || !session.document().is_scene()) return;
    if (scene->materials.empty()) return draw_wrapped("The scene shows no mesh that could have a grating.");
    draw_list(session, controls);
    const SceneMaterial& chosen = scene->materials[session.document().chosen()];
    ImGui::TextUnformatted(chosen.name.c_str());
    draw_wrapped(meshes_text(chosen));
    if (const char* origin = origin_of(chosen.tangents); *origin != '\0') draw_wrapped(origin);
    draw_actions(session, controls);
    if (session.document().has_grating()) {
        draw_patterns(session, controls);
        ImGui::SameLine();
    }
    ImGui::Checkbox("Show grooves", &session.shows_grooves);
    controls.mark("show grooves");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Strokes along the grooves. Drag the yellow handle to turn them.");
    controls.note("chosen material", chosen.name);
    controls.note("tangents", origin_of(chosen.tangents));
    if (!session.document().has_grating())
        draw_wrapped("No grating. Attach a preset, paste a copied grating, or drop a material file.");
}

void ScenePanel::draw_list(Session& session, ControlMap& controls) {
    const SceneObject& scene = *session.scene();
    const Document& document = session.document();
    constexpr std::size_t kRows = 9;
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const auto rows = static_cast<float>(std::min(kRows, scene.materials.size()));
    ImGui::BeginChild("materials", {0.0F, (rows + 0.6F) * row}, true);
    const float grating_column = ImGui::GetContentRegionAvail().x - 6.5F * ImGui::GetFontSize();
    if (listed_ != document.chosen())
        ImGui::SetScrollY(std::max(0.0F, row * (static_cast<float>(document.chosen()) - 0.5F * rows)));
    listed_ = document.chosen();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(scene.materials.size()), row);
    while (clipper.Step())
        for (int line = clipper.DisplayStart; line < clipper.DisplayEnd; ++line) {
            const auto i = static_cast<std::size_t>(line);
            ImGui::PushID(line);
            const std::string name = scene.materials[i].name + (document.edited(i) ? " •" : "");
            if (ImGui::Selectable("##row", i == document.chosen())) session.choose_material(i);
            controls.mark("material " + scene.materials[i].name);
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", meshes_text(scene.materials[i]).c_str());
            ImGui::SameLine(0.0F, 0.0F);
            const ImVec2 at = ImGui::GetCursorScreenPos();
            ImGui::PushClipRect(at, {at.x + grating_column - 0.4F * ImGui::GetFontSize(), at.y + row}, true);
            ImGui::TextUnformatted(name.c_str());
            ImGui::PopClipRect();
            ImGui::SameLine(grating_column);
            ImGui::TextDisabled("%s", summary_of(document, i).c_str());
            ImGui::PopID();
        }
    ImGui::EndChild();
    controls.mark("materials");
}

}  // namespace rowland::inspector
