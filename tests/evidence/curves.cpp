#include "tests/evidence/curves.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/text.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/rigorous/solver.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

constexpr double kFirst_nm = 380.0;
constexpr double kLast_nm = 780.0;
constexpr const char* kFitted = "fitted to this curve";

diffraction::Grating with_depth(diffraction::Grating grating, double depth_nm) {
    std::get<diffraction::BlazedProfile>(grating.profile).depth_nm = depth_nm;
    return grating;
}

double depth_of(const diffraction::Grating& grating) {
    return std::get<diffraction::BlazedProfile>(grating.profile).depth_nm;
}

diffraction::Grating preset(const std::string& name) {
    return diffraction::load_material(ROWLAND_SOURCE_FOLDER "/content/materials/" + name + ".json").grating;
}

diffraction::Grating ruled_400(double depth_nm) {
    diffraction::Grating grating = preset("ruled_600");
    grating.pitch_nm = 2500.0;
    return with_depth(grating, depth_nm);
}

/// The depth of facets that are mirrors for a wavelength at Littrow.
double blazed_depth(double pitch_nm, double blaze_nm) {
    return pitch_nm * std::tan(std::asin(blaze_nm / (2.0 * pitch_nm)));
}

Json line(const std::vector<CurvePoint>& curve, double CurvePoint::*value, const std::string& name, const char* kind) {
    Json points = Json::array();
    for (const CurvePoint& point : curve) points.push_back({point.wavelength_nm, point.*value});
    return {{"name", name}, {"kind", kind}, {"points", points}};
}

Json curve_plot(const RuledGrating& ruled, const std::vector<CurvePoint>& curve) {
    return {{"caption", fmt::format("{}: {:.0f} lines/mm, facets {:.0f} nm deep", ruled.name,
                                    1e6 / ruled.grating.pitch_nm, depth_of(ruled.grating))},
            {"x", {{"label", "wavelength (nm)"}, {"from", kFirst_nm}, {"to", kLast_nm}}},
            {"y", {{"label", "first-order efficiency"}, {"from", 0.0}, {"to", 1.0}}},
            {"series",
             {line(curve, &CurvePoint::measured, "manufacturer", "points"),
              line(curve, &CurvePoint::rigorous, "Maxwell's equations", "line"),
              line(curve, &CurvePoint::scalar, "scalar theory", "line")}}};
}

/// The RMS error of rigorous theory against the depth: what the preset's depth minimises.
Json depth_plot(const std::filesystem::path& folder, const std::vector<RuledGrating>& gratings) {
    constexpr double kStep_nm = 20.0;
    constexpr int kSteps = 3;
    Json series = Json::array();
    for (const RuledGrating& ruled : gratings) {
        if (ruled.depth_from != kFitted) continue;
        Json points = Json::array();
        for (int i = -kSteps; i <= kSteps; ++i) {
            const double depth_nm = depth_of(ruled.grating) + kStep_nm * i;
            // B1200 has rows every 5 nm, the others every 25.
            const std::size_t stride = ruled.name == "ruled_1200" ? 8 : 2;
            points.push_back(
                {depth_nm, curve_rms(compare_curve(folder / ruled.curve, with_depth(ruled.grating, depth_nm), stride),
                                     &CurvePoint::rigorous)});
        }
        series.push_back({{"name", ruled.name}, {"kind", "line"}, {"points", points}});
    }
    return {{"caption", "RMS error of Maxwell's equations against the depth of the facets, every 40 to 50 nm"},
            {"x", {{"label", "depth (nm)"}, {"from", 200.0}, {"to", 540.0}}},
            {"y", {{"label", "RMS error of the efficiency"}, {"from", 0.0}, {"to", 0.2}}},
            {"series", series}};
}

}  // namespace

