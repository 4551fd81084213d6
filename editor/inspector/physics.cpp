#include "editor/inspector/physics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/lighting/lobe_nodes.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/reference/incident_light.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/reference/film_reference.h"

namespace rowland::inspector {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec3 direction(double angle_deg) {
    return {std::sin(angle_deg * kDegree), 0.0, std::cos(angle_deg * kDegree)};
}

std::vector<int> shown_orders(const diffraction::Grating& grating) {
    std::vector<int> orders = grating.orders;
    if (std::find(orders.begin(), orders.end(), 0) == orders.end()) orders.push_back(0);
    std::sort(orders.begin(), orders.end());
    return orders;
}

/// Efficiencies that depend on the direction are 0 where the order does not leave the surface.
double efficiency_of(const diffraction::Grating& grating, int order, double wavelength_nm, double s_g = 0.0) {
    if (!depends_on_direction(grating) && order == 0) return diffraction::zero_order_efficiency(grating, wavelength_nm);
    if (depends_on_direction(grating) && !diffraction::diffracted_cosine(s_g, order, wavelength_nm, grating.pitch_nm))
        return 0.0;
    return diffraction::order_efficiency(grating, order, wavelength_nm, s_g);
}

double absorbed_fraction(const diffraction::Grating& grating, double wavelength_nm, double s_g) {
    if (grating.theory == diffraction::Theory::Rigorous) {
        double reflected = 0.0;
        for (const int order : grating.efficiencies->orders)
            reflected += efficiency_of(grating, order, wavelength_nm, s_g);
        return std::max(0.0, 1.0 - reflected);
    }
    if (const auto* table = std::get_if<diffraction::EfficiencyTable>(&grating.profile)) {
        double reflected = 0.0;
        for (const int order : table->orders)
            reflected += diffraction::profile_efficiency(grating.profile, grating.pitch_nm, order, wavelength_nm, s_g);
        return std::max(0.0, 1.0 - reflected);
    }
    return 1.0 - diffraction::reflectance(grating, wavelength_nm);
}

/// Texels of the whole picture, of which the figure shows the middle.
constexpr int kPictureSize = 512;
/// Luminance over that of the brightest texel. Fainter texels do not widen the figure.
constexpr double kFaintest = 1e-3;
/// Texels around the outermost order.
constexpr int kMargin = 4;

/// Half the side, in texels, of the middle square that contains all texels brighter than `faintest`, and a margin.
int lit_half(const std::vector<glm::dvec3>& xyz, int size, double faintest) {
    int half = 0;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            if (xyz[static_cast<std::size_t>(row * size + column)].y > faintest)
                half = std::max({half, std::abs(2 * row + 1 - size), std::abs(2 * column + 1 - size)});
    return std::min(half / 2 + 1 + kMargin, size / 2);
}

constexpr std::size_t kFramesAtOnce = 4;  ///< between two checks of the stop token

std::vector<double> luminances(const std::vector<glm::dvec3>& xyz) {
    std::vector<double> result;
    for (const glm::dvec3& value : xyz) result.push_back(value.y);
    return result;
}

/// Shades by `bands` bands of the light's SH, PHYSICS (5.3).
diffraction::PointShader harmonics_shader(const diffraction::Material& material,
                                          const diffraction::EvaluationLight& light, int bands) {
    return diffraction::in_tangent_frame(
        light.harmonics(bands),
        [terms = diffraction::TransferTerms(material.grating, colour::LightSpectra(material.quality.illuminant),
                                            bands)](const lighting::ShLight& rotated, const glm::dvec3& view) {
            const std::vector<glm::dmat3> coefficients = terms.coefficients(view.x, view.y);
            glm::dvec3 xyz(0.0);
            for (std::size_t i = 0; i < coefficients.size(); ++i) xyz += coefficients[i] * rotated.coefficients[i];
            return xyz;
        });
}

constexpr int kAngles = 86;        ///< 0 to 85 degrees
constexpr int kThicknesses = 161;  ///< every 5 nm
constexpr double kThicknesses_nm = 800.0;

double cosine_of(double angle_deg) {
    return std::cos(angle_deg * std::numbers::pi / 180.0);
}

/// One film by the exact sum, by glTF's formula and by the table.
class FilmModels {
 public:
    explicit FilmModels(const FilmInputs& inputs)
        : inputs_(inputs),
          thickest_nm_(std::max(kThicknesses_nm, inputs.film.layers.front().thickness_nm)),
          thinnest_nm_(thickest_nm_ - kThicknesses_nm),
          colour_(inputs.film, colour::LightSpectra(colour::illuminant(inputs.illuminant))),
          base_f0_(thin_film::normal_colour(inputs.film.base)) {
        if (inputs.roughness > 0.0) rough_.emplace(colour_, thinnest_nm_, thickest_nm_);
    }

