#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "editor/inspector/groove_texture.h"
#include "editor/inspector/panels.h"

namespace rowland::inspector {

namespace {

/// The number near x that is 1, 2 or 5 times a power of ten.
double round_step(double x) {
    const double unit = std::pow(10.0, std::floor(std::log10(x)));
    const double digit = x / unit;
    return unit * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

/// The change of a field per pixel of drag.
double drag_step(const Field& field, double value) {
    constexpr double kPixels = 200.0;
    if (!field.logarithmic) return round_step((field.maximum - field.minimum) / kPixels);
    return round_step(std::max(std::abs(value), field.minimum) / kPixels);
}

void help_on_hover(const Field& field) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0F * ImGui::GetFontSize());
    ImGui::TextUnformatted(field.help.c_str());
    ImGui::TextDisabled("Source: %s", field.source.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

const char* section_of(const Field& field) {
    if (field.pointer.starts_with("/grating")) return "Grating";
    if (field.pointer.starts_with("/film") || field.pointer.starts_with("/iridescence")) return "Film";
    if (field.pointer.starts_with("/groove")) return "Grooves on the mesh";
    return field.pointer.starts_with("/quality") ? "Quality" : "Surface";
}

/// For a name that ImGui takes as a format string.
std::string without_percent(std::string name) {
    std::ranges::replace(name, '%', '_');
    return name;
}

void draw_number(Document& document, const Field& field) {
    const bool whole = field.kind == FieldKind::Count;
    const double stored = number_of(value_of(field, document.json()));
    double value = shown_number(field, stored);
    const auto step = static_cast<float>(whole ? 0.1 : shown_number(field, drag_step(field, stored)));
    std::string format = (whole ? "%.0f" : field.unit.empty() ? "%.4g" : "%.7g ") + shown_unit(field);
    if (const auto picture = whole ? document.new_textures().find(static_cast<std::size_t>(value)) : nullptr)
        format = without_percent(picture->name);
    if (ImGui::DragScalar("##value", ImGuiDataType_Double, &value, step, whole ? &field.minimum : nullptr,
                          whole ? &field.maximum : nullptr, format.c_str()))
        document.set_value(field, whole ? std::round(value) : stored_number(field, value));
}

void draw_pair(Document& document, const Field& field) {
    std::array<float, 2> pair{};
    const Json value = value_of(field, document.json());
    for (std::size_t i = 0; i < 2 && value.is_array() && i < value.size(); ++i)
        pair[i] = static_cast<float>(number_of(value[i]));
    const float largest = std::max(std::abs(pair[0]), std::abs(pair[1]));
    const auto step = static_cast<float>(drag_step(field, static_cast<double>(largest)));
    if (ImGui::DragFloat2("##value", pair.data(), step, 0.0F, 0.0F, "%.7g"))
        document.set_value(field, {rounded(static_cast<double>(pair[0])), rounded(static_cast<double>(pair[1]))});
}

void draw_colour(Document& document, const Field& field) {
    std::array<float, 3> rgb{};
    const Json value = value_of(field, document.json());
    for (std::size_t i = 0; i < 3 && value.is_array() && i < value.size(); ++i)
        rgb[i] = static_cast<float>(number_of(value[i]));
    // A narrow control has no room for the numbers; a click on the patch opens them.
    const bool narrow = ImGui::CalcItemWidth() < 10.5F * ImGui::GetFontSize();
    if (!ImGui::ColorEdit3("##value", rgb.data(),
                           ImGuiColorEditFlags_Float | (narrow ? ImGuiColorEditFlags_NoInputs : 0)))
        return;
    Json edited = Json::array();
    for (const float part : rgb) edited.push_back(rounded(static_cast<double>(part)));
    document.set_value(field, edited);
}

void draw_choice(Document& document, const Field& field, ControlMap& controls) {
    const std::string present = choice_of(field, document.json());
    const float text_width = ImGui::CalcTextSize(present.c_str()).x;
    const bool narrow = ImGui::CalcItemWidth() < text_width + 2.5F * ImGui::GetFontSize();
    if (!ImGui::BeginCombo("##value", present.empty() ? "?" : present.c_str(),
                           ImGuiComboFlags_HeightLargest | (narrow ? ImGuiComboFlags_NoArrowButton : 0)))
        return;
    for (const Choice& choice : field.choices) {
        if (ImGui::Selectable(choice.name.c_str(), choice.name == present) && choice.name != present)
            document.set_choice(field, choice.name);
        controls.mark(field.pointer + "=" + choice.name);
        if (choice.name == present) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
}

void draw_lines_per_mm(Document& document, ControlMap& controls) {
    const Field& pitch = field_at("/grating/pitch_nm");
    const double pitch_nm = number_of(value_of(pitch, document.json()));
    double lines = pitch_nm > 0.0 ? lines_per_mm(pitch_nm) : 0.0;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("  as lines");
    begin_control(7.7F);
    ImGui::InputDouble("##lines", &lines, 0.0, 0.0, "%.6g /mm");
    controls.mark("lines per mm");
    if (ImGui::IsItemDeactivatedAfterEdit() && lines > 0.0) {
        document.set_value(pitch, pitch_of_lines(lines));
        document.finish_edit();
    }
}

/// "1600 nm slit", "400 nm film"; "–": none.
std::string summary_of(const Document& document, std::size_t material) {
    const auto& source = document.accepted(material);
    if (!source) return "–";
    if (const auto* film = std::get_if<thin_film::GltfIridescence>(&source->parsed))
        return fmt::format("{:g} nm film", film->maximum_thickness_nm);
    const Field* profile = shown_field("/grating/profile", source->json);
    return fmt::format("{:g} nm {}", source->grating()->material.grating.pitch_nm,
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

bool enabled_button(const char* label, const char* name, bool enabled, ControlMap& controls) {
    if (!enabled) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 0.4F);
    const bool pressed = ImGui::Button(label) && enabled;
    controls.mark(name);
    if (!enabled) ImGui::PopStyleVar();
    return pressed;
}

void draw_opening(OpenDocument& opened, ControlMap& controls) {
    ImGui::Text("Opening %s…", opened.opening().filename().string().c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) opened.cancel_opening();
    controls.mark("cancel opening");
    ImGui::ProgressBar(-0.5F * static_cast<float>(ImGui::GetTime()), {-1.0F, 0.0F}, "");
}

void draw_attach(OpenDocument& opened, const char* label, ControlMap& controls) {
    ImGui::SetNextItemWidth(7.0F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##attach", label, ImGuiComboFlags_HeightLargest)) {
        const char* category = "";
        for (const Preset& preset : OpenDocument::presets()) {
            if (std::string_view(std::exchange(category, preset.category)) != preset.category)
                ImGui::TextDisabled("%s", preset.category);
            if (ImGui::Selectable(preset.name)) opened.open_preset(preset.file);
            controls.mark(std::string("attach=") + preset.file);
        }
        ImGui::EndCombo();
    }
    controls.mark("attach");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Gives the chosen material a grating or a film. Or open or drop a material file.");
}

void draw_patterns(OpenDocument& opened, ControlMap& controls) {
    ImGui::SetNextItemWidth(9.0F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##pattern", "Foil pattern…", ImGuiComboFlags_HeightLargest)) {
        for (const char* pattern : kFoilPatterns) {
            if (ImGui::Selectable(pattern)) opened.set_foil_pattern(pattern);
            controls.mark(std::string("pattern=") + pattern);
        }
        ImGui::TextDisabled("or drop a picture");
        ImGui::EndCombo();
    }
    controls.mark("pattern");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("A groove texture. The brightness of a dropped picture rotates the grooves.");
}

void draw_actions(OpenDocument& opened, ControlMap& controls) {
    const Document& document = opened.document();
    const bool has = document.accepted() != nullptr;
    draw_attach(opened, has ? "Replace…" : "Attach…", controls);
    continue_line(3.5F);
    if (enabled_button("Copy", "copy", has, controls)) ImGui::SetClipboardText(format_json(document.json()).c_str());
    continue_line(3.5F);
    const char* clipboard = ImGui::GetClipboardText();
    const bool pasteable = clipboard != nullptr && std::string_view(clipboard).starts_with('{');
    if (enabled_button("Paste", "paste", pasteable, controls)) opened.paste(clipboard);
    continue_line(4.5F);
    if (enabled_button("Remove", "remove", has, controls)) opened.remove();
}

}  // namespace

void MaterialPanel::draw(Document& document, ControlMap& controls) {
    std::string section;
    bool open = false;
    if (document.refusal() && document.refusal()->field == nullptr) draw_refusal(document.refusal()->message);
    for (const auto all : fields_of(document.json()))
        for (const Field& field : all) {
            const bool of_scene = all.data() == groove_fields().data();
            if ((of_scene && !document.is_scene()) || !is_shown(field, document.json())) continue;
            if (section != section_of(field)) {
                section = section_of(field);
                open = ImGui::CollapsingHeader(section.c_str(), ImGuiTreeNodeFlags_DefaultOpen);
            }
            if (open) draw_field(document, field, controls);
        }
}

void MaterialPanel::draw_field(Document& document, const Field& field, ControlMap& controls) {
    ImGui::PushID(field.pointer.c_str());
    const bool refused = document.refusal() && document.refusal()->field == &field;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.label.c_str());
    help_on_hover(field);
    begin_control(7.7F);
    if (refused) {
        ImGui::PushStyleColor(ImGuiCol_Border, kRefused);
        ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 2.0F);
    }
    draw_control(document, field, controls);
    controls.mark(field.pointer);
    help_on_hover(field);
    if (refused) {
        ImGui::PopStyleVar();
        ImGui::PopStyleColor();
    }
    if (can_revert(field, document.json())) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 1.6F * ImGui::GetFontSize());
        if (ImGui::SmallButton("↺")) document.revert(field);
        controls.mark(field.pointer + " revert");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Reset to %s",
                              field.default_value.is_null() ? "none" : field.default_value.dump().c_str());
    }
    // A reset may have ended the refusal.
    if (refused && document.refusal()) draw_refusal(document.refusal()->message);
    ImGui::PopID();
    if (field.pointer == "/grating/pitch_nm") draw_lines_per_mm(document, controls);
}

