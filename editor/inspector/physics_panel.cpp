#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "editor/inspector/panels.h"

namespace rowland::inspector {

namespace {

/// Half the width, and the position of the brightest texel, for the control map.
std::string numbers_of_pattern(const PatternFigure& figure) {
    const auto found = std::ranges::max_element(figure.xyz, {}, &glm::dvec3::y);
    const auto index = static_cast<int>(found - figure.xyz.begin());
    const auto u = [&](int texel) { return ((2.0 * texel + 1.0) / figure.size - 1.0) * figure.half_width; };
    return fmt::format("{:.4f} of {:.4f} {:.4f}", figure.half_width, u(index % figure.size), u(index / figure.size));
}

float plot_height() {
    return 11.0F * ImGui::GetFontSize();
}

bool pane(const char* name) {
    return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen);
}

std::string order_name(int order) {
    return order == 0 ? "0" : fmt::format("{:+d}", order);
}

std::string numbers_of(const glm::dvec3& value) {
    return fmt::format("{:.5g}  {:.5g}  {:.5g}", value.x, value.y, value.z);
}

/// The highest point in each interval of x; `columns` intervals per unit.
std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2>& points, double columns) {
    std::vector<glm::dvec2> result;
    for (const glm::dvec2& point : points) {
        if (result.empty() || std::floor(result.back().x * columns) != std::floor(point.x * columns))
            result.push_back(point);
        else if (point.y > result.back().y)
            result.back() = point;
    }
    return result;
}

/// The largest finite value; 1 if none is above 0.
double highest(std::initializer_list<const std::vector<double>*> lists) {
    double top = 0.0;
    for (const auto* list : lists)
        for (const double value : *list)
            if (std::isfinite(value)) top = std::max(top, value);
    return top > 0.0 ? top : 1.0;
}

void draw_light_controls(PaneLight& light, ControlMap& controls) {
    const auto slider = [&](const char* name, double& value, double low, double high, const char* format) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        ImGui::SameLine(8.0F * ImGui::GetFontSize());
        ImGui::SetNextItemWidth(-1.0F);
        ImGui::SliderScalar(fmt::format("##{}", name).c_str(), ImGuiDataType_Double, &value, &low, &high, format);
        controls.mark(name);
    };
    slider("Wavelength", light.wavelength_nm, 380.0, 780.0, "%.0f nm");
    slider("Light from", light.incidence_deg, -85.0, 85.0, "%.0f°");
    slider("Light azimuth", light.azimuth_deg, -90.0, 90.0, "%.0f° from across");
}

void draw_angles(const diffraction::Grating& grating, const PaneLight& light) {
    const AngleCurve curve = angle_curve(grating, light.wavelength_nm, light.incidence_deg);
    double top = 0.0;
    for (const OrderPeak& peak : curve.peaks) top = std::max(top, peak.brdf);
    if (top <= 0.0) top = 1.0;
    const double floor = 1e-5 * top;
    const Plot plot("##angles", plot_height(), {-90.0, 90.0, "angle of view, degrees"},
                    {floor, top * 3.0, "1/sr", true});
    plot.line(thinned(curve.points, static_cast<double>(plot.maximum().x - plot.minimum().x) / 180.0), 0);
    plot.vertical(light.incidence_deg, IM_COL32(255, 255, 255, 120));
    plot.text(light.incidence_deg, 3.0 * floor, "light", kPlotWords);
    std::string words = fmt::format("{:.1f}°", plot.mouse_x());
    for (const OrderPeak& peak : curve.peaks) {
        constexpr double kVisible = 1e-4;
        const std::string name = order_name(peak.order);
        words += fmt::format("\norder {} at {:.2f}°: efficiency {:.4f}", name, peak.angle_deg, peak.efficiency);
        if (peak.order != 0 && peak.efficiency < kVisible) continue;
        const bool drawn = peak.brdf > 0.0;
        if (!drawn) plot.vertical(peak.angle_deg, IM_COL32(255, 255, 255, 70));
        plot.text(peak.angle_deg, drawn ? peak.brdf : 20.0 * floor, name.c_str(), kPlotWords);
    }
    if (plot.hovered()) ImGui::SetTooltip("%s", words.c_str());
}

diffraction::Grating by_scalar_theory(diffraction::Grating grating) {
    grating.theory = diffraction::Theory::Scalar;
    grating.efficiencies = nullptr;
    return grating;
}