    /// At one angle, for several thicknesses.
    std::vector<glm::dvec3> exact(double cosine, const std::vector<double>& thicknesses_nm) const {
        std::vector<glm::dvec3> result;
        const glm::dvec3 white(1.0);
        if (rough_) {
            const std::vector<double> angles =
                lighting::lobe_angles(cosine, inputs_.roughness, thin_film::RoughFilm::kAngleSteps);
            for (const double nm : thicknesses_nm) result.push_back(rough_->average(angles, nm) * white);
        } else {
            const thin_film::FilmColour::AtAngle at = colour_.at(cosine);
            for (const double nm : thicknesses_nm) result.push_back(at(nm) * white);
        }
        return result;
    }
    glm::dvec3 formula(double cosine, double thickness_nm) const {
        return colour::rec709_to_xyz() *
               thin_film::gltf_formula(colour_.film().layers.front().index.real(), thickness_nm, base_f0_, cosine);
    }
    thin_film::FilmTable table() const {
        const thin_film::TableRange range{.thinnest_nm = thinnest_nm_,
                                          .thickest_nm = thickest_nm_,
                                          .smoothest = inputs_.roughness,
                                          .roughest = inputs_.roughness};
        return thin_film::bake_table(colour_, range, thin_film::table_size(range));
    }
    double thinnest_nm() const { return thinnest_nm_; }

 private:
    FilmInputs inputs_;
    double thickest_nm_;
    double thinnest_nm_;
    thin_film::FilmColour colour_;
    glm::dvec3 base_f0_;
    std::optional<thin_film::RoughFilm> rough_;
};

FilmCurves without_table(const FilmInputs& inputs, const FilmModels& models) {
    FilmCurves curves;
    const thin_film::Film& film = inputs.film;
    const thin_film::Film bare{.layers = {}, .base = film.base};
    const double thickness_nm = film.layers.front().thickness_nm;
    const bool has_formula = film.layers.size() == 1;
    const double cosine = cosine_of(inputs.angle_deg);
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; ++nm) {
        curves.spectrum.emplace_back(nm, thin_film::reflectance(film, nm, cosine));
        curves.bare.emplace_back(nm, thin_film::reflectance(bare, nm, cosine));
    }
    for (int i = 0; i < kAngles; ++i) {
        const double at = cosine_of(i);
        curves.angles_deg.push_back(i);
        curves.over_angle.exact.push_back(models.exact(at, {thickness_nm}).front());
        if (has_formula) curves.over_angle.formula.push_back(models.formula(at, thickness_nm));
    }
    for (int i = 0; i < kThicknesses; ++i) {
        curves.thicknesses_nm.push_back(models.thinnest_nm() + kThicknesses_nm * i / (kThicknesses - 1));
        if (has_formula) curves.over_thickness.formula.push_back(models.formula(cosine, curves.thicknesses_nm.back()));
    }
    curves.over_thickness.exact = models.exact(cosine, curves.thicknesses_nm);
    if (has_formula)
        curves.formula_error = diffraction::relative_rms(curves.over_thickness.formula, curves.over_thickness.exact);
    return curves;
}

}  // namespace

AngleCurve angle_curve(const diffraction::Grating& grating, double wavelength_nm, double incidence_deg, int samples) {
    glm::dvec3 s = direction(incidence_deg);
    if (grating.transmission) s.z = -s.z;
    const auto brdf = [&](double angle_deg) {
        return diffraction::brdf_energy(grating, s, direction(angle_deg), wavelength_nm);
    };
    AngleCurve curve;
    std::vector<double> angles;
    for (int i = 0; i < samples; ++i) angles.push_back(-90.0 + 180.0 * i / (samples - 1));
    const double width = wavelength_nm / (grating.grooves * grating.pitch_nm);  // of a peak, in v_g
    for (const int order : shown_orders(grating)) {
        const auto v_g = diffraction::diffracted_cosine(s.x, order, wavelength_nm, grating.pitch_nm);
        if (!v_g) continue;
        const double angle = std::asin(*v_g) / kDegree;
        curve.peaks.push_back({order, angle, efficiency_of(grating, order, wavelength_nm, s.x), brdf(angle)});
        for (int i = -8; i <= 8; ++i) {
            const double near = *v_g + i * width / 4.0;
            if (std::abs(near) < 1.0) angles.push_back(std::asin(near) / kDegree);
        }
    }
    std::sort(angles.begin(), angles.end());
    for (const double angle : angles) curve.points.emplace_back(angle, brdf(angle));
    std::sort(curve.peaks.begin(), curve.peaks.end(),
              [](const OrderPeak& a, const OrderPeak& b) { return a.angle_deg < b.angle_deg; });
    return curve;
}

