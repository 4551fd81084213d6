#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "editor/inspector/panels.h"

namespace rowland::inspector {

namespace {

float curve_height() {
    return 9.0F * ImGui::GetFontSize();
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
         {"glTF", &curves.over_angle.formula}}};
    for (std::size_t series = 0; series < lines.size(); ++series) {
        if (lines.at(series).second->empty()) continue;
        plot.line(luminances(curves.angles_deg, *lines.at(series).second), series);
        plot.legend(lines.at(series).first, series);
    }
}

/// The colours over thickness in rows, from the top: exact, table, glTF's formula.
void draw_swatch(const FilmCurves& curves, double thickness_nm) {
    const FilmColours& colours = curves.over_thickness;
    double top = 1e-9;
    for (const glm::dvec3& xyz : colours.exact) top = std::max(top, xyz.y);
    const double thinnest_nm = curves.thicknesses_nm.front();
    const double thickest_nm = curves.thicknesses_nm.back();
    const double rows = colours.formula.empty() ? 2.0 : 3.0;
    const Plot plot("##film swatch", curve_height(), {thinnest_nm, thickest_nm, "thickness, nm"}, {0.0, rows, ""});
    const double step = (thickest_nm - thinnest_nm) / static_cast<double>(curves.thicknesses_nm.size());
    double height = rows;
    for (const std::vector<glm::dvec3>* row : {&colours.exact, &colours.table, &colours.formula}) {
        for (std::size_t i = 0; i < row->size(); ++i) {
            const double begin = thinnest_nm + step * static_cast<double>(i);
            plot.bar(begin, begin + step, height, screen_colour_u32((*row)[i] / top));
        }
        height -= 1.0;
    }
    plot.vertical(thickness_nm, IM_COL32_WHITE);
    ImGui::TextDisabled("From the top: exact, table%s.", colours.formula.empty() ? "" : ", glTF's formula");
}

}  // namespace

void FilmPanel::update(const OpenDocument& opened) {
    film_ = opened.film();
    std::optional<FilmInputs> inputs;
    if (film_)
        inputs = {.film = film_->material.film,
                  .roughness = film_->material.range.roughest,
                  .angle_deg = angle_deg_,
                  .illuminant = film_->material.illuminant.name};
    curves_.want(inputs, [inputs](const std::stop_token& stop, const auto& publish) {
        return film_curves(*inputs, stop, publish);
    });
    curves_.poll();
}

void FilmPanel::draw_curves(const FilmCurves& curves, ControlMap& controls) const {
    if (ImGui::CollapsingHeader("Reflectance over wavelength", ImGuiTreeNodeFlags_DefaultOpen)) draw_spectrum(curves);
    if (ImGui::CollapsingHeader("Luminance over angle", ImGuiTreeNodeFlags_DefaultOpen)) draw_angle_curves(curves);
    if (ImGui::CollapsingHeader("Colour over thickness", ImGuiTreeNodeFlags_DefaultOpen))
        draw_swatch(curves, film_->material.film.layers.front().thickness_nm);
    const std::string table = curves.complete ? fmt::format("{:.2f} %", 100.0 * curves.table_error) : "computing";
    const std::string formula =
        curves.over_angle.formula.empty() ? "" : fmt::format(", glTF's formula {:.1f} %", 100.0 * curves.formula_error);
    ImGui::TextWrapped("Error against the exact sum, RMS over thickness: table %s%s.", table.c_str(), formula.c_str());
    controls.note("film table error", table);
    controls.note("film formula error", formula);
    controls.note("film reflects", fmt::format("{:.4f}", curves.over_thickness.exact.back().y));
    controls.note("film at 550 nm", fmt::format("{:.4f}", curves.spectrum.at(550 - 380).y));
}

void FilmPanel::draw(const View& view, ControlMap& controls) {
    if (!film_) return ImGui::TextWrapped("The film is not drawn yet, or its factor is 0, or its material is unlit.");
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Angle of view");
    ImGui::SameLine(8.0F * ImGui::GetFontSize());
    ImGui::SetNextItemWidth(-1.0F);
    constexpr double kLow = 0.0;
    constexpr double kHigh = 85.0;
    ImGui::DragScalar("##film angle", ImGuiDataType_Double, &angle_deg_, 0.5F, &kLow, &kHigh, "%.0f°",
                      ImGuiSliderFlags_AlwaysClamp);
    controls.mark("film angle");
    if (const FilmCurves* curves = curves_.value())
        draw_curves(*curves, controls);
    else
        ImGui::TextDisabled("Computing…");
    draw_picked_pixel(view, controls);
    controls.note("film is current", curves_.current() && !curves_.busy() ? "yes" : "no");
}

}  // namespace rowland::inspector