void MaterialPanel::draw_control(Document& document, const Field& field, ControlMap& controls) {
    switch (field.kind) {
        case FieldKind::Choice:
            return draw_choice(document, field, controls);
        case FieldKind::Orders:
        case FieldKind::Name:
            return draw_text(document, field);
        case FieldKind::Colour:
            draw_colour(document, field);
            break;
        case FieldKind::Pair:
            draw_pair(document, field);
            break;
        case FieldKind::Number:
        case FieldKind::Count:
            draw_number(document, field);
            break;
    }
    if (ImGui::IsItemDeactivatedAfterEdit()) document.finish_edit();
}

void MaterialPanel::draw_text(Document& document, const Field& field) {
    const Json value = value_of(field, document.json());
    std::array<char, 512> buffer{};
    const auto typed = texts_.find(field.pointer);
    const std::string text = typed != texts_.end()             ? typed->second
                             : field.kind == FieldKind::Orders ? format_orders(value)
                             : value.is_string()               ? value.get<std::string>()
                                                               : value.dump();
    std::strncpy(buffer.data(), text.c_str(), buffer.size() - 1);
    if (ImGui::InputText("##value", buffer.data(), buffer.size())) texts_[field.pointer] = buffer.data();
    const auto found = texts_.find(field.pointer);
    if (ImGui::IsItemDeactivated() && found != texts_.end()) {
        document.set_value(field, field.kind == FieldKind::Orders ? parse_orders(found->second) : Json(found->second));
        document.finish_edit();
        texts_.erase(found);
    }
}