std::vector<CurvePoint> compare_curve(const std::filesystem::path& csv, const diffraction::Grating& grating,
                                      std::size_t stride) {
    ROWLAND_CHECK_OP(stride, >=, 1U);
    const diffraction::Relief relief = diffraction::relief_of(grating, csv.string());
    const diffraction::Substrate substrate = diffraction::substrate_of(grating);
    diffraction::Grating scalar = grating;
    scalar.theory = diffraction::Theory::Scalar;
    std::vector<CurvePoint> curve;
    const NumberTable table = read_number_table(csv, "wavelength_nm,efficiency");
    std::size_t row = 0;
    for (const auto& values : table.rows) {
        const double wavelength_nm = values[0];
        if (wavelength_nm < kFirst_nm || wavelength_nm > kLast_nm || row++ % stride != 0) continue;
        const double littrow = 0.5 * wavelength_nm / grating.pitch_nm;
        const diffraction::Converged solved =
            solve_converged(relief, diffraction::index_of(substrate, wavelength_nm), wavelength_nm, littrow);
        curve.push_back({.wavelength_nm = wavelength_nm,
                         .measured = values[1],
                         .scalar = order_efficiency(scalar, 1, wavelength_nm),
                         .rigorous = leaving(solved.efficiencies, 1, substrate)});
    }
    return curve;
}

double curve_rms(const std::vector<CurvePoint>& curve, double CurvePoint::*model) {
    double sum = 0.0;
    for (const CurvePoint& point : curve) sum += std::pow(point.*model - point.measured, 2);
    return std::sqrt(sum / static_cast<double>(curve.size()));
}

std::vector<RuledGrating> ruled_gratings() {
    return {{"ruled_600", "B600_G5303.csv", preset("ruled_600"), kFitted},
            {"ruled_1200", "B1200_G5301.csv", preset("ruled_1200"), kFitted},
            {"400 lines/mm", "R400_G5305.csv", ruled_400(460.0), kFitted},
            {"400 lines/mm by name", "R400_G5305.csv", ruled_400(blazed_depth(2500.0, 764.0)),
             "the blaze in its name, 764 nm; nothing is fitted"}};
}

Json curves(const Inputs& inputs) {
    const std::filesystem::path folder = inputs.data / "data" / "measured";
    const std::vector<RuledGrating> gratings = ruled_gratings();
    Json rows = Json::array();
    Json plots = Json::array();
    Json figures;
    for (const RuledGrating& ruled : gratings) {
        const std::vector<CurvePoint> curve = compare_curve(folder / ruled.curve, ruled.grating);
        const double rigorous = curve_rms(curve, &CurvePoint::rigorous);
        const double scalar = curve_rms(curve, &CurvePoint::scalar);
        rows.push_back({ruled.name, fmt::format("{:.0f}", 1e6 / ruled.grating.pitch_nm),
                        fmt::format("{:.0f}", depth_of(ruled.grating)), ruled.depth_from, std::to_string(curve.size()),
                        digits(rigorous, 2), digits(scalar, 2)});
        plots.push_back(curve_plot(ruled, curve));
        figures["curves.rigorous_rms." + ruled.name] = rigorous;
        figures["curves.scalar_rms." + ruled.name] = scalar;
    }
    plots.push_back(depth_plot(folder, gratings));
    return {
        {"title", "Ruled gratings: a manufacturer's curves"},
        {"text",
         {"First-order efficiency of replica gratings near Littrow, aluminium, taken as unpolarised: Richardson "
          "Gratings Laboratory's curves as the Gemini project tabulates them for its spectrograph GMOS (files "
          "gmos_n_*.dat of gemini-hlsw/ocs, © AURA 1998–2015). The laboratory states no error; the project "
          "extrapolated the ends below 385 nm and beyond 900 nm.",
          "The model is a blazed relief of aluminium with sharp edges. Its one free number, the depth of the "
          "facets, is fitted for the presets ruled_600 and ruled_1200: the error has its minimum at the depth that "
          "they have. The depth that follows from the blaze in a grating's name is no substitute: the curve of the "
          "grating of 400 lines/mm peaks at 951 nm and not at the 764 nm of its name. Real facets are neither flat nor "
          "sharp, and "
          "aluminium carries an oxide that the model leaves out."}},
        {"tables",
         {{{"caption", "RMS difference of the efficiency from the curve, 380 to 780 nm"},
           {"columns",
            {"grating", "lines/mm", "depth (nm)", "depth set by", "points", "Maxwell's equations", "scalar theory"}},
           {"rows", rows}}}},
        {"plots", plots},
        {"figures", figures}};
}

}  // namespace rowland::evidence