/// What the panes show: the document's grating, with rigorous efficiencies once they are solved; until then by scalar
/// theory.
diffraction::Grating shown_grating(const OpenDocument& opened) {
    const diffraction::Grating& grating = opened.document().material().grating;
    if (is_solved(grating)) return grating;
    const auto cooked = opened.cooked();
    return cooked && opened.is_cooked() ? cooked->material.grating : by_scalar_theory(grating);
}

double sine_of(double angle_deg) {
    return std::sin(angle_deg * std::numbers::pi / 180.0);
}

/// Curves as lines and, of the same orders, `others` as dots.
void draw_curves(const std::vector<EfficiencyCurve>& curves, const std::vector<EfficiencyCurve>& others, const char* id,
                 const PlotAxis& x) {
    double top = 0.0;
    for (const auto* list : {&curves, &others})
        for (const EfficiencyCurve& curve : *list)
            for (const glm::dvec2& point : curve.points) top = std::max(top, point.y);
    Plot plot(id, plot_height(), x, {0.0, top > 0.0 ? 1.1 * top : 1.0, "fraction"});
    for (std::size_t i = 0; i < curves.size(); ++i) {
        plot.line(curves[i].points, i);
        plot.legend(order_name(curves[i].order), i);
        for (const EfficiencyCurve& other : others)
            for (std::size_t k = 0; other.order == curves[i].order && k < other.points.size(); k += 5)
                plot.marker(other.points[k].x, other.points[k].y, i);
    }
}

const PlotAxis kWavelengths{380.0, 780.0, "wavelength, nm"};

void draw_efficiencies(const diffraction::Grating& grating, const std::optional<diffraction::Grating>& compared,
                       double s_g, ControlMap& controls) {
    const auto curves = efficiency_curves(grating, s_g);
    draw_curves(curves, compared ? efficiency_curves(*compared, s_g) : std::vector<EfficiencyCurve>(), "##efficiency",
                kWavelengths);
    const bool of_table = std::holds_alternative<diffraction::EfficiencyTable>(grating.profile);
    if (compared)
        ImGui::TextDisabled(of_table ? "Lines: the table. Dots: the last scalar profile."
                                     : "Lines: scalar theory. Dots: the opened table.");
    else
        ImGui::TextDisabled(of_table ? "From the table." : "Scalar theory. Drop a table (.csv) to compare.");
    if (!curves.empty()) controls.note("efficiency", fmt::format("{:.4f}", curves.front().points[40].y));
}

void draw_kernel(const diffraction::CookedMaterial& cooked) {
    const KernelStrip strip = kernel_strip(cooked.kernel, cooked.material.grating.pitch_nm, 256);
    if (strip.xyz.empty()) return ImGui::TextDisabled("No listed order shows a colour.");
    double top = 0.0;
    for (const glm::dvec3& xyz : strip.xyz) top = std::max(top, xyz.y);
    const Plot plot("##kernel", 7.0F * ImGui::GetFontSize(), {strip.begin_nm, strip.end_nm, "path difference, nm"},
                    {0.0, 1.0, ""});
    const double cell = (strip.end_nm - strip.begin_nm) / static_cast<double>(strip.xyz.size());
    for (std::size_t i = 0; i < strip.xyz.size(); ++i) {
        const double begin = strip.begin_nm + cell * static_cast<double>(i);
        plot.bar(begin, begin + cell, 1.0, screen_colour_u32(strip.xyz[i] / top));
    }
    if (plot.hovered()) {
        const auto index = static_cast<std::size_t>((plot.mouse_x() - strip.begin_nm) / cell);
        ImGui::SetTooltip("%.0f nm: XYZ %s per nm", plot.mouse_x(),
                          numbers_of(strip.xyz[std::min(index, strip.xyz.size() - 1)]).c_str());
    }
}