std::vector<EfficiencyCurve> efficiency_curves(const diffraction::Grating& grating, double s_g, std::size_t most) {
    constexpr int kStep = 4;
    std::vector<std::pair<double, EfficiencyCurve>> curves;  // with the sort key: the negative sum; order 0 first
    for (const int order : shown_orders(grating)) {
        EfficiencyCurve curve{order, {}};
        double sum = 0.0;
        for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kStep) {
            curve.points.emplace_back(nm, efficiency_of(grating, order, nm, s_g));
            sum += curve.points.back().y;
        }
        curves.emplace_back(order == 0 ? -HUGE_VAL : -sum, std::move(curve));
    }
    std::stable_sort(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (curves.size() > most) curves.resize(most);
    std::sort(curves.begin(), curves.end(),
              [](const auto& a, const auto& b) { return a.second.order < b.second.order; });
    std::vector<EfficiencyCurve> result;
    for (auto& [sum, curve] : curves) result.push_back(std::move(curve));
    return result;
}

EnergyBalance energy_balance(diffraction::Grating grating, double wavelength_nm, double s_g) {
    grating.normalization = diffraction::Normalization::Energy;
    EnergyBalance balance{.zero = efficiency_of(grating, 0, wavelength_nm, s_g),
                          .absorbed = absorbed_fraction(grating, wavelength_nm, s_g)};
    for (const int order : grating.orders) {
        if (order == 0) continue;
        const bool leaves = diffraction::diffracted_cosine(s_g, order, wavelength_nm, grating.pitch_nm).has_value();
        (leaves ? balance.orders : balance.evanescent) += efficiency_of(grating, order, wavelength_nm, s_g);
    }
    balance.residual = std::max(0.0, 1.0 - balance.orders - balance.zero - balance.evanescent - balance.absorbed);
    return balance;
}

std::vector<OrderTrace> order_directions(const diffraction::Grating& grating, const glm::dvec3& s) {
    constexpr int kStep = 5;
    std::vector<OrderTrace> traces;
    for (const int order : shown_orders(grating)) {
        OrderTrace trace{order, {}};
        for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kStep) {
            const auto v_g = diffraction::diffracted_cosine(s.x, order, nm, grating.pitch_nm);
            if (v_g && *v_g * *v_g + s.y * s.y < 1.0) trace.spots.push_back({static_cast<double>(nm), *v_g, -s.y});
        }
        if (!trace.spots.empty()) traces.push_back(std::move(trace));
    }
    return traces;
}

KernelStrip kernel_strip(const diffraction::KernelTable& kernel, double pitch_nm, int cells) {
    KernelStrip strip{.begin_nm = std::max(kernel.begin_nm, -2.0 * pitch_nm),
                      .end_nm = std::min(kernel.end_nm, 2.0 * pitch_nm),
                      .xyz = {}};
    if (!(strip.begin_nm < strip.end_nm)) return strip;
    const double cell = (strip.end_nm - strip.begin_nm) / cells;
    for (int i = 0; i < cells; ++i) {
        const double begin = strip.begin_nm + i * cell;
        strip.xyz.push_back(kernel.average(begin, begin + cell) * glm::dvec3(1.0));
    }
    return strip;
}

const glm::dvec3& PatternFigure::at(double u_g, double u_h) const {
    const auto texel = [&](double u) {
        return std::clamp(static_cast<int>(0.5 * (u / half_width + 1.0) * size), 0, size - 1);
    };
    return xyz[static_cast<std::size_t>(texel(u_h) * size + texel(u_g))];
}

PatternFigure pattern_figure(const diffraction::Material& material) {
    const diffraction::PatternPicture picture =
        diffraction::pattern_picture(material.grating, colour::LightSpectra(material.quality.illuminant), kPictureSize);
    const diffraction::PatternPicture::Level& finest = picture.levels.front();
    std::vector<glm::dvec3> white;
    white.reserve(finest.density.size());
    double brightest = 0.0;
    for (const glm::mat3& density : finest.density) {
        white.push_back(glm::dmat3(density) * glm::dvec3(1.0));
        brightest = std::max(brightest, white.back().y);
    }
    PatternFigure figure;
    if (!(brightest > 0.0)) return figure;
    const int half = lit_half(white, finest.size, kFaintest * brightest);
    figure.size = 2 * half;
    figure.half_width = picture.half_width * figure.size / finest.size;
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (int row = finest.size / 2 - half; row < finest.size / 2 + half; ++row)
        for (int column = finest.size / 2 - half; column < finest.size / 2 + half; ++column) {
            const glm::dvec3& xyz = white[static_cast<std::size_t>(row * finest.size + column)];
            sum += xyz.y;
            sum_of_squares += xyz.y * xyz.y;
            figure.xyz.push_back(xyz);
        }
    for (glm::dvec3& xyz : figure.xyz) xyz *= sum / sum_of_squares;
    return figure;
}

