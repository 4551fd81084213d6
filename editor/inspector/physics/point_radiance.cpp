#include "editor/inspector/physics/point_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/reference/arc_profile.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::inspector {

namespace {

constexpr std::size_t kFramesAtOnce = 4;  ///< between two checks of the stop token

std::vector<double> luminances(const std::vector<glm::dvec3>& xyz) {
    std::vector<double> result;
    for (const glm::dvec3& value : xyz) result.push_back(value.y);
    return result;
}

/// The material with transfer in place of its own representation, without key lights.
diffraction::CookedMaterial as_harmonics(const diffraction::CookedMaterial& cooked, int bands) {
    diffraction::CookedMaterial result = cooked;
    diffraction::Quality& quality = result.material.quality;
    quality.pinned = diffraction::TransferSettings{.bands = bands, .grid = {}, .storage = diffraction::Storage::Half};
    quality.key_lights = 0;
    result.tables = diffraction::bake_tables(result.material.grating, representation(result.material));
    return result;
}

}  // namespace

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
                             const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& frame) {
    const std::span<const diffraction::ShadingPoint> frames(&frame, 1);
    const colour::LightSpectra spectra(cooked.material.quality.illuminant);
    return {.spectrum = spectrum_at(cooked.material, probe, frame),
            .reference = reference_radiance(cooked.material.grating, probe, spectra, frames)[0],
            .drawn = evaluate_baked(cooked, light, frames)[0]};
}

ViewSweep view_sweep(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                     const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& surface, int bands,
                     int views, const std::stop_token& stop) {
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
    sweep.drawn = luminances(evaluate_baked(cooked, light, frames));
    const diffraction::EvaluationLight whole(probe, 0, math::SphericalWindow::None);
    sweep.harmonics = luminances(evaluate_baked(as_harmonics(cooked, bands), whole, frames));
    return sweep;
}

}  // namespace rowland::inspector