void draw_directions(const diffraction::Grating& grating, const PaneLight& light) {
    const double polar = light.incidence_deg * std::numbers::pi / 180.0;
    const double azimuth = light.azimuth_deg * std::numbers::pi / 180.0;
    const glm::dvec3 s(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
    const float font = ImGui::GetFontSize();
    const float width = ImGui::GetContentRegionAvail().x;
    const float size = std::min(width, 17.0F * font);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##directions", {width, size});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 centre(corner.x + width / 2.0F, corner.y + size / 2.0F);
    const float radius = size / 2.0F - 1.2F * font;
    const auto at = [&](double g, double h) {
        return ImVec2(centre.x + radius * static_cast<float>(g), centre.y - radius * static_cast<float>(h));
    };
    draw.AddCircleFilled(centre, radius, IM_COL32(0, 0, 0, 90), 64);
    for (const double sine : {0.5, std::sqrt(0.75)})
        draw.AddCircle(centre, radius * static_cast<float>(sine), IM_COL32(255, 255, 255, 22), 64);
    draw.AddCircle(centre, radius, IM_COL32(255, 255, 255, 80), 64);
    draw.AddLine(at(-1.0, 0.0), at(1.0, 0.0), IM_COL32(255, 255, 255, 30));
    draw.AddLine(at(0.0, -1.0), at(0.0, 1.0), IM_COL32(255, 255, 255, 30));
    draw.AddText({centre.x + radius + 0.2F * font, centre.y - font / 2.0F}, kPlotWords, "g");
    draw.AddText({centre.x - 0.3F * font, centre.y - radius - 1.1F * font}, kPlotWords, "h");
    for (const OrderTrace& trace : order_directions(grating, s)) {
        const OrderSpot& middle = trace.spots[trace.spots.size() / 2];
        if (trace.order == 0)
            draw.AddCircleFilled(at(middle.v_g, middle.v_h), 0.35F * font, IM_COL32(235, 235, 235, 255));
        else
            for (const OrderSpot& spot : trace.spots)
                draw.AddCircleFilled(at(spot.v_g, spot.v_h), 0.28F * font, wavelength_colour(spot.wavelength_nm));
        const ImVec2 below = at(middle.v_g, middle.v_h);
        const std::string name = order_name(trace.order);
        draw.AddText({below.x - ImGui::CalcTextSize(name.c_str()).x / 2.0F, below.y + 0.4F * font}, kPlotWords,
                     name.c_str());
    }
    const ImVec2 from = at(s.x, s.y);
    draw.AddCircle(from, 0.45F * font, IM_COL32_WHITE, 0, 2.0F);
    draw.AddText({from.x - 1.0F * font, from.y - 1.6F * font}, kPlotWords, "light");
    ImGui::TextDisabled("g: across the grooves. h: along them. Rings: 30° and 60°.");
}

void draw_spectrum_at_point(const std::vector<double>& spectrum) {
    const Plot plot("##spectrum", plot_height(), {380.0, 780.0, "wavelength, nm"},
                    {0.0, 1.1 * highest({&spectrum}), ""});
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        const double nm = 380.0 + static_cast<double>(i);
        plot.bar(nm, nm + 1.0, spectrum[i], wavelength_colour(nm, 0.85F));
    }
}

void draw_sweep(const ViewSweep& sweep) {
    double lowest = 0.0;
    for (const double value : sweep.harmonics) lowest = std::min(lowest, value);
    Plot plot("##sweep", plot_height(), {-80.0, 80.0, "angle of view, degrees"},
              {1.05 * lowest, 1.1 * highest({&sweep.reference, &sweep.harmonics, &sweep.drawn}), "Y"});
    const std::array<std::pair<std::string, const std::vector<double>*>, 3> lines = {
        {{"reference", &sweep.reference},
         {fmt::format("SH, {} bands", sweep.bands), &sweep.harmonics},
         {"as drawn", &sweep.drawn}}};
    for (std::size_t series = 0; series < lines.size(); ++series) {
        std::vector<glm::dvec2> points;
        for (std::size_t i = 0; i < sweep.angles_deg.size(); ++i)
            points.emplace_back(sweep.angles_deg[i], (*lines[series].second)[i]);
        plot.line(points, series);
        plot.legend(lines[series].first, series);
    }
}

void draw_energy(const diffraction::Grating& grating, const PaneLight& light, ControlMap& controls) {
    const EnergyBalance balance = energy_balance(grating, light.wavelength_nm, sine_of(light.incidence_deg));
    const std::array<std::pair<const char*, double>, 5> parts = {{{"orders", balance.orders},
                                                                  {"zero order", balance.zero},
                                                                  {"absorbed", balance.absorbed},
                                                                  {"evanescent", balance.evanescent},
                                                                  {"to the base", balance.residual}}};
    const float font = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::Dummy({width, 1.4F * font});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    float left = corner.x;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto& [name, fraction] = parts[i];
        const float right = left + width * static_cast<float>(fraction);
        draw.AddRectFilled({left, corner.y}, {right, corner.y + 1.3F * font}, series_colour(i));
        left = right;
        if (i % 2 != 0) ImGui::SameLine(width / 2.0F + 0.6F * font);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        draw.AddRectFilled({at.x, at.y + 0.25F * font}, {at.x + 0.7F * font, at.y + 0.95F * font}, series_colour(i));
        ImGui::Dummy({0.8F * font, font});
        ImGui::SameLine();
        ImGui::Text("%s %.1f %%", name, 100.0 * fraction);
        controls.note(std::string("fraction ") + name, fmt::format("{:.4f}", fraction));
    }
}

}  // namespace

