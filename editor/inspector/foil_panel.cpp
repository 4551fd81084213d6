#include "editor/inspector/foil_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rowland::inspector {

namespace {

const char* section_of_foil(const Field& field) {
    if (field.pointer.starts_with("/foil")) return "Foil";
    if (field.pointer.starts_with("/card") || field.pointer == "/texture_px") return "Card";
    return field.pointer == "/artwork" || field.pointer == "/mask" ? "Pictures" : "Print";
}

void show_help(const Field& field) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(22.0F * ImGui::GetFontSize());
    ImGui::TextUnformatted(field.help.c_str());
    if (field.kind == FieldKind::Number)
        ImGui::TextDisabled("%g to %g %s; Ctrl-click types a number", field.minimum, field.maximum, field.unit.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void draw_number(FoilRecipe& recipe, const Field& field) {
    const bool whole = field.kind == FieldKind::Count;
    double value = number_of(value_of(field, recipe.json()));
    constexpr double kMostOfSlider = 1e6;
    if (whole && field.maximum > kMostOfSlider) {
        auto number = static_cast<std::int64_t>(value);
        constexpr std::int64_t kStep = 1;
        if (ImGui::InputScalar("##value", ImGuiDataType_S64, &number, &kStep))
            recipe.set(field, std::clamp<std::int64_t>(number, 0, static_cast<std::int64_t>(field.maximum)));
        return;
    }
    const std::string format = whole ? "%.0f " + field.unit : "%.3g " + field.unit;
    const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
    if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &field.minimum, &field.maximum, format.c_str(),
                            flags))
        recipe.set(field, whole ? Json(static_cast<std::int64_t>(std::lround(value))) : Json(rounded(value)));
}

void draw_numbers(FoilRecipe& recipe, const Field& field) {
    std::array<float, 3> numbers{};
    const Json value = value_of(field, recipe.json());
    for (std::size_t i = 0; i < numbers.size() && value.is_array() && i < value.size(); ++i)
        numbers[i] = static_cast<float>(number_of(value[i]));
    const bool colour = field.kind == FieldKind::Colour;
    const bool edited = colour ? ImGui::ColorEdit3("##value", numbers.data(), ImGuiColorEditFlags_Float)
                               : ImGui::SliderFloat2("##value", numbers.data(), static_cast<float>(field.minimum),
                                                     static_cast<float>(field.maximum),
                                                     (field.unit.empty() ? "%.2f" : "%.1f" + field.unit).c_str());
    if (!edited) return;
    Json all = Json::array();
    for (std::size_t i = 0; i < (colour ? 3U : 2U); ++i) all.push_back(rounded(static_cast<double>(numbers[i])));
    recipe.set(field, all);
}

void draw_choice(FoilRecipe& recipe, const Field& field, ControlMap& controls) {
    const std::string present = choice_of(field, recipe.json());
    if (!ImGui::BeginCombo("##value", present.c_str())) return;
    for (const Choice& choice : field.choices) {
        if (ImGui::Selectable(choice.name.c_str(), choice.name == present)) {
            recipe.set(field, choice.value);
            recipe.finish_edit();
        }
        controls.mark(field.pointer + "=" + choice.name);
    }
    ImGui::EndCombo();
}

}  // namespace

void FoilPanel::draw(FoilStudio& studio, const FoilActions& actions, ControlMap& controls) {
    draw_actions(studio, actions, controls);
    const std::string refusal = studio.refusal();
    if (!refusal.empty() && studio.recipe().field_of(refusal) == nullptr) draw_refusal(refusal);
    hovered_.clear();
    std::string section;
    bool open = false;
    bool held = false;
    // The fields of another type that is chosen meanwhile are drawn in the next frame.
    for (const Field& field : studio.recipe().fields()) {
        if (section != section_of_foil(field)) {
            section = section_of_foil(field);
            const std::string title = section == "Foil" ? "Foil: " + shown_foil_type(studio.recipe().type()) : section;
            open =
                ImGui::CollapsingHeader(fmt::format("{}###{}", title, section).c_str(), ImGuiTreeNodeFlags_DefaultOpen);
            controls.mark("section " + section);
        }
        if (open) draw_field(studio, field, actions, controls);
        held = held || (open && ImGui::IsAnyItemActive());
    }
    studio.editing = held && ImGui::IsWindowFocused();
    studio.drop_on = hovered_;
    controls.note("foil", studio.recipe().json().dump());
    controls.note("foil card", studio.shown());
    controls.note("foil refused", refusal.empty() ? "no" : refusal);
    controls.note("film", studio.film() != nullptr ? std::to_string(studio.film()->drawn()) : "none");
}

void FoilPanel::draw_actions(FoilStudio& studio, const FoilActions& actions, ControlMap& controls) {
    if (const TiltFilm* film = studio.film()) {
        const float done = static_cast<float>(film->drawn()) / static_cast<float>(film->settings().count());
        ImGui::ProgressBar(done, {-6.0F * ImGui::GetFontSize(), 0.0F},
                           fmt::format("film: {} of {}", film->drawn(), film->settings().count()).c_str());
        ImGui::SameLine();
        if (ImGui::Button("Cancel")) studio.cancel_film();
        controls.mark("cancel film");
        return;
    }
    if (ImGui::Button("Save card…")) actions.save_card();
    controls.mark("save card");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The card with its textures as .glb, for any program");
    continue_line(6.0F);
    if (ImGui::Button("Save film…")) ImGui::OpenPopup("Film");
    controls.mark("save film");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("One tilt of the card as an animated picture (.webp)");
    draw_film_settings(actions, controls);
}

