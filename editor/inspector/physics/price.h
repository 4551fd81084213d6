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

struct PricedChoice {
    nlohmann::json settings;  ///< members of "quality"
    diffraction::ShadingCost cost;
    double price = 0.0;     ///< shading_price()
    double error = 0.0;     ///< against the reference, as PriceList::measure says
    bool candidate = true;  ///< one of budget_candidates(); else only what the material pins
    bool present = false;   ///< what the material pins
    bool on_front = false;  ///< no other choice is as good in price and error and better in one of them
};

/// What has been measured so far.
struct PriceList {
    std::vector<PricedChoice> choices;  ///< in the order they were measured, the present one first
    std::size_t done = 0;               ///< steps: bakes and measurements
    std::size_t total = 0;
    diffraction::ErrorMeasure measure = diffraction::ErrorMeasure::RelativeRms;  ///< the material's
};

struct PriceQuery {
    diffraction::Material material;
    nlohmann::json quality;  ///< the material's, where it pins a representation
    const lighting::ProbeImage& probe;
    int key_lights = 16;
    diffraction::SurfaceShape surface = diffraction::SurfaceShape::Flat;
    bool present_only = false;  ///< no candidates, only what the material pins
};

/// Measures the material as it is, then all budget_candidates(), the cheapest first, by diffraction::search() over
/// measured_points(): the search by which choose_representation() chooses. `report` gets the list after each step.
/// Returns early when it is asked to stop, between two settings.
void price_choices(const PriceQuery& query, const std::function<void(const PriceList&)>& report,
                   const std::stop_token& stop);

/// The cheapest choice within `max_error`: what choose_representation() takes. nullopt if there is none.
std::optional<PricedChoice> cheapest_within(const PriceList& list, double max_error);

}  // namespace rowland::inspector
