#include "editor/inspector/physics/price.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "engine/colour/light_spectra.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality_json.h"
#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/representations/evaluation_light.h"
#include "modules/diffraction/evaluate/frame_sets.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/evaluate/radiance_error.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::inspector {

namespace {

constexpr int kMostBands = 16;
constexpr std::size_t kPricedAtOnce = 8;  ///< between two looks at whether to stop

struct Candidate {
    nlohmann::json settings;
    diffraction::Quality quality;
    std::shared_ptr<const diffraction::BakedTables> tables;  ///< shared by settings that differ in key lights alone
    double price = 0.0;
    bool present = false;
};

/// Errors under one probe, with what they are measured against.
class Measurement {
 public:
    Measurement(const PriceQuery& query, const std::stop_token& stop)
        : frames_(diffraction::measured_frames(query.surface)),
          whole_(query.probe, 0, math::SphericalWindow::None, lighting::project(query.probe, kMostBands)),
          divided_(query.probe, query.key_lights, math::SphericalWindow::None) {
        const colour::LightSpectra spectra(query.material.quality.illuminant);
        cooked_.material = query.material;
        const diffraction::ColourKernel kernel(query.material.grating, spectra);
        cooked_.kernel = tabulate(kernel);
        cooked_.zero_order_xyz = kernel.zero_order_xyz();
        for (std::size_t i = 0; i < frames_.size() && !stop.stop_requested(); i += kPricedAtOnce) {
            const std::span part = std::span(frames_).subspan(i, std::min(kPricedAtOnce, frames_.size() - i));
            const auto radiance = reference_radiance(query.material.grating, query.probe, spectra, part);
            reference_.insert(reference_.end(), radiance.begin(), radiance.end());
        }
    }

    double error(const Candidate& candidate) const {
        diffraction::CookedMaterial cooked = cooked_;
        cooked.material.quality = candidate.quality;
        cooked.tables = *candidate.tables;
        const auto& light = candidate.quality.key_lights ? divided_ : whole_;
        return diffraction::relative_rms(evaluate_baked(cooked, light, frames_), reference_);
    }

 private:
    std::vector<diffraction::Frame> frames_;
    diffraction::EvaluationLight whole_;
    diffraction::EvaluationLight divided_;
    diffraction::CookedMaterial cooked_;  ///< without tables of its own
    std::vector<glm::dvec3> reference_;
};

/// The settings as the material's quality; nothing if the grating does not suit them.
std::optional<diffraction::Quality> as_quality(const nlohmann::json& settings, const diffraction::Material& material) {
    std::variant<diffraction::Quality, diffraction::Refusal> suited =
        diffraction::suited_quality(settings, material.grating);
    auto* quality = std::get_if<diffraction::Quality>(&suited);
    if (quality == nullptr) return std::nullopt;
    quality->illuminant = material.quality.illuminant;
    return *quality;
}

/// Of settings that have been baked, by their text.
using Tables = std::map<std::string, std::shared_ptr<const diffraction::BakedTables>>;

Candidate baked(const PriceQuery& query, nlohmann::json settings, diffraction::Quality quality, Tables& known) {
    nlohmann::json for_any_keys = settings;
    for_any_keys.erase("key_lights");
    auto& tables = known[for_any_keys.dump()];
    if (!tables) {
        diffraction::Material pinned = query.material;
        pinned.quality = quality;
        tables = std::make_shared<const diffraction::BakedTables>(
            diffraction::bake_tables(pinned.grating, representation(pinned)));
    }
    const double price =
        diffraction::shading_price(diffraction::shading_cost(*tables), quality.key_lights ? query.key_lights : 0);
    return {std::move(settings), std::move(quality), tables, price, false};
}

void mark_front(std::vector<PricedChoice>& choices) {
    for (PricedChoice& choice : choices)
        choice.on_front = std::none_of(choices.begin(), choices.end(), [&](const PricedChoice& other) {
            return other.price <= choice.price && other.error <= choice.error &&
                   (other.price < choice.price || other.error < choice.error);
        });
}

}  // namespace

void price_choices(const PriceQuery& query, const std::function<void(const PriceList&)>& report,
                   const std::stop_token& stop) {
    std::vector<std::pair<nlohmann::json, diffraction::Quality>> suited;
    const auto all = query.present_only ? std::vector<nlohmann::json>()
                                        : diffraction::budget_candidates(query.material.grating, query.surface);
    for (const nlohmann::json& settings : all)
        if (auto quality = as_quality(settings, query.material)) suited.emplace_back(settings, std::move(*quality));
    const bool pinned = query.material.quality.pinned.has_value();
    PriceList list{.choices = {}, .done = 0, .total = 2 * suited.size() + (pinned ? 1 : 0)};

    const Measurement measurement(query, stop);
    Tables tables;
    const auto measure = [&](const Candidate& candidate) {
        if (stop.stop_requested()) return;
        list.choices.push_back({.settings = candidate.settings,
                                .cost = diffraction::shading_cost(*candidate.tables),
                                .price = candidate.price,
                                .error = measurement.error(candidate),
                                .candidate = !candidate.present,
                                .present = candidate.present});
        ++list.done;
        mark_front(list.choices);
        report(list);
    };
    if (stop.stop_requested()) return;
    if (pinned) {
        Candidate present = baked(query, query.quality, query.material.quality, tables);
        present.present = true;
        measure(present);
    }
    std::vector<Candidate> candidates;
    for (auto& [settings, quality] : suited) {
        if (stop.stop_requested()) return;
        candidates.push_back(baked(query, settings, quality, tables));
        ++list.done;
        report(list);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.price < b.price; });
    for (const Candidate& candidate : candidates) measure(candidate);
}

std::optional<PricedChoice> cheapest_within(const PriceList& list, double max_error) {
    const PricedChoice* best = nullptr;
    for (const PricedChoice& choice : list.choices)
        if (choice.candidate && choice.error <= max_error && (best == nullptr || choice.price < best->price))
            best = &choice;
    return best != nullptr ? std::optional(*best) : std::nullopt;
}

}  // namespace rowland::inspector
