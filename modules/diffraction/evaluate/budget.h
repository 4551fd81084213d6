#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/representation.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::diffraction {

/// Light that an error is measured under.
struct BudgetProbe {
    std::string name;  ///< for messages and the record
    lighting::ProbeImage image;
    int key_lights = 16;  ///< most that are taken out of it where key lights are shaded on their own
};

/// What a budget is paid in: fetches a pixel, as counted and never timed. Eight multiply-adds count as a fetch, so does
/// a quarter of what is read of 1 MiB of tables; vertices count as many as the paper's disc has (25 000) on half of
/// 1280 × 720 pixels; every key light counts for every pixel. What is filled once for each turn of object or light
/// counts by its bytes.
double shading_price(const ShadingCost& cost, int key_lights);

/// Settings that a material could pin, as the members of its "quality": what a budget chooses from.
std::vector<nlohmann::json> budget_candidates(const Grating& grating, SurfaceShape surface);

/// A representation chosen for a material.
struct BudgetChoice {
    nlohmann::json settings;  ///< of budget_candidates()
    CookedMaterial cooked;    ///< baked with them, and with the record of what was measured
};

/// The cheapest representation whose error is within the material's quality.max_error under every probe: candidates by
/// shading_price(), the first that does. Errors are relative_rms() over the frames, against reference_radiance() at the
/// material's illuminant, whatever the probes' own; light is taken without a window. The material pins nothing.
///
/// Runs on all cores; the result does not depend on their number. Throws Error (input) naming `file` and the best that
/// can be reached if nothing is within max_error.
BudgetChoice choose_representation(const Material& material, std::span<const BudgetProbe> probes,
                                   std::span<const Frame> frames, const std::string& file);

}  // namespace rowland::diffraction
