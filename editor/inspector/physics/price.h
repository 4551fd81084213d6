#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::inspector {

/// A representation with what it costs and what it loses.
struct PricedChoice {
    nlohmann::json settings;  ///< members of "quality"
    diffraction::ShadingCost cost;
    double price = 0.0;     ///< shading_price()
    double error = 0.0;     ///< relative RMS against the reference
    bool candidate = true;  ///< of budget_candidates(); else the material's own alone
    bool present = false;   ///< it is what the material pins
    bool on_front = false;  ///< nothing measured so far is both cheaper and better
};

/// What is measured so far.
struct PriceList {
    std::vector<PricedChoice> choices;  ///< in the order they were measured, the present one first
    std::size_t done = 0;               ///< steps: bakes and measurements
    std::size_t total = 0;
};

struct PriceQuery {
    diffraction::Material material;
    nlohmann::json quality;  ///< the material's, where it pins something
    const lighting::ProbeImage& probe;
    int key_lights = 16;
    diffraction::SurfaceShape surface = diffraction::SurfaceShape::Flat;
    bool present_only = false;  ///< what the material pins, and no candidates
};

/// Measures the material as it is, then every one of budget_candidates(), the cheapest first, over measured_frames()
/// under the probe: the errors by which choose_representation() chooses. `report` gets the list after each. Returns
/// early when it is asked to stop, between two settings.
void price_choices(const PriceQuery& query, const std::function<void(const PriceList&)>& report,
                   const std::stop_token& stop);

/// The cheapest choice within `max_error`: what choose_representation() takes. Nothing if none is.
std::optional<PricedChoice> cheapest_within(const PriceList& list, double max_error);

}  // namespace rowland::inspector
