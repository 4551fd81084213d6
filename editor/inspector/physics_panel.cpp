#include "editor/inspector/physics_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "editor/inspector/physics/efficiency_curves.h"
#include "editor/inspector/physics/energy_balance.h"
#include "editor/inspector/physics/kernel_strip.h"
#include "editor/inspector/physics/order_directions.h"
#include "editor/inspector/plot.h"
#include "editor/inspector/screen_colour.h"

namespace rowland::inspector {

namespace {

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

void row(const char* name, const std::string& value) {
    ImGui::TextDisabled("%s", name);
    ImGui::SameLine(9.5F * ImGui::GetFontSize());
    ImGui::TextUnformatted(value.c_str());
}

/// As dense as the screen: of points that share a column the highest stays.
std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2>& points, double columns) {
    std::vector<glm::dvec2> result;
    for (const glm::dvec2& point : points) {
        const double column = std::floor(point.x * columns);
        if (!result.empty() && std::floor(result.back().x * columns) == column) {
            if (point.y > result.back().y) result.back() = point;
        } else {
            result.push_back(point);
        }
    }
    return result;
}

double highest(std::initializer_list<const std::vector<double>*> lists) {
    double top = 0.0;
    for (const auto* list : lists)
        for (const double value : *list)
            if (std::isfinite(value)) top = std::max(top, value);
    return top > 0.0 ? top : 1.0;
}

}  // namespace

void PhysicsPanel::draw(Session& session, ControlMap& controls) {
    draw_choices(controls);
    const diffraction::Grating& grating = session.document().material().grating;
    if (pane("Point: spectrum and colour")) draw_point(session, controls);
    if (pane("Diffraction over angle")) draw_angles(grating);
    if (pane("Where the power goes")) draw_energy(grating, controls);
    if (pane("Where orders go, from above")) draw_directions(grating);
    if (pane("Efficiency over wavelength")) draw_efficiencies(session);
    if (pane("Colour over path difference") && session.cooked()) draw_kernel(*session.cooked());
    if (pane("Luminance over view, against the reference")) draw_sweep(session);
}

void PhysicsPanel::draw_choices(ControlMap& controls) {
    const float font = ImGui::GetFontSize();
    const auto slider = [&](const char* name, float& value, float low, float high, const char* format) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        ImGui::SameLine(8.0F * font);
        ImGui::SetNextItemWidth(-1.0F);
        ImGui::SliderFloat(fmt::format("##{}", name).c_str(), &value, low, high, format);
        controls.mark(name);
    };
    slider("Wavelength", wavelength_nm_, 380.0F, 780.0F, "%.0f nm");
    slider("Light from", incidence_deg_, -85.0F, 85.0F, "%.0f°");
    slider("Light turned", azimuth_deg_, -90.0F, 90.0F, "%.0f° from across");
}

void PhysicsPanel::draw_angles(const diffraction::Grating& grating) const {
    const auto incidence = static_cast<double>(incidence_deg_);
    const AngleCurve curve = angle_curve(grating, static_cast<double>(wavelength_nm_), incidence);
    double top = 0.0;
    for (const OrderPeak& peak : curve.peaks) top = std::max(top, peak.brdf);
    if (top <= 0.0) top = 1.0;
    const Plot plot("##angles", plot_height(), {-90.0, 90.0, "angle of view, degrees"},
                    {top * 1e-5, top * 3.0, "1/sr", true});
    // The floor between peaks is below what a screen shows; a curve from the floor up is easier read.
    const double columns = static_cast<double>(plot.maximum().x - plot.minimum().x) / 180.0;
    plot.line(thinned(curve.points, columns), 0);
    plot.vertical(incidence, IM_COL32(255, 255, 255, 120));
    plot.text(incidence, top * 1e-5 * 3.0, "light", kPlotWords);
    for (const OrderPeak& peak : curve.peaks) {
        constexpr double kVisible = 1e-4;
        if (peak.order != 0 && peak.efficiency < kVisible) continue;
        const double at = peak.brdf > 0.0 ? peak.brdf : top * 1e-5;
        if (peak.brdf <= 0.0) plot.vertical(peak.angle_deg, IM_COL32(255, 255, 255, 70));
        plot.text(peak.angle_deg, at * (peak.brdf > 0.0 ? 1.0 : 20.0), order_name(peak.order).c_str(), kPlotWords);
    }
    if (plot.hovered()) {
        std::string words = fmt::format("{:.1f}°", plot.mouse_x());
        for (const OrderPeak& peak : curve.peaks)
            words += fmt::format("\norder {} at {:.2f}°: efficiency {:.4f}", order_name(peak.order), peak.angle_deg,
                                 peak.efficiency);
        ImGui::SetTooltip("%s", words.c_str());
    }
}

