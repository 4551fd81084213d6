#include "editor/inspector/measurement.h"

#include <algorithm>
#include <utility>

#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/evaluate/error_measure.h"

namespace rowland::inspector {

namespace {

constexpr int kSweepBands = 5;
constexpr int kSweepViews = 61;

PriceList list_of(const diffraction::SearchState& state, diffraction::ErrorMeasure measure, bool with_pinned) {
    PriceList list{.choices = {}, .done = state.done, .total = state.total, .measure = measure};
    const auto candidates = std::span(state.measured).subspan(with_pinned && !state.measured.empty() ? 1 : 0);
    for (const diffraction::MeasuredChoice& choice : state.measured) {
        const bool present = with_pinned && list.choices.empty();
        list.choices.push_back({.settings = choice.settings,
                                .cost = diffraction::shading_cost(choice.baked->tables),
                                .price = choice.price,
                                .error = choice.error(),
                                .candidate = !present,
                                .present = present,
                                .on_front = !present && diffraction::on_front(choice, candidates)});
    }
    return list;
}

/// The members of a quality that pin a representation; the others hold for every choice.
Json choice_of_quality(Json quality) {
    for (const char* other : {"max_error", "measure", "surface", "illuminant", "probes"}) quality.erase(other);
    return quality;
}

}  // namespace

void price_choices(const PriceQuery& query, const std::function<void(const PriceList&)>& report,
                   const std::stop_token& stop) {
    const diffraction::Material material = with_efficiencies(query.material, "the material");
    const bool pinned = material.quality.pinned.has_value();
    const std::vector<diffraction::BudgetProbe> probes = {
        {.name = "the inspector's light", .image = query.probe, .key_lights = query.key_lights}};
    const diffraction::ErrorMeasure measure = material.quality.measure;
    const std::vector<diffraction::MeasuredViews> views = {diffraction::drawn_views(material, query.probe)};
    diffraction::SearchQuery search{.material = material,
                                    .probes = probes,
                                    .views = views,
                                    .error = diffraction::error_function(measure, material.quality.surface),
                                    .settings = {}};
    if (!query.pinned_only)
        search.settings = diffraction::budget_candidates(material.grating, material.quality.surface, query.key_lights);
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

bool Measurement::update() {
    if (std::exchange(last_replacements_, document_.replacements()) != document_.replacements()) {
        all_prices_.reset();
        pinned_price_.reset();
    }
    bool news = false;
    const auto take = [&](auto& computed) {
        const auto change = poll(computed, messages_);
        news = news || change.value || !change.failure.empty();
    };
    want_pattern();
    take(pattern_);
    want_point_numbers();
    take(point_);
    want_prices();
    take(all_prices_);
    take(pinned_price_);
    apply_budget();
    return news;
}

void Measurement::want_pattern() {
    const auto& source = document().accepted();
    pattern_.want(
        document().has_grating() && document().material().grating.lattice ? std::optional(source) : std::nullopt,
        [source](auto&&...) {
            return std::make_shared<const PatternFigure>(pattern_figure(source->grating()->material));
        });
}

void Measurement::want_point_numbers() {
    std::optional<PointInputs> inputs;
    if (document_.is_cooked() && document_.cooked() && light_.current() && view_.preview().drawn())
        inputs = {document_.cooked(), light_.current(), view_.point()};
    if (point_.wants(inputs)) return;  // the search for a point below is expensive
    if (!inputs) return point_.want(inputs, nullptr);
    point_.want(inputs,
                [cooked = inputs->cooked, light = inputs->light, point = view_.point_or_middle()](
                    const std::stop_token& stop, auto&&) -> std::optional<PointNumbers> {
                    PointNumbers numbers;
                    numbers.radiance = point_radiance(*cooked, light->image, light->divided, point.frame, point.layout);
                    if (!stop.stop_requested())
                        numbers.sweep = view_sweep(*cooked, light->image, light->divided, point.frame, point.layout,
                                                   kSweepBands, kSweepViews, stop);
                    if (stop.stop_requested()) return std::nullopt;
                    return numbers;
                });
}

Measurement::PriceInputs Measurement::price_inputs(bool of_all) const {
    PriceInputs inputs{document().has_grating() ? document().accepted()->json : Json(), light_.current(),
                       view_.surface_shape()};
    for (const char* of_mesh : {"grooveRotation", "grooveTexture"})
        if (inputs.material.contains(of_mesh)) inputs.material.erase(of_mesh);
    if (of_all && inputs.material.contains("quality")) {
        Json& quality = inputs.material["quality"];
        const Json choice = choice_of_quality(quality);
        for (const auto& [key, value] : choice.items()) quality.erase(key);
        quality.erase("max_error");
    }
    return inputs;
}

Measurement::Prices::Work Measurement::price_work(bool pinned_only) const {
    return [source = document().accepted(), light = light_.current(), surface = view_.surface_shape(), pinned_only](
               const std::stop_token& stop, const auto& publish) -> std::optional<PriceList> {
        PriceList last;
        const auto report = [&](const PriceList& list) { publish(last = list); };
        report(last);
        const bool has_quality = source->json.contains("quality");
        diffraction::Material material = source->grating()->material;
        material.quality.surface = surface;
        price_choices({.material = std::move(material),
                       .quality = has_quality ? nlohmann::json(source->json["quality"]) : nlohmann::json(),
                       .probe = light->image,
                       .key_lights = light->key_lights,
                       .pinned_only = pinned_only},
                      report, stop);
        return stop.stop_requested() ? std::nullopt : std::optional(last);
    };
}

void Measurement::want_prices() {
    if (!light_.current() || !document().has_grating()) return;
    const bool is_current = requested_ == price_inputs(true);
    all_prices_.want(is_current ? requested_ : std::nullopt, price_work(false));

    const bool measured =
        prices_are_current() && std::ranges::count(prices().choices, true, &PricedChoice::present) > 0;
    const bool idle = point_.current() && !point_.busy() && !all_prices_.busy();
    const bool pinned = document().material().quality.pinned.has_value();
    PriceInputs inputs = price_inputs(false);
    const bool wanted = pinned && !measured && idle && stopped_ != inputs;
    pinned_price_.want(wanted ? std::optional(std::move(inputs)) : std::nullopt, price_work(true));
}

void Measurement::stop_pricing() {
    budget_.reset();
    requested_.reset();
    stopped_ = price_inputs(false);
}

PriceList Measurement::prices() const {
    if (!document().has_grating()) return {};
    const bool all_current = all_prices_.is_of(price_inputs(true));
    const bool pinned_current = pinned_price_.is_of(price_inputs(false));
    if (!all_current && (pinned_current || all_prices_.value() == nullptr))
        return pinned_price_.value() != nullptr ? *pinned_price_.value() : PriceList();
    PriceList list = *all_prices_.value();
    if (!all_current) return list;
    const nlohmann::json present = choice_of_quality(value_of(field_at("/quality"), document().accepted()->json));
    bool found = false;
    for (PricedChoice& choice : list.choices)
        found |= choice.present = nlohmann::json(choice_of_quality(choice.settings)) == present;
    if (!found && pinned_current && !pinned_price_.value()->choices.empty())
        list.choices.insert(list.choices.begin(), pinned_price_.value()->choices.front());
    return list;
}

void Measurement::choose(const PricedChoice& choice) {
    Json quality = choice.settings;
    const Json before = value_of(field_at("/quality"), document().json());
    if (before.contains("illuminant")) quality["illuminant"] = before["illuminant"];
    document_.document().replace_quality(quality);
}

void Measurement::cook_to_budget(double max_error) {
    budget_ = max_error;
    if (!all_measured()) measure_all();
}

bool Measurement::all_measured() const {
    return all_prices_.is_of(price_inputs(true)) && all_prices_.value()->total > 0 &&
           all_prices_.value()->done == all_prices_.value()->total;
}

void Measurement::apply_budget() {
    if (!budget_ || !light_.current()) return;
    if (all_measured()) {
        const double max_error = *std::exchange(budget_, std::nullopt);
        if (const auto cheapest = cheapest_within(prices(), max_error))
            choose(*cheapest);
        else
            messages_.say("no choice is within that error: allow more", true);
    } else if (requested_ != price_inputs(true)) {
        budget_.reset();
        messages_.say("an edit ended the measurement: cook to budget again");
    } else if (!all_prices_.busy()) {
        budget_.reset();  // the measurement failed and has been reported
    }
}

}  // namespace rowland::inspector
