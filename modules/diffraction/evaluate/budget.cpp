#include "modules/diffraction/evaluate/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace rowland::diffraction {

namespace {

BudgetRecord record_of(const MeasuredChoice& choice, const Material& material, std::span<const BudgetProbe> probes,
                       std::size_t frames) {
    BudgetRecord record{.max_error = material.quality.max_error,
                        .surface = material.quality.surface,
                        .frames = static_cast<int>(frames),
                        .price = choice.price,
                        .probes = {}};
    for (std::size_t i = 0; i < probes.size(); ++i)
        record.probes.push_back({.probe = probes[i].name,
                                 .key_lights = choice.quality.key_lights ? probes[i].key_lights : 0,
                                 .error = choice.errors[i]});
    return record;
}

/// To three digits, so that a budget of the number that the message shows succeeds.
double rounded_up(double error) {
    if (!std::isfinite(error) || error <= 0.0) return error;
    const double digit = std::pow(10.0, std::floor(std::log10(error)) - 2.0);
    return std::ceil(error / digit) * digit;
}

/// Adds the settings without and with key lights.
void add(std::vector<nlohmann::json>& list, nlohmann::json settings) {
    for (const bool keys : {false, true}) {
        settings["key_lights"] = keys;
        list.push_back(settings);
    }
}

/// Streaks suit narrow lobes, harmonics wide ones. Few of the latter: each takes seconds to bake over all views.
std::vector<nlohmann::json> lobe_candidates() {
    std::vector<nlohmann::json> list;
    for (const int nodes : {4, 8, 16})
        for (const int taps : {1, 3, 5})
            list.push_back({{"representation", "streak"}, {"nodes", nodes}, {"taps", taps}});
    add(list, {{"representation", "arc"}, {"bands", 5}, {"rank", 8}});
    add(list, {{"representation", "arc"}, {"bands", 8}, {"rank", 16}});
    add(list, {{"representation", "transfer"}, {"bands", 5}});
    add(list, {{"representation", "spikes"}, {"bands", 5}, {"spikes", 4}});
    list.push_back({{"representation", "direct"}});
    return list;
}

}  // namespace

/// Bins are left out: a transfer table costs as much as eight of them and loses less. Circle maps of more than 64
/// texels take hundreds of megabytes, and flat surfaces have planar maps instead.
std::vector<nlohmann::json> budget_candidates(const Grating& grating, SurfaceShape surface) {
    if (!is_flat(grating.lobe)) return lobe_candidates();
    std::vector<nlohmann::json> list;
    for (const int bands : {3, 5, 8, 12, 16})
        for (const int rank : {4, 8, 12, 16})
            if (rank <= 2 * bands + 2) add(list, {{"representation", "arc"}, {"bands", bands}, {"rank", rank}});
    for (const int bands : {3, 5, 8}) add(list, {{"representation", "transfer"}, {"bands", bands}});
    for (const int spikes : {4, 8, 16}) add(list, {{"representation", "spikes"}, {"bands", 5}, {"spikes", spikes}});
    list.push_back({{"representation", "direct"}});
    const bool flat = surface == SurfaceShape::Flat;
    for (const int resolution : flat ? std::vector{32, 64, 128, 256, 512} : std::vector{16, 24, 32, 48, 64})
        add(list, {{"representation", flat ? "planar" : "circle"}, {"map_resolution", resolution}});
    return list;
}

BudgetChoice choose_representation(const Material& material, std::span<const BudgetProbe> probes,
                                   std::span<const Frame> frames, const std::string& file) {
    ROWLAND_CHECK(!probes.empty() && !frames.empty(), "an error needs light and views to be measured on");
    const double max_error = material.quality.max_error;
    std::unique_ptr<Progress> progress;
    const SearchState found = search({.material = material,
                                      .probes = probes,
                                      .frames = frames,
                                      .settings = budget_candidates(material.grating, material.quality.surface),
                                      .good_enough = max_error},
                                     [&](const SearchState& state) {
                                         if (!progress)
                                             progress =
                                                 std::make_unique<Progress>("choosing a representation", state.total);
                                         progress->advance();
                                     });
    const MeasuredChoice& best = *std::ranges::min_element(found.measured, {}, &MeasuredChoice::error);
    if (best.error() > max_error)
        refuse_input(file, "/quality/max_error", fmt::format("{}", max_error),
                     fmt::format("at least {:.3g}, the best that can be reached here: {}", rounded_up(best.error()),
                                 best.settings.dump()),
                     "allow more, or pin a representation");
    BudgetChoice choice{best.settings, *best.baked};
    choice.cooked.material.quality = best.quality;
    choice.cooked.measured = record_of(best, material, probes, frames.size());
    return choice;
}

}  // namespace rowland::diffraction