std::vector<double> spectrum_at(const diffraction::Material& material, const lighting::ProbeImage& probe,
                                const diffraction::ShadingPoint& frame) {
    const diffraction::Grating& grating = material.grating;
    const colour::LightSpectra spectra(material.quality.illuminant);
    const diffraction::IncidentLight light(probe);
    const glm::dmat3 to_tangent = diffraction::world_to_tangent(frame);
    const glm::dvec3 view = to_tangent * glm::normalize(frame.view);
    const glm::dmat3 light_axes = grating.transmission ? diffraction::mirrored_in_surface(to_tangent) : to_tangent;
    std::vector<double> spectrum(colour::kVisibleMax - colour::kVisibleMin + 1, 0.0);
    if (view.z <= 0.0) return spectrum;
    const double passed = diffraction::transmittance(grating.cover, view.z);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        const double nm = colour::kVisibleMin + static_cast<double>(i);
        for (const int order : grating.orders) {
            const double a = order * nm / grating.pitch_nm - view.x;
            if (order == 0 || std::abs(a) >= 1.0) continue;
            const glm::dvec3 arc = arc_profile(light, light_axes, grating.lobe,
                                               {.a = a, .v_h = view.y, .wavelength_nm = nm}, grating.cover);
            spectrum[i] += passed * diffraction::order_efficiency(grating, order, nm, a) * glm::dot(spectra(nm), arc);
        }
    }
    return spectrum;
}

PointRadiance point_radiance(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                             const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& frame,
                             diffraction::GrooveLayout layout) {
    const std::span<const diffraction::ShadingPoint> frames(&frame, 1);
    const colour::LightSpectra spectra(cooked.material.quality.illuminant);
    return {.spectrum = spectrum_at(cooked.material, probe, frame),
            .reference = reference_radiance(cooked.material.grating, probe, spectra, frames)[0],
            .drawn = evaluate_baked(cooked, light, frames, layout)[0]};
}

ViewSweep view_sweep(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                     const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& surface,
                     diffraction::GrooveLayout layout, int bands, int views, const std::stop_token& stop) {
    constexpr double kWidest_deg = 80.0;
    const glm::dmat3 to_world = glm::transpose(diffraction::world_to_tangent(surface));
    ViewSweep sweep;
    sweep.bands = bands;
    std::vector<diffraction::ShadingPoint> frames;
    for (int i = 0; i < views; ++i) {
        const double angle = kWidest_deg * (2.0 * i / (views - 1) - 1.0);
        const double radians = angle * std::numbers::pi / 180.0;
        diffraction::ShadingPoint frame = surface;
        frame.view = to_world * glm::dvec3(std::sin(radians), 0.0, std::cos(radians));
        frames.push_back(frame);
        sweep.angles_deg.push_back(angle);
    }
    const colour::LightSpectra spectra(cooked.material.quality.illuminant);
    for (std::size_t i = 0; i < frames.size() && !stop.stop_requested(); i += kFramesAtOnce) {
        const std::span part = std::span(frames).subspan(i, std::min(kFramesAtOnce, frames.size() - i));
        for (const glm::dvec3& xyz : reference_radiance(cooked.material.grating, probe, spectra, part))
            sweep.reference.push_back(xyz.y);
    }
    if (stop.stop_requested()) return sweep;
    sweep.drawn = luminances(evaluate_baked(cooked, light, frames, layout));
    const diffraction::EvaluationLight whole(probe, 0, math::SphericalWindow::None);
    std::vector<glm::dvec3> harmonics =
        evaluate_points("harmonics", harmonics_shader(cooked.material, whole, bands), cooked, whole, frames);
    add_reflected_side(cooked, whole, frames, harmonics);
    sweep.harmonics = luminances(harmonics);
    return sweep;
}

std::optional<FilmCurves> film_curves(const FilmInputs& inputs, const std::stop_token& stop,
                                      const std::function<void(FilmCurves)>& publish) {
    const FilmModels models(inputs);
    FilmCurves curves = without_table(inputs, models);
    publish(curves);
    if (stop.stop_requested()) return std::nullopt;
    const thin_film::FilmTable table = models.table();
    const glm::dvec3 white(1.0);
    const double thickness_nm = inputs.film.layers.front().thickness_nm;
    for (const double angle_deg : curves.angles_deg)
        curves.over_angle.table.push_back(table.at(cosine_of(angle_deg), thickness_nm, inputs.roughness) * white);
    for (const double nm : curves.thicknesses_nm)
        curves.over_thickness.table.push_back(table.at(cosine_of(inputs.angle_deg), nm, inputs.roughness) * white);
    curves.table_error = diffraction::relative_rms(curves.over_thickness.table, curves.over_thickness.exact);
    curves.complete = true;
    return curves;
}

}  // namespace rowland::inspector
