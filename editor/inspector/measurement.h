#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <vector>

#include "editor/inspector/light.h"
#include "editor/inspector/open_document.h"
#include "editor/inspector/physics.h"
#include "editor/inspector/view.h"
#include "engine/core/computed.h"
#include "engine/core/log.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::inspector {

struct PricedChoice {
    nlohmann::json settings;  ///< members of "quality"
    diffraction::ShadingCost cost;
    double price = 0.0;     ///< shading_price()
    double error = 0.0;     ///< against the reference, by PriceList::measure; off the front a lower bound
    bool candidate = true;  ///< one of budget_candidates()
    bool present = false;   ///< the choice that the material pins
    bool on_front = false;  ///< on the candidates' Pareto front of price and error
};

/// The choices measured so far.
struct PriceList {
    std::vector<PricedChoice> choices;  ///< in the order they were measured, the present one first
    std::size_t done = 0;               ///< steps: bakes and measurements
    std::size_t total = 0;
    diffraction::ErrorMeasure measure = diffraction::ErrorMeasure::RelativeRms;  ///< the material's
};

struct PriceQuery {
    diffraction::Material material;
    nlohmann::json quality;  ///< the material's; used if it pins a representation
    const lighting::ProbeImage& probe;
    int key_lights = 16;
    bool pinned_only = false;  ///< measures only the choice that the material pins
};

/// Measures the choice that the material pins, then all budget_candidates() sorted by price, by diffraction::search()
/// over drawn_views(), as choose_representation() does. Reports the list after each step. A stop request ends it
/// between two settings.
void price_choices(const PriceQuery& query, const std::function<void(const PriceList&)>& report,
                   const std::stop_token& stop);

/// The cheapest candidate within `max_error`, as choose_representation() chooses it. nullopt if there is none.
std::optional<PricedChoice> cheapest_within(const PriceList& list, double max_error);

/// Numbers of one point of the surface.
struct PointNumbers {
    PointRadiance radiance;
    ViewSweep sweep;
};

/// Values of the document under the light that take seconds, computed in the background: the numbers of the picked
/// point, the pattern of a lattice, the prices of representations.
class Measurement {
 public:
    /// All arguments must outlive it.
    Measurement(OpenDocument& document, const LightChoice& light, View& view, Messages& messages)
        : document_(document), light_(light), view_(view), messages_(messages) {}

    /// Call it every frame, after the update() of the others. Returns whether there is a new result or message.
    bool update();
    bool busy() const { return pattern_.busy() || point_.busy() || pricing(); }

    /// Of View::point_or_middle(); null before the first is computed.
    const PointNumbers* point_numbers() const { return point_.value(); }
    bool point_numbers_are_current() const { return point_.current(); }
    /// Of the last material with a lattice; null before the first is computed.
    std::shared_ptr<const PatternFigure> pattern() const { return pattern_.value() ? *pattern_.value() : nullptr; }

    /// Measures all choices for the current material and light. The choice that the material pins is measured without a
    /// request, once nothing else is computed.
    void measure_all() { requested_ = price_inputs(true); }
    void stop_pricing();
    bool pricing() const { return all_prices_.busy() || pinned_price_.busy(); }
    PriceList prices() const;
    /// Whether prices() belong to the current material and light.
    bool prices_are_current() const {
        return all_prices_.is_of(price_inputs(true)) || pinned_price_.is_of(price_inputs(false));
    }
    /// Pins the choice in the document.
    void choose(const PricedChoice& choice);
    /// Pins the cheapest choice within an error, after measuring all choices if they are not measured yet.
    void cook_to_budget(double max_error);

 private:
    struct PointInputs {
        OpenDocument::Cooked cooked;
        LightChoice::Light light;
        std::shared_ptr<const diffraction::ShadingPoint> point;  ///< null: near the middle of the picture

        friend bool operator==(const PointInputs&, const PointInputs&) = default;
    };
    struct PriceInputs {
        Json material;
        LightChoice::Light light;
        diffraction::SurfaceShape surface = diffraction::SurfaceShape::Flat;  ///< of the object in view

        friend bool operator==(const PriceInputs&, const PriceInputs&) = default;
    };
    using Prices = Computed<PriceInputs, PriceList>;

    const Document& document() const { return document_.document(); }
    /// `of_all`: without the material's own choice, on which the errors of all choices do not depend.
    PriceInputs price_inputs(bool of_all) const;
    Prices::Work price_work(bool pinned_only) const;
    void want_pattern();
    void want_point_numbers();
    void want_prices();
    bool all_measured() const;
    void apply_budget();

    OpenDocument& document_;
    const LightChoice& light_;
    View& view_;
    Messages& messages_;
    std::size_t last_replacements_ = 0;     ///< document_.replacements() in the last update()
    std::optional<PriceInputs> requested_;  ///< by measure_all()
    std::optional<PriceInputs> stopped_;    ///< by stop_pricing()
    std::optional<double> budget_;          ///< requested by cook_to_budget()

    // The destructors wait for the work, so these are last.
    Computed<std::shared_ptr<const MaterialSource>, std::shared_ptr<const PatternFigure>> pattern_;
    Computed<PointInputs, PointNumbers> point_;
    Prices all_prices_;
    Prices pinned_price_;
};

}  // namespace rowland::inspector
