#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "editor/inspector/panels.h"

namespace rowland::inspector {

namespace {

constexpr std::array<std::pair<const char*, std::optional<colour::Metal>>, 5> kBases = {{{"index", std::nullopt},
                                                                                         {"Al", colour::Metal::Al},
                                                                                         {"Ag", colour::Metal::Ag},
                                                                                         {"Au", colour::Metal::Au},
                                                                                         {"Cu", colour::Metal::Cu}}};

float curve_height() {
    return 9.0F * ImGui::GetFontSize();
}

void begin_field(const char* name) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name);
    ImGui::SameLine(8.0F * ImGui::GetFontSize());
    ImGui::SetNextItemWidth(-1.0F);
}

/// Drag the number, or Ctrl-click to type it.
void number(const char* name, double& value, double low, double high, double step, const char* format,
            ControlMap& controls) {
    begin_field(name);
    ImGui::DragScalar(fmt::format("##{}", name).c_str(), ImGuiDataType_Double, &value, static_cast<float>(step), &low,
                      &high, format, ImGuiSliderFlags_AlwaysClamp);
    controls.mark(fmt::format("film {}", name));
}

void choose_base(std::optional<colour::Metal>& metal, ControlMap& controls) {
    begin_field("Base");
    const auto present = std::ranges::find(kBases, metal, [](const auto& base) { return base.second; });
    if (ImGui::BeginCombo("##base", present->first)) {
        for (const auto& [name, of] : kBases) {
            if (ImGui::Selectable(name, of == metal)) metal = of;
            controls.mark(fmt::format("film Base={}", name));
        }
        ImGui::EndCombo();
    }
    controls.mark("film Base");
}

double top_of(const std::vector<glm::dvec2>& points) {
    double top = 0.01;
    for (const glm::dvec2& point : points) top = std::max(top, point.y);
    return top;
}

std::vector<glm::dvec2> luminances(const std::vector<double>& x, const std::vector<glm::dvec3>& xyz) {
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < xyz.size(); ++i) points.emplace_back(x[i], xyz[i].y);
    return points;
}

void draw_spectrum(const FilmCurves& curves) {
    Plot plot("##film spectrum", curve_height(), {380.0, 780.0, "wavelength, nm"},
              {0.0, 1.1 * std::max(top_of(curves.spectrum), top_of(curves.bare)), "reflected"});
    plot.line(curves.spectrum, 0);
    plot.legend("film", 0);
    plot.line(curves.bare, 1);
    plot.legend("base alone", 1);
}

void draw_angle_curves(const FilmCurves& curves) {
    Plot plot("##film angles", curve_height(), {0.0, 85.0, "angle of view, degrees"}, {0.0, 1.0, "Y"});
    const std::array<std::pair<const char*, const std::vector<glm::dvec3>*>, 3> lines = {
        {{"exact", &curves.over_angle.exact},
         {"table", &curves.over_angle.table},
         {"glTF's formula", &curves.over_angle.formula}}};
    for (std::size_t series = 0; series < lines.size(); ++series) {
        plot.line(luminances(curves.angles_deg, *lines.at(series).second), series);
        plot.legend(lines.at(series).first, series);
    }
}

/// From the top down: exact, table, glTF's formula.
void draw_swatch(const FilmCurves& curves, double thickness_nm) {
    const FilmColours& colours = curves.over_thickness;
    double top = 1e-9;
    for (const glm::dvec3& xyz : colours.exact) top = std::max(top, xyz.y);
    const Plot plot("##film swatch", curve_height(), {0.0, kThickestFilm_nm, "thickness, nm"}, {0.0, 3.0, ""});
    const double step = kThickestFilm_nm / static_cast<double>(curves.thicknesses_nm.size());
    double height = 3.0;
    for (const std::vector<glm::dvec3>* row : {&colours.exact, &colours.table, &colours.formula}) {
        for (std::size_t i = 0; i < row->size(); ++i) {
            const double begin = step * static_cast<double>(i);
            plot.bar(begin, begin + step, height, screen_colour_u32((*row)[i] / top));
        }
        height -= 1.0;
    }
    plot.vertical(thickness_nm, IM_COL32_WHITE);
    ImGui::TextDisabled("From the top: exact, table, glTF's formula.");
}

}  // namespace

void FilmPanel::draw_fields(ControlMap& controls) {
    number("Index", inputs_.ior, 1.0, 4.0, 0.005, "%.3f", controls);
    number("Thickness", inputs_.thickness_nm, 0.0, kThickestFilm_nm, 1.0, "%.0f nm", controls);
    choose_base(inputs_.metal, controls);
    if (!inputs_.metal) {
        number("Base index", inputs_.base_ior, 0.05, 5.0, 0.005, "%.3f", controls);
        number("Base k", inputs_.base_k, 0.0, 10.0, 0.01, "%.2f", controls);
    }
    number("Roughness", inputs_.roughness, 0.0, 1.0, 0.005, "%.2f", controls);
    number("Angle of view", inputs_.angle_deg, 0.0, 85.0, 0.5, "%.0f°", controls);
}

void FilmPanel::draw_curves(const FilmCurves& curves, ControlMap& controls) const {
    if (ImGui::CollapsingHeader("Reflectance over wavelength", ImGuiTreeNodeFlags_DefaultOpen)) draw_spectrum(curves);
    if (ImGui::CollapsingHeader("Luminance over angle", ImGuiTreeNodeFlags_DefaultOpen)) draw_angle_curves(curves);
    if (ImGui::CollapsingHeader("Colour over thickness", ImGuiTreeNodeFlags_DefaultOpen))
        draw_swatch(curves, inputs_.thickness_nm);
    const std::string table = curves.complete ? fmt::format("{:.2f} %", 100.0 * curves.table_error) : "computing";
    const std::string formula = fmt::format("{:.1f} %", 100.0 * curves.formula_error);
    ImGui::TextWrapped("Error against the exact sum, RMS over thickness: table %s, glTF's formula %s.", table.c_str(),
                       formula.c_str());
    controls.note("film table error", table);
    controls.note("film formula error", formula);
    controls.note("film reflects", fmt::format("{:.4f}", curves.over_thickness.exact.back().y));
    controls.note("film at 550 nm", fmt::format("{:.4f}", curves.spectrum.at(550 - 380).y));
}

void FilmPanel::draw(ControlMap& controls) {
    if (!open) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x - font, 3.0F * font}, ImGuiCond_Appearing, {1.0F, 0.0F});
    ImGui::SetNextWindowBgAlpha(1.0F);
    ImGui::SetNextWindowSize({std::min(26.0F * font, screen.x), screen.y - 6.0F * font}, ImGuiCond_Appearing);
    if (ImGui::Begin("Thin film", &open, ImGuiWindowFlags_NoSavedSettings)) {
        draw_fields(controls);
        curves_.want(inputs_, [inputs = inputs_](const std::stop_token& stop, const auto& publish) {
            return film_curves(inputs, stop, publish);
        });
        curves_.poll();
        if (const FilmCurves* curves = curves_.value())
            draw_curves(*curves, controls);
        else
            ImGui::TextDisabled("Computing…");
        controls.note("film is current", curves_.current() && !curves_.busy() ? "yes" : "no");
    }
    ImGui::End();
}

}  // namespace rowland::inspector