void draw_picked_pixel(const View& view, ControlMap& controls) {
    if (const auto& picked = view.picked()) {
        draw_row("Pixel, working", numbers_of(glm::dvec3(picked->working)));
        draw_row("Pixel, display", fmt::format("{}  {}  {}", picked->display.r, picked->display.g, picked->display.b));
        controls.note("picked", fmt::format("{} {} {}", picked->display.r, picked->display.g, picked->display.b));
    } else {
        ImGui::TextDisabled("Click the picture to pick another point.");
    }
}

void PatternPane::paint(const View& view, const post::DisplayTransform& display) {
    exposure_stops_ = view.stage.exposure_stops;
    const glm::dmat3& to_working = view.preview().xyz_to_working();
    std::vector<glm::vec3> pixels;
    for (const glm::dvec3& xyz : shown_->xyz) pixels.emplace_back(to_working * xyz);
    display.apply_cpu(pixels, exposure_stops_);
    if (texture_.size().x != shown_->size)
        texture_ = gpu::Texture({.format = gpu::Format::RGBA8, .width = shown_->size, .height = shown_->size});
    texture_.upload(std::span<const glm::vec3>(pixels));
}

void PatternPane::draw(const View& view, const std::shared_ptr<const PatternFigure>& pattern,
                       const post::DisplayTransform& display, ControlMap& controls) {
    if (!pattern) return ImGui::TextDisabled("Computing…");
    if (pattern->size == 0) return ImGui::TextDisabled("No listed order has light.");
    if (std::exchange(shown_, pattern) != pattern || exposure_stops_ != view.stage.exposure_stops) paint(view, display);
    const double end = shown_->half_width;
    // Square: the margins of a plot are 0.2 font heights more in height than in width.
    const Plot plot("##pattern", ImGui::GetContentRegionAvail().x + 0.2F * ImGui::GetFontSize(), {-end, end, "u_g"},
                    {-end, end, "u_h"});
    const auto id = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture_.id()));
    plot.draw().AddImage(id, plot.minimum(), plot.maximum(), {0.0F, 1.0F}, {1.0F, 0.0F});
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled(
        "Directions of white light: u = s + v. The mirror image of a lamp lies in the middle. With the exposure of "
        "the view.");
    ImGui::PopTextWrapPos();
    controls.note("pattern", numbers_of_pattern(*shown_));
}

void PhysicsPanel::update(const OpenDocument& opened) {
    std::optional<RigorousInputs> inputs;
    const Document& document = opened.document();
    if (document.has_grating() && document.material().grating.theory == diffraction::Theory::Rigorous) {
        const diffraction::Grating& grating = document.material().grating;
        inputs = {.relief = relief_of(grating, "the material"),
                  .substrate = substrate_of(grating),
                  .orders = {},
                  .wavelength_nm = light_.wavelength_nm,
                  .s_g = sine_of(light_.incidence_deg)};
        for (const EfficiencyCurve& curve : efficiency_curves(by_scalar_theory(grating)))
            inputs->orders.push_back(curve.order);
    }
    rigorous_.want(inputs, [inputs](const std::stop_token& stop, const auto& publish) {
        return rigorous_curves(*inputs, stop, publish);
    });
    const auto change = rigorous_.poll();
    if (change.value) rigorous_failure_.clear();
    if (!change.failure.empty()) rigorous_failure_ = change.failure;
}

