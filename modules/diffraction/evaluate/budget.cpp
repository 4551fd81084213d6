#include "modules/diffraction/evaluate/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"

namespace rowland::diffraction {

namespace {

BudgetRecord record_of(const MeasuredChoice& choice, const Material& material, std::span<const BudgetProbe> probes,
                       std::span<const MeasuredViews> views) {
    BudgetRecord record{.max_error = material.quality.max_error,
                        .measure = material.quality.measure,
                        .surface = material.quality.surface,
                        .frames = static_cast<int>(views.front().points()),
                        .price = choice.price,
                        .probes = {}};
    for (std::size_t i = 0; i < probes.size(); ++i)
        record.probes.push_back(
            {.probe = probes[i].name,
             .key_lights = std::min(choice.quality.key_lights, probes[i].key_lights),
             .error = choice.checks.empty() ? choice.errors[i] : std::max(choice.errors[i], choice.checks[i])});
    return record;
}

/// Rounded up to three digits, so that the number in a message can be met as max_error.
double rounded_up(double error) {
    if (!std::isfinite(error) || error <= 0.0) return error;
    const double digit = std::pow(10.0, std::floor(std::log10(error)) - 2.0);
    return std::ceil(error / digit) * digit;
}

/// 0, 4, 8, 16 and so on, and `most`.
std::vector<int> key_light_counts(int most) {
    std::vector<int> counts{0};
    for (int count = 4; count < most; count *= 2) counts.push_back(count);
    if (most > 0) counts.push_back(most);
    return counts;
}

/// The choices on the Pareto front that are cheaper than `top`, as rungs. A rung costs at most kWorthwhile times the
/// next more expensive one, except the cheapest.
std::vector<CookedRung> rungs_below(const MeasuredChoice& top, std::span<const MeasuredChoice> measured,
                                    const Material& material, std::span<const BudgetProbe> probes,
                                    std::span<const MeasuredViews> views) {
    constexpr double kWorthwhile = 5.0 / 6.0;
    std::vector<const MeasuredChoice*> front;
    for (const MeasuredChoice& choice : measured)
        if (choice.price < top.price && choice.errors.size() == probes.size() && std::isfinite(choice.error()) &&
            on_front(choice, measured))
            front.push_back(&choice);
    std::ranges::sort(front, std::greater<>(), &MeasuredChoice::price);
    std::vector<CookedRung> rungs;
    double next_price = top.price;
    for (const MeasuredChoice* choice : front) {
        const bool cheapest = choice == front.back() && choice->price < next_price;
        if (choice->price > kWorthwhile * next_price && !cheapest) continue;
        if (rungs.size() + 2 == kMostRungs && !cheapest) continue;
        next_price = choice->price;
        rungs.push_back({.settings = choice->settings,
                         .quality = choice->quality,
                         .baked = choice->baked == top.baked ? nullptr : choice->baked,
                         .measured = record_of(*choice, material, probes, views)});
    }
    std::ranges::reverse(rungs);
    return rungs;
}

/// The settings that `allows` accepts; all of them if it is empty.
std::vector<nlohmann::json> allowed(std::vector<nlohmann::json> settings, const Grating& grating,
                                    const std::function<bool(const Quality&)>& allows) {
    if (!allows) return settings;
    std::erase_if(settings, [&](const nlohmann::json& candidate) {
        const auto suited = suited_quality(candidate, grating);
        const auto* quality = std::get_if<Quality>(&suited);
        return quality == nullptr || !allows(*quality);
    });
    return settings;
}

int most_key_lights(std::span<const BudgetProbe> probes) {
    return std::ranges::max(probes, {}, &BudgetProbe::key_lights).key_lights;
}

}  // namespace

std::vector<nlohmann::json> budget_candidates(const Grating& grating, SurfaceShape surface, int key_light_limit) {
    std::vector<nlohmann::json> list;
    for (const RepresentationInfo* info : representations())
        for (const std::string& settings : info->budget(grating, surface)) {
            nlohmann::json quality =
                parse_method(settings.empty() ? info->name : fmt::format("{}/{}", info->name, settings)).quality;
            if (info->key_lights == KeyLightUse::Always) {
                list.push_back(std::move(quality));
                continue;
            }
            for (const int keys : key_light_counts(key_light_limit)) {
                quality["key_lights"] = keys;
                list.push_back(quality);
            }
        }
    return list;
}

BudgetChoice choose_representation(const Material& material, std::span<const BudgetProbe> probes,
                                   std::span<const MeasuredViews> views, const std::string& file,
                                   const ChoiceRules& rules) {
    ROWLAND_CHECK(!probes.empty() && views.size() == probes.size(), "an error needs light and views to be measured on");
    const double max_error = material.quality.max_error;
    std::vector<nlohmann::json> settings =
        budget_candidates(material.grating, material.quality.surface, most_key_lights(probes));
    settings.push_back({{"representation", "direct"}, {"key_lights", 0}});  // only for the cheapest rung
    std::unique_ptr<Progress> progress;
    const SearchState found = search({.material = material,
                                      .probes = probes,
                                      .views = views,
                                      .error = error_function(material.quality.measure, material.quality.surface),
                                      .settings = allowed(std::move(settings), material.grating, rules.allows),
                                      .good_enough = max_error,
                                      .cheaper = true},
                                     [&](const SearchState& state) {
                                         if (!progress)
                                             progress =
                                                 std::make_unique<Progress>("choosing a representation", state.total);
                                         progress->advance();
                                     });
    const MeasuredChoice& best = *std::ranges::min_element(found.measured, {}, &MeasuredChoice::error);
    const std::string pointer = rules.pointer + "/quality/max_error";
    if (best.error() > max_error && rules.must_meet_budget)
        refuse_input(file, pointer, fmt::format("{}", max_error),
                     fmt::format("at least {:.3g}, the best that can be reached here: {}", rounded_up(best.error()),
                                 best.settings.dump()),
                     "allow more, or pin a representation");
    if (best.error() > max_error)
        log_warning("{}: {}: no representation has an error of at most {}; the best one has {:.3g}: {}", file, pointer,
                    max_error, rounded_up(best.error()), best.settings.dump());
    BudgetChoice choice{best.settings, *best.baked};
    choice.cooked.material.quality = best.quality;
    choice.cooked.measured = record_of(best, material, probes, views);
    choice.cooked.cheaper = rungs_below(best, found.measured, material, probes, views);
    if (const double checked = choice.cooked.measured->largest_error();
        best.error() <= max_error && checked > max_error)
        log_warning("{}: {}: {:.3g} at views that did not decide, {} asked for: {}", file, pointer, checked, max_error,
                    best.settings.dump());
    return choice;
}

std::optional<PinnedRecord> measure_pinned(const Material& material, const nlohmann::json& settings,
                                           std::span<const BudgetProbe> probes, std::span<const MeasuredViews> views,
                                           const std::function<bool(const Quality&)>& allows) {
    std::vector<nlohmann::json> cheaper;
    const int keys_of_pinned = std::min(most_key_lights(probes), material.quality.key_lights);
    for (nlohmann::json quality :
         {settings, parse_method("arc/bands=5/rank=8").quality, parse_method("direct").quality}) {
        if (quality["representation"] == "streak") continue;  // its map holds the key lights
        for (const int keys : key_light_counts(keys_of_pinned)) {
            quality["key_lights"] = keys;
            cheaper.push_back(quality);
        }
    }
    const SearchState found = search({.material = material,
                                      .probes = probes,
                                      .views = views,
                                      .error = error_function(material.quality.measure, material.quality.surface),
                                      .settings = allowed(std::move(cheaper), material.grating, allows),
                                      .first = settings,
                                      .cheaper = true},
                                     [](const SearchState&) {});
    const MeasuredChoice& pinned = found.measured.front();
    BudgetRecord record = record_of(pinned, material, probes, views);
    record.max_error = 0.0;
    if (!std::isfinite(record.largest_error())) return std::nullopt;
    return PinnedRecord{record, rungs_below(pinned, found.measured, material, probes, views)};
}

}  // namespace rowland::diffraction