void FoilPanel::draw_film_settings(const FoilActions& actions, ControlMap& controls) {
    if (!ImGui::BeginPopup("Film")) return;
    ImGui::PushItemWidth(9.0F * ImGui::GetFontSize());
    ImGui::InputInt("pixels wide", &film_.width, 0);
    controls.mark("film width");
    ImGui::InputInt("pixels high", &film_.height, 0);
    controls.mark("film height");
    ImGui::InputDouble("seconds", &film_.seconds, 0.0, 0.0, "%.1f");
    controls.mark("film seconds");
    ImGui::InputInt("pictures per second", &film_.pictures_per_second, 0);
    controls.mark("film rate");
    ImGui::Checkbox("numbered PNGs as well", &film_.pngs);
    controls.mark("film pngs");
    ImGui::PopItemWidth();
    ImGui::TextDisabled("%d pictures; it repeats without a jump", film_.count());
    if (ImGui::Button("Choose the file…")) {
        ImGui::CloseCurrentPopup();
        actions.save_film(film_);
    }
    controls.mark("film file");
    ImGui::EndPopup();
}

void FoilPanel::draw_field(FoilStudio& studio, const Field& field, const FoilActions& actions, ControlMap& controls) {
    FoilRecipe& recipe = studio.recipe();
    const std::string refusal = studio.refusal();
    const bool refused = !refusal.empty() && recipe.field_of(refusal) == &field;
    const float font = ImGui::GetFontSize();
    ImGui::PushID(field.pointer.c_str());
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.label.c_str());
    show_help(field);
    begin_control(8.4F);
    if (refused) {
        ImGui::PushStyleColor(ImGuiCol_Border, kRefused);
        ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 2.0F);
    }
    draw_control(studio, field, actions, controls);
    controls.mark(field.pointer);
    if (ImGui::IsItemDeactivatedAfterEdit()) recipe.finish_edit();
    show_help(field);
    if (refused) {
        ImGui::PopStyleVar();
        ImGui::PopStyleColor();
    }
    if (field.pointer != "/artwork" && !field.required && can_revert(field, recipe.json())) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 1.6F * font);
        if (ImGui::SmallButton(field.kind == FieldKind::Name ? "×" : "↺")) {
            recipe.set(field, nullptr);
            recipe.finish_edit();
        }
        controls.mark(field.pointer + " revert");
    }
    if (refused) draw_refusal(refusal);
    ImGui::PopID();
}

void FoilPanel::draw_control(FoilStudio& studio, const Field& field, const FoilActions& actions, ControlMap& controls) {
    FoilRecipe& recipe = studio.recipe();
    switch (field.kind) {
        case FieldKind::Choice:
            return draw_choice(recipe, field, controls);
        case FieldKind::Colour:
        case FieldKind::Pair:
            return draw_numbers(recipe, field);
        case FieldKind::Name: {
            const Json file = value_of(field, recipe.json());
            const std::string name = file.is_string()
                                         ? std::filesystem::path(file.get<std::string>()).filename().string()
                                         : "drop or choose…";
            if (ImGui::Button((name + "##picture").c_str(), {ImGui::CalcItemWidth(), 0.0F}))
                actions.choose_picture(field);
            if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) hovered_ = field.pointer;
            return;
        }
        default:
            return draw_number(recipe, field);
    }
}

void draw_foil_wall(FoilStudio& studio, ControlMap& controls) {
    constexpr float kWidth = 96.0F;  // of a card, in screen coordinates
    FoilWall& wall = studio.wall();
    wall.draw(glm::inverse(resting_tilt()) * studio.card().tilt);
    const auto types = diffraction::foil::foil_type_names();
    const float aspect =
        static_cast<float>(studio.recipe().accepted().card.height_mm / studio.recipe().accepted().card.width_mm);
    const ImVec2 size(kWidth, kWidth * aspect);
    const float step = size.x + ImGui::GetStyle().ItemSpacing.x;
    const int columns = std::max(1, static_cast<int>(ImGui::GetContentRegionAvail().x / step));
    const std::string chosen = studio.recipe().type();
    std::string clicked;
    for (std::size_t i = 0; i < types.size(); ++i) {
        if (static_cast<int>(i) % columns > 0) ImGui::SameLine();
        ImGui::BeginGroup();
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const ImVec2 end(corner.x + size.x, corner.y + size.y);
        if (ImGui::InvisibleButton(std::string(types[i]).c_str(), size)) clicked = types[i];
        controls.mark("foil type " + std::string(types[i]));
        const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemFocused();
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        if (const gpu::Texture* picture = wall.picture(i))
            draw.AddImage(texture_of(*picture), corner, end);
        else
            draw.AddRectFilled(corner, end, IM_COL32(60, 60, 66, 255));
        if (types[i] == chosen || hovered)
            draw.AddRect(corner, end, types[i] == chosen ? IM_COL32(255, 210, 60, 255) : IM_COL32(200, 200, 200, 160),
                         3.0F, 0, types[i] == chosen ? 3.0F : 1.5F);
        const std::string name = shown_foil_type(types[i]);
        ImGui::SetCursorScreenPos({corner.x + 0.5F * (size.x - ImGui::CalcTextSize(name.c_str()).x), end.y + 2.0F});
        ImGui::TextUnformatted(name.c_str());
        ImGui::EndGroup();
    }
    if (!clicked.empty()) studio.recipe().set_type(clicked);
}

}  // namespace rowland::inspector