void PhysicsPanel::draw_rigorous(const diffraction::Grating& grating, ControlMap& controls) {
    constexpr std::array kNames = {"unpolarised", "TE", "TM"};
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::Combo("##polarisation", &polarisation_, kNames.data(), static_cast<int>(kNames.size()));
    controls.mark("Polarisation");
    if (!rigorous_failure_.empty()) ImGui::TextWrapped("%s", rigorous_failure_.c_str());
    const std::vector<RigorousOrder>* orders = rigorous_.value();
    if (orders == nullptr) return ImGui::TextDisabled("Computing…");
    const auto curves_of = [&](std::vector<PolarisedPoint> RigorousOrder::*points) {
        std::vector<EfficiencyCurve> curves;
        for (const RigorousOrder& order : *orders) {
            if ((order.*points).empty()) continue;
            curves.push_back({order.order, {}});
            for (const PolarisedPoint& point : order.*points)
                curves.back().points.emplace_back(
                    point.at, polarisation_ == 0 ? point.mean() : (polarisation_ == 1 ? point.te : point.tm));
        }
        return curves;
    };
    const auto scalar = efficiency_curves(by_scalar_theory(grating));
    const auto over_wavelength = curves_of(&RigorousOrder::over_wavelength);
    const auto over_incidence = curves_of(&RigorousOrder::over_incidence);
    std::vector<EfficiencyCurve> scalar_over_incidence = over_incidence;  // scalar theory does not depend on it
    for (EfficiencyCurve& curve : scalar_over_incidence) {
        const auto& same = *std::ranges::find(scalar, curve.order, &EfficiencyCurve::order);
        const auto nearest = std::ranges::lower_bound(same.points, light_.wavelength_nm, {}, &glm::dvec2::x);
        for (glm::dvec2& point : curve.points) point.y = nearest->y;
    }
    draw_curves(over_wavelength, scalar, "##efficiency", kWavelengths);
    draw_curves(over_incidence, scalar_over_incidence, "##incidence", {-90.0, 90.0, "light from, degrees"});
    ImGui::TextDisabled("Lines: Maxwell's equations. Dots: scalar theory.");
    if (!over_wavelength.empty())
        controls.note("efficiency", fmt::format("{:.4f}", over_wavelength.front().points.front().y));
    controls.note("efficiency is final", rigorous_.current() && !rigorous_.busy() ? "yes" : "no");
}

void PhysicsPanel::draw(const OpenDocument& opened, const View& view, const Measurement& measurement,
                        ControlMap& controls) {
    const diffraction::Grating grating = shown_grating(opened);
    if (!grating.lattice) draw_light_controls(light_, controls);
    const PointNumbers* numbers = measurement.point_numbers();
    if (pane(grating.lattice ? "Point: colour" : "Point: spectrum and colour"))
        numbers != nullptr ? draw_point(view, measurement, !grating.lattice, controls)
                           : ImGui::TextDisabled("Computing…");
    if (grating.lattice) {
        if (pane("Diffraction pattern")) pattern_.draw(view, measurement.pattern(), display_, controls);
        return;
    }
    if (pane("Diffraction over angle")) draw_angles(grating, light_);
    if (pane("Distribution of power")) draw_energy(grating, light_, controls);
    if (pane("Directions of orders, from above")) draw_directions(grating, light_);
    const bool rigorous = opened.document().material().grating.theory == diffraction::Theory::Rigorous;
    if (pane(rigorous ? "Efficiency over wavelength and incidence" : "Efficiency over wavelength"))
        rigorous ? draw_rigorous(grating, controls)
                 : draw_efficiencies(grating, opened.compared(), sine_of(light_.incidence_deg), controls);
    if (pane("Colour over path difference") && opened.cooked()) draw_kernel(*opened.cooked());
    if (pane("Luminance over view, against the reference"))
        numbers != nullptr ? draw_sweep(numbers->sweep) : ImGui::TextDisabled("Computing…");
}

void PhysicsPanel::draw_point(const View& view, const Measurement& measurement, bool with_spectrum,
                              ControlMap& controls) const {
    const PointNumbers& numbers = *measurement.point_numbers();
    if (with_spectrum) draw_spectrum_at_point(numbers.radiance.spectrum);
    const glm::dvec3 working = view.preview().xyz_to_working() * numbers.radiance.reference;
    glm::vec3 display(working);
    display_.apply_cpu(std::span(&display, 1), view.stage.exposure_stops);
    draw_row("XYZ, reference", numbers_of(numbers.radiance.reference));
    draw_row("XYZ, as drawn", numbers_of(numbers.radiance.drawn));
    draw_row("Working RGB", numbers_of(working));
    draw_row("Display value", numbers_of(glm::dvec3(display)));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float font = ImGui::GetFontSize();
    const glm::vec3 shown = glm::clamp(display, 0.0F, 1.0F);
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + ImGui::GetContentRegionAvail().x, at.y + font},
                                              ImGui::ColorConvertFloat4ToU32({shown.r, shown.g, shown.b, 1.0F}));
    ImGui::Dummy({0.0F, font});
    draw_picked_pixel(view, controls);
    if (!measurement.point_numbers_are_current()) ImGui::TextDisabled("Updating…");
    controls.note("point", numbers_of(numbers.radiance.reference));
}

}  // namespace rowland::inspector
