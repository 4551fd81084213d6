#include "modules/diffraction/evaluate/search.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "engine/colour/illuminant.h"
#include "engine/core/log.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction {

bool is_flat(const Surface& surface) {
    return layout_of(surface) != GrooveLayout::Curved;
}

std::vector<glm::dvec3> shade_surfaces(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const Surface> surfaces) {
    std::vector<glm::dvec3> result;
    for (const Surface& surface : surfaces) {
        const std::vector<glm::dvec3> part = evaluate_baked(cooked, light, surface, layout_of(surface));
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

std::vector<ShadingPoint> MeasuredScene::points() const {
    std::vector<ShadingPoint> all;
    for (const Surface& surface : surfaces) all.insert(all.end(), surface.begin(), surface.end());
    return all;
}

bool MeasuredScene::prepare(const std::stop_token& stop) {
    const std::vector<ShadingPoint> frames = points();
    Progress progress("reference, " + name, frames.size() - reference.size());
    while (reference.size() < frames.size()) {
        if (stop.stop_requested()) return false;
        const std::size_t known = reference.size();
        const auto next = by_reference(std::span(frames).subspan(known, std::min(part, frames.size() - known)));
        reference.insert(reference.end(), next.begin(), next.end());
        progress.advance(next.size());
    }
    return true;
}

namespace {

constexpr double kMultiplyAddsPerFetch = 8.0;
constexpr double kVerticesPerPixel = 25000.0 / (1280.0 * 720.0 / 2.0);
constexpr double kFetchesPerMebibyte = 0.25;
constexpr int kProjectedBands = 16;  ///< the most that a setting takes
constexpr double kAnyError = std::numeric_limits<double>::infinity();
constexpr std::size_t kReferencePart = 8;  ///< points of the reference between two checks of the stop token

/// The settings as the material's quality; nullopt if they do not suit its grating.
std::optional<Quality> as_quality(const nlohmann::json& settings, const Material& material) {
    std::variant<Quality, Refusal> suited = suited_quality(settings, material.grating);
    auto* quality = std::get_if<Quality>(&suited);
    if (quality == nullptr) return std::nullopt;
    quality->max_error = material.quality.max_error;
    quality->illuminant = material.quality.illuminant;
    return std::move(*quality);
}

class Search {
 public:
    Search(const SearchQuery& query, const std::function<void(const SearchState&)>& report, const std::stop_token& stop)
        : query_(query), report_(report), stop_(stop), spectra_(query.material.quality.illuminant) {
        unbaked_ = bake_kernel(query.material);
        for (const BudgetProbe& probe : query.probes) {
            most_key_lights_ = std::max(most_key_lights_, probe.key_lights);
            const MeasuredViews& views = query.views[probes_.size()];
            const std::size_t deciding = std::max<std::size_t>(1, views.parts.size() - 1);
            const auto parts = [&](std::size_t begin, std::size_t end) {
                return std::vector<Surface>(views.parts.begin() + static_cast<std::ptrdiff_t>(begin),
                                            views.parts.begin() + static_cast<std::ptrdiff_t>(end));
            };
            const auto lights = std::make_shared<ProbeLights>(probe.image, kProjectedBands, probe.key_lights);
            const auto scene = [&](std::vector<Surface> surfaces) {
                return MeasuredScene{.name = probe.name,
                                     .lights = lights,
                                     .surfaces = std::move(surfaces),
                                     .part = kReferencePart,
                                     .by_reference = [this, &probe](std::span<const ShadingPoint> part) {
                                         return reference_radiance(query_.material.grating, probe.image, spectra_,
                                                                   part);
                                     }};
            };
            probes_.push_back({.layout = views.layout,
                               .first = scene(parts(0, 1)),
                               .others = scene(parts(1, deciding)),
                               .last = scene(parts(deciding, views.parts.size()))});
        }
    }
    Search(const Search&) = delete;  // the scenes refer to it
    Search& operator=(const Search&) = delete;

    SearchState run() {
        std::vector<MeasuredChoice> choices;
        for (const nlohmann::json& settings : query_.settings)
            if (auto quality = as_quality(settings, query_.material))
                choices.push_back({.settings = settings, .quality = std::move(*quality), .baked = {}});
        const std::size_t steps = query_.good_enough && !query_.cheaper ? 2 : 3;
        state_.total = steps * choices.size() + (query_.first ? 1 : 0);
        if (query_.first) {
            MeasuredChoice first{.settings = *query_.first, .quality = query_.material.quality, .baked = {}};
            bake(first);
            if (measure_up_to(kAnyError, first)) add(std::move(first));
        }
        for (MeasuredChoice& choice : choices) {
            if (stop_.stop_requested()) return std::move(state_);
            bake(choice);
            step();
        }
        if (query_.cheaper && !state_.measured.empty())
            std::erase_if(choices, [first_price = state_.measured.front().price](const MeasuredChoice& choice) {
                return choice.price >= first_price;
            });
        std::ranges::stable_sort(choices, {}, &MeasuredChoice::price);
        for (MeasuredChoice& choice : choices) {
            if (stop_.stop_requested() || found()) break;
            measure(std::move(choice));
        }
        if (!query_.good_enough && !stop_.stop_requested()) measure_front();
        if (query_.good_enough && !stop_.stop_requested()) {
            if (!found()) find_best();
            check(*std::ranges::min_element(state_.measured, {}, &MeasuredChoice::error));
            if (query_.cheaper) measure_front();
        }
        return std::move(state_);
    }

 private:
    void step() {
        ++state_.done;
        report_(state_);
    }

    /// The views under one probe: a few that reject most settings, the others, and those that check.
    struct ProbeViews {
        GrooveLayout layout;
        MeasuredScene first;
        MeasuredScene others;
        MeasuredScene last;
    };

    bool found() const {
        return query_.good_enough && !state_.measured.empty() && state_.measured.back().error() <= *query_.good_enough;
    }

    void bake(MeasuredChoice& choice) {
        nlohmann::json tables = choice.settings;
        tables.erase("key_lights");
        std::shared_ptr<const CookedMaterial>& known = baked_[tables.dump()];
        if (!known) {
            CookedMaterial cooked = unbaked_;
            cooked.material.quality = choice.quality;
            cooked.tables = bake_tables(cooked.material.grating, representation(cooked.material));
            cooked.reflected = bake_reflected_side(cooked.material);
            known = std::make_shared<const CookedMaterial>(std::move(cooked));
        }
        choice.baked = known;
        const auto cost = shading_cost(drawn_tables(known->tables, query_.views.front().layout));
        choice.price = shading_price(cost, std::min(choice.quality.key_lights, most_key_lights_));
    }

    /// The largest error of the scene's parts; nullopt if it was stopped.
    std::optional<double> largest_error(const MeasuredChoice& choice, std::size_t probe, MeasuredScene& scene) {
        if (!scene.prepare(stop_)) return std::nullopt;
        const int key_lights = std::min(choice.quality.key_lights, query_.probes[probe].key_lights);
        const std::vector<glm::dvec3> shown =
            evaluate_baked(*choice.baked, scene.lights->split(key_lights), scene.points(), probes_[probe].layout);
        double largest = 0.0;
        std::size_t begin = 0;
        for (const Surface& part : scene.surfaces) {
            largest = std::max(largest, query_.error(std::span(shown).subspan(begin, part.size()),
                                                     std::span(scene.reference).subspan(begin, part.size())));
            begin += part.size();
        }
        return largest;
    }

    /// Measures the views and probes that follow, until an error is above the limit. False if it was stopped.
    bool measure_up_to(double limit, MeasuredChoice& choice) { return measure_up_to(limit, choice, steps()); }
    bool measure_up_to(double limit, MeasuredChoice& choice, std::size_t steps) {
        for (; choice.steps < steps && choice.error() <= limit; ++choice.steps) {
            const std::size_t probe = choice.steps / 2;
            ProbeViews& views = probes_[probe];
            const bool is_first = choice.steps % 2 == 0;
            if (!is_first && views.others.surfaces.empty()) continue;
            const auto error = largest_error(choice, probe, is_first ? views.first : views.others);
            if (!error) return false;
            if (is_first) choice.errors.push_back(0.0);
            choice.errors.back() = std::max(choice.errors.back(), *error);
        }
        return true;
    }

    void measure(MeasuredChoice choice) {
        const bool goes_on =
            query_.good_enough ? measure_up_to(*query_.good_enough, choice) : measure_up_to(kAnyError, choice, 1);
        if (goes_on) add(std::move(choice));
    }
    void add(MeasuredChoice choice) {
        state_.measured.push_back(std::move(choice));
        step();
    }
    std::size_t steps() const { return 2 * probes_.size(); }

    /// Measures at all views until no choice on the front lacks any. Errors only grow with more views, so a choice
    /// behind a fully measured one stays behind it.
    void measure_front() {
        const std::span<MeasuredChoice> choices = std::span(state_.measured).subspan(query_.first ? 1 : 0);
        const auto is_next = [&](const MeasuredChoice& choice) {
            return choice.steps < steps() && on_front(choice, choices);
        };
        for (auto next = std::ranges::find_if(choices, is_next); next != choices.end();
             next = std::ranges::find_if(choices, is_next)) {
            if (stop_.stop_requested() || !measure_up_to(kAnyError, *next)) return;
            step();
        }
        if (state_.done == state_.total) return;
        state_.done = state_.total;
        report_(state_);
    }

    void check(MeasuredChoice& choice) {
        for (std::size_t i = 0; i < probes_.size() && !probes_[i].last.surfaces.empty(); ++i)
            choice.checks.push_back(largest_error(choice, i, probes_[i].last).value_or(0.0));
    }

    void find_best() {
        double best = std::numeric_limits<double>::infinity();
        for (MeasuredChoice& choice : state_.measured) {
            if (!measure_up_to(best, choice)) return;
            best = std::min(best, choice.error());
        }
    }

    const SearchQuery& query_;
    const std::function<void(const SearchState&)>& report_;
    const std::stop_token& stop_;
    colour::LightSpectra spectra_;
    CookedMaterial unbaked_;  ///< all but the tables
    int most_key_lights_ = 0;
    std::vector<ProbeViews> probes_;
    std::map<std::string, std::shared_ptr<const CookedMaterial>> baked_;  ///< by settings without key_lights
    SearchState state_;
};

}  // namespace

bool on_front(const MeasuredChoice& choice, std::span<const MeasuredChoice> among) {
    return std::ranges::none_of(among, [&](const MeasuredChoice& other) {
        return other.price <= choice.price && other.error() <= choice.error() &&
               (other.price < choice.price || other.error() < choice.error());
    });
}

double shading_price(const ShadingCost& cost, int key_lights) {
    const auto work = [](int fetches, int multiply_adds) { return fetches + multiply_adds / kMultiplyAddsPerFetch; };
    return work(cost.fetches_per_pixel, cost.multiply_adds_per_pixel) +
           kVerticesPerPixel * work(cost.fetches_per_vertex, cost.multiply_adds_per_vertex) +
           key_lights * work(cost.fetches_per_light, cost.multiply_adds_per_light) +
           kFetchesPerMebibyte * static_cast<double>(cost.table_bytes) / (1 << 20);
}

double MeasuredChoice::error() const {
    return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}

SearchState search(const SearchQuery& query, const std::function<void(const SearchState&)>& report,
                   const std::stop_token& stop) {
    return Search(query, report, stop).run();
}

}  // namespace rowland::diffraction