void PhysicsPanel::draw_efficiencies(const Session& session) const {
    const std::vector<double> wavelengths = plotted_wavelengths();
    const auto curves = efficiency_curves(session.document().material().grating, wavelengths);
    std::vector<EfficiencyCurve> other;
    if (const auto compared = session.compared()) other = efficiency_curves(*compared, wavelengths);
    double top = 0.0;
    for (const auto* list : {&curves, static_cast<const std::vector<EfficiencyCurve>*>(&other)})
        for (const EfficiencyCurve& curve : *list) top = std::max(top, highest({&curve.efficiency}));
    Plot plot("##efficiency", plot_height(), {380.0, 780.0, "wavelength, nm"}, {0.0, 1.1 * top, "share"});
    const auto points = [&](const EfficiencyCurve& curve) {
        std::vector<glm::dvec2> line;
        for (std::size_t i = 0; i < wavelengths.size(); ++i) line.emplace_back(wavelengths[i], curve.efficiency[i]);
        return line;
    };
    // Orders m and −m of a symmetric groove lie on one line.
    for (std::size_t i = 0; i < curves.size(); ++i) {
        plot.line(points(curves[i]), i);
        plot.legend(order_name(curves[i].order), i);
    }
    for (const EfficiencyCurve& curve : other) {
        const auto same = std::find_if(curves.begin(), curves.end(),
                                       [&](const EfficiencyCurve& one) { return one.order == curve.order; });
        if (same == curves.end()) continue;
        for (std::size_t i = 0; i < wavelengths.size(); i += 5)
            plot.marker(wavelengths[i], curve.efficiency[i], static_cast<std::size_t>(same - curves.begin()));
    }
    const bool table =
        std::holds_alternative<diffraction::EfficiencyTable>(session.document().material().grating.profile);
    if (!other.empty())
        ImGui::TextDisabled(table ? "Lines: the table. Dots: the scalar profile before it."
                                  : "Lines: scalar. Dots: the table laid beside it.");
    else
        ImGui::TextDisabled(table ? "From the table." : "Scalar theory; drop a table (.csv) to lay it beside.");
}

void PhysicsPanel::draw_kernel(const diffraction::CookedMaterial& cooked) const {
    const KernelStrip strip = kernel_strip(cooked.kernel, cooked.material.grating.pitch_nm, 256);
    if (strip.xyz.empty()) {
        ImGui::TextDisabled("No listed order shows a colour.");
        return;
    }
    double top = 0.0;
    for (const glm::dvec3& xyz : strip.xyz) top = std::max(top, xyz.y);
    const Plot plot("##kernel", 7.0F * ImGui::GetFontSize(), {strip.begin_nm, strip.end_nm, "path difference, nm"},
                    {0.0, 1.0, ""});
    const float width = (plot.maximum().x - plot.minimum().x) / static_cast<float>(strip.xyz.size());
    for (std::size_t i = 0; i < strip.xyz.size(); ++i) {
        const float left = plot.minimum().x + static_cast<float>(i) * width;
        plot.draw().AddRectFilled({left, plot.minimum().y}, {left + width + 0.5F, plot.maximum().y},
                                  screen_colour_u32(strip.xyz[i] / top));
    }
    if (plot.hovered()) {
        const double x = plot.mouse_x();
        const double share = (x - strip.begin_nm) / (strip.end_nm - strip.begin_nm);
        const auto cell =
            std::min(static_cast<std::size_t>(share * static_cast<double>(strip.xyz.size())), strip.xyz.size() - 1);
        ImGui::SetTooltip("%.0f nm: XYZ %s per nm", x, numbers_of(strip.xyz[cell]).c_str());
    }
}

void PhysicsPanel::draw_directions(const diffraction::Grating& grating) const {
    const double polar = static_cast<double>(incidence_deg_) * std::numbers::pi / 180.0;
    const double turn = static_cast<double>(azimuth_deg_) * std::numbers::pi / 180.0;
    const glm::dvec3 s(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
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
        if (trace.order == 0) {
            draw.AddCircleFilled(at(middle.v_g, middle.v_h), 0.35F * font, IM_COL32(235, 235, 235, 255));
        } else {
            for (const OrderSpot& spot : trace.spots)
                draw.AddCircleFilled(at(spot.v_g, spot.v_h), 0.28F * font, wavelength_colour(spot.wavelength_nm));
        }
        const ImVec2 place = at(middle.v_g, middle.v_h);
        const std::string name = order_name(trace.order);
        draw.AddText({place.x - ImGui::CalcTextSize(name.c_str()).x / 2.0F, place.y + 0.4F * font}, kPlotWords,
                     name.c_str());
    }
    const ImVec2 light = at(s.x, s.y);
    draw.AddCircle(light, 0.45F * font, IM_COL32(255, 255, 255, 255), 0, 2.0F);
    draw.AddText({light.x - 1.0F * font, light.y - 1.6F * font}, kPlotWords, "light");
    ImGui::TextDisabled("g: across the grooves. h: along them. Rings: 30° and 60°.");
}