void ScenePanel::draw(OpenDocument& opened, View& view, ControlMap& controls) {
    if (!opened.opening().empty()) draw_opening(opened, controls);
    const SceneObject* scene = opened.scene();
    if (scene == nullptr) return;
    const bool has_grating = opened.document().has_grating();
    if (scene->materials.empty()) return draw_wrapped("No mesh of the scene can have a grating or a film.");
    draw_list(opened, controls);
    const SceneMaterial& chosen = scene->materials[opened.document().chosen()];
    ImGui::TextUnformatted(chosen.name.c_str());
    draw_wrapped(meshes_text(chosen));
    if (const char* origin = origin_of(chosen.tangents); *origin != '\0') draw_wrapped(origin);
    draw_actions(opened, controls);
    if (has_grating) {
        draw_patterns(opened, controls);
        ImGui::SameLine();
        ImGui::Checkbox("Show grooves", &view.shows_grooves);
        controls.mark("show grooves");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Strokes along the grooves. Drag the yellow handle to rotate them.");
    }
    controls.note("chosen material", chosen.name);
    controls.note("tangents", origin_of(chosen.tangents));
    if (!opened.document().accepted())
        draw_wrapped("No grating or film. Attach a preset, paste a copied one, or drop a material file.");
}

void ScenePanel::draw_list(OpenDocument& opened, ControlMap& controls) {
    const SceneObject& scene = *opened.scene();
    Document& document = opened.document();
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
            if (ImGui::Selectable("##row", i == document.chosen())) document.choose(i);
            controls.mark("material " + scene.materials[i].name);
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", meshes_text(scene.materials[i]).c_str());
            ImGui::SameLine(0.0F, 0.0F);
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float right = ImGui::GetWindowPos().x + grating_column - 0.4F * ImGui::GetFontSize();
            ImGui::PushClipRect(at, {right, at.y + row}, true);
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
