#include "editor/inspector/physics/price.h"

#include <algorithm>

#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/evaluate/error_measure.h"

namespace rowland::inspector {

namespace {

void mark_front(std::vector<PricedChoice>& choices) {
    for (PricedChoice& choice : choices)
        choice.on_front = std::ranges::none_of(choices, [&](const PricedChoice& other) {
            return other.price <= choice.price && other.error <= choice.error &&
                   (other.price < choice.price || other.error < choice.error);
        });
}

PriceList list_of(const diffraction::SearchState& state, diffraction::ErrorMeasure measure, bool with_present) {
    PriceList list{.choices = {}, .done = state.done, .total = state.total, .measure = measure};
    for (const diffraction::MeasuredChoice& choice : state.measured) {
        const bool present = with_present && list.choices.empty();
        list.choices.push_back({.settings = choice.settings,
                                .cost = diffraction::shading_cost(choice.baked->tables),
                                .price = choice.price,
                                .error = choice.error(),
                                .candidate = !present,
                                .present = present});
    }
    mark_front(list.choices);
    return list;
}

}  // namespace

void price_choices(const PriceQuery& query, const std::function<void(const PriceList&)>& report,
                   const std::stop_token& stop) {
    const bool pinned = query.material.quality.pinned.has_value();
    const std::vector<diffraction::BudgetProbe> probes = {
        {.name = "the inspector's light", .image = query.probe, .key_lights = query.key_lights}};
    const diffraction::ErrorMeasure measure = query.material.quality.measure;
    const std::vector<diffraction::ShadingPoint> frames = diffraction::measured_points(measure, query.surface);
    diffraction::SearchQuery search{.material = query.material,
                                    .probes = probes,
                                    .frames = frames,
                                    .error = diffraction::error_function(measure, query.surface),
                                    .settings = {}};
    if (!query.present_only)
        search.settings = diffraction::budget_candidates(query.material.grating, query.surface, query.key_lights);
    if (pinned) search.first = query.quality;
    diffraction::search(
        search, [&](const diffraction::SearchState& state) { report(list_of(state, measure, pinned)); }, stop);
}

std::optional<PricedChoice> cheapest_within(const PriceList& list, double max_error) {
    const PricedChoice* best = nullptr;
    for (const PricedChoice& choice : list.choices)
        if (choice.candidate && choice.error <= max_error && (best == nullptr || choice.price < best->price))
            best = &choice;
    return best != nullptr ? std::optional(*best) : std::nullopt;
}

}  // namespace rowland::inspector