void PhysicsPanel::draw_point(const Session& session, ControlMap& controls) const {
    const PointNumbers* numbers = session.point_numbers();
    if (numbers == nullptr) {
        ImGui::TextDisabled("Computing…");
        return;
    }
    const std::vector<double>& spectrum = numbers->radiance.spectrum;
    Plot plot("##spectrum", plot_height(), {380.0, 780.0, "wavelength, nm"}, {0.0, 1.1 * highest({&spectrum}), ""});
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        const double nm = 380.0 + static_cast<double>(i);
        const ImVec2 top = plot.at(nm, spectrum[i]);
        const ImVec2 right = plot.at(nm + 1.0, 0.0);
        plot.draw().AddRectFilled(top, {right.x + 0.5F, plot.maximum().y}, wavelength_colour(nm, 0.85F));
    }
    const glm::dvec3 working = session.preview().xyz_to_working() * numbers->radiance.reference;
    glm::vec3 shown(working);
    display_.apply_cpu(std::span(&shown, 1), session.stage.exposure_stops);
    row("XYZ, reference", numbers_of(numbers->radiance.reference));
    row("XYZ, as drawn", numbers_of(numbers->radiance.drawn));
    row("Working RGB", numbers_of(working));
    row("Display value", numbers_of(glm::dvec3(shown)));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float font = ImGui::GetFontSize();
    const glm::vec3 held = glm::clamp(shown, 0.0F, 1.0F);
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + ImGui::GetContentRegionAvail().x, at.y + font},
                                              ImGui::ColorConvertFloat4ToU32({held.r, held.g, held.b, 1.0F}));
    ImGui::Dummy({0.0F, font});
    if (const auto& picked = session.picked()) {
        row("Pixel, working", numbers_of(glm::dvec3(picked->working)));
        row("Pixel, display", fmt::format("{}  {}  {}", picked->display.r, picked->display.g, picked->display.b));
        controls.note("picked", fmt::format("{} {} {}", picked->display.r, picked->display.g, picked->display.b));
    } else {
        ImGui::TextDisabled("Click the picture to pick another point.");
    }
    if (!session.point_numbers_are_current()) ImGui::TextDisabled("Updating…");
    controls.note("point", numbers_of(numbers->radiance.reference));
}

void PhysicsPanel::draw_sweep(const Session& session) const {
    const PointNumbers* numbers = session.point_numbers();
    if (numbers == nullptr) {
        ImGui::TextDisabled("Computing…");
        return;
    }
    const ViewSweep& sweep = numbers->sweep;
    double lowest = 0.0;
    for (const double value : sweep.harmonics) lowest = std::min(lowest, value);
    Plot plot("##sweep", plot_height(), {-80.0, 80.0, "angle of view, degrees"},
              {1.05 * lowest, 1.1 * highest({&sweep.reference, &sweep.harmonics, &sweep.drawn}), "Y"});
    const auto draw_line = [&](const std::vector<double>& values, const std::string& name, std::size_t series) {
        std::vector<glm::dvec2> line;
        for (std::size_t i = 0; i < values.size(); ++i) line.emplace_back(sweep.angles_deg[i], values[i]);
        plot.line(line, series);
        plot.legend(name, series);
    };
    draw_line(sweep.reference, "reference", 0);
    draw_line(sweep.harmonics, fmt::format("SH, {} bands", sweep.bands), 1);
    draw_line(sweep.drawn, "as drawn", 2);
}

void PhysicsPanel::draw_energy(const diffraction::Grating& grating, ControlMap& controls) const {
    const EnergyBalance balance =
        energy_balance(grating, static_cast<double>(wavelength_nm_),
                       std::sin(static_cast<double>(incidence_deg_) * std::numbers::pi / 180.0));
    const std::array<std::pair<const char*, double>, 5> shares = {{{"orders", balance.orders},
                                                                   {"zero order", balance.zero},
                                                                   {"absorbed", balance.absorbed},
                                                                   {"evanescent", balance.evanescent},
                                                                   {"to the base", balance.rest}}};
    const float font = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::Dummy({width, 1.4F * font});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    float left = corner.x;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const float right = left + width * static_cast<float>(shares[i].second);
        draw.AddRectFilled({left, corner.y}, {right, corner.y + 1.3F * font}, series_colour(i));
        left = right;
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (i % 2 != 0) ImGui::SameLine(width / 2.0F + 0.6F * font);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        draw.AddRectFilled({at.x, at.y + 0.25F * font}, {at.x + 0.7F * font, at.y + 0.95F * font}, series_colour(i));
        ImGui::Dummy({0.8F * font, font});
        ImGui::SameLine();
        ImGui::Text("%s %.1f %%", shares[i].first, 100.0 * shares[i].second);
        controls.note(std::string("share ") + shares[i].first, fmt::format("{:.4f}", shares[i].second));
    }
}

}  // namespace rowland::inspector
