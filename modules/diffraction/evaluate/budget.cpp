#include "modules/diffraction/evaluate/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "engine/colour/light_spectra.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/method.h"
#include "modules/diffraction/asset/quality_json.h"
#include "modules/diffraction/representations/evaluation_light.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/evaluate/radiance_error.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction {

namespace {

constexpr double kMultiplyAddsPerFetch = 8.0;
constexpr double kVerticesPerPixel = 25000.0 / (1280.0 * 720.0 / 2.0);
constexpr double kFetchesPerMebibyte = 0.25;
constexpr int kMostCandidateBands = 16;

struct Candidate {
    nlohmann::json settings;
    Quality quality;
    std::shared_ptr<const BakedTables> tables;  ///< shared by settings that differ in key lights alone
    double price = 0.0;
};

/// All candidates, baked, the cheapest first.
std::vector<Candidate> bake_candidates(const Material& material, int key_lights) {
    std::vector<Candidate> candidates;
    std::map<std::string, std::shared_ptr<const BakedTables>> baked;
    for (const nlohmann::json& settings : budget_candidates(material.grating, material.quality.surface)) {
        std::variant<Quality, Refusal> suited = suited_quality(settings, material.grating);
        auto* quality = std::get_if<Quality>(&suited);
        if (quality == nullptr) continue;
        quality->max_error = material.quality.max_error;
        quality->illuminant = material.quality.illuminant;
        Material pinned = material;
        pinned.quality = *quality;
        nlohmann::json for_any_keys = settings;
        for_any_keys.erase("key_lights");
        std::shared_ptr<const BakedTables>& tables = baked[for_any_keys.dump()];
        if (!tables)
            tables = std::make_shared<const BakedTables>(bake_tables(material.grating, representation(pinned)));
        const double price = shading_price(shading_cost(*tables), quality->key_lights ? key_lights : 0);
        candidates.push_back({settings, *quality, tables, price});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.price < b.price; });
    return candidates;
}

/// Errors of candidates under probes, each measured once, when it is asked for.
class Measurement {
 public:
    Measurement(const Material& material, std::span<const BudgetProbe> probes, std::span<const Frame> frames)
        : probes_(probes), frames_(frames), spectra_(material.quality.illuminant) {
        cooked_.material = material;
        const ColourKernel kernel(material.grating, spectra_);
        cooked_.kernel = tabulate(kernel);
        cooked_.zero_order_xyz = kernel.zero_order_xyz();
        for (const BudgetProbe& probe : probes) lit_.push_back({&probe, {}, {}, {}, {}});
    }

    /// The largest error over the probes, or the first that is above `limit`.
    double worst(const Candidate& candidate, std::vector<std::optional<double>>& errors, double limit) {
        errors.resize(lit_.size());
        double largest = 0.0;
        for (std::size_t i = 0; i < lit_.size() && largest <= limit; ++i) {
            if (!errors[i]) errors[i] = error(candidate, lit_[i]);
            largest = std::max(largest, *errors[i]);
        }
        return largest;
    }

    /// The material with a candidate's tables.
    CookedMaterial take(const Candidate& candidate) const {
        CookedMaterial cooked = cooked_;
        cooked.material.quality = candidate.quality;
        cooked.tables = *candidate.tables;
        return cooked;
    }

 private:
    /// A probe in the forms that it has been needed in.
    struct Lit {
        const BudgetProbe* probe;
        lighting::ShLight projected;
        std::optional<EvaluationLight> whole;
        std::optional<EvaluationLight> divided;
        std::vector<glm::dvec3> reference;
    };

    double error(const Candidate& candidate, Lit& lit) const {
        if (lit.reference.empty())
            lit.reference = reference_radiance(cooked_.material.grating, lit.probe->image, spectra_, frames_);
        if (lit.projected.bands == 0) lit.projected = lighting::project(lit.probe->image, kMostCandidateBands);
        const bool keys = candidate.quality.key_lights;
        std::optional<EvaluationLight>& light = keys ? lit.divided : lit.whole;
        if (!light)
            light.emplace(lit.probe->image, keys ? lit.probe->key_lights : 0, math::SphericalWindow::None,
                          lit.projected);
        return relative_rms(evaluate_baked(take(candidate), *light, frames_), lit.reference);
    }

    std::span<const BudgetProbe> probes_;
    std::span<const Frame> frames_;
    colour::LightSpectra spectra_;
    CookedMaterial cooked_;  ///< without tables of its own
    std::vector<Lit> lit_;
};

BudgetRecord record_of(const Candidate& candidate, const Material& material, std::span<const BudgetProbe> probes,
                       const std::vector<std::optional<double>>& errors, std::size_t frames) {
    BudgetRecord record{.max_error = material.quality.max_error,
                        .surface = material.quality.surface,
                        .frames = static_cast<int>(frames),
                        .price = candidate.price,
                        .probes = {}};
    for (std::size_t i = 0; i < probes.size(); ++i)
        record.probes.push_back({.probe = probes[i].name,
                                 .key_lights = candidate.quality.key_lights ? probes[i].key_lights : 0,
                                 .error = errors[i].value_or(0.0)});
    return record;
}

/// To three digits, so that asking for what is shown succeeds.
double rounded_up(double error) {
    if (!std::isfinite(error) || error <= 0.0) return error;
    const double digit = std::pow(10.0, std::floor(std::log10(error)) - 2.0);
    return std::ceil(error / digit) * digit;
}

}  // namespace

double shading_price(const ShadingCost& cost, int key_lights) {
    const auto work = [](int fetches, int multiply_adds) { return fetches + multiply_adds / kMultiplyAddsPerFetch; };
    return work(cost.fetches_per_pixel, cost.multiply_adds_per_pixel) +
           kVerticesPerPixel * work(cost.fetches_per_vertex, cost.multiply_adds_per_vertex) +
           key_lights * work(cost.fetches_per_light, cost.multiply_adds_per_light) +
           kFetchesPerMebibyte * static_cast<double>(cost.table_bytes) / (1 << 20);
}

std::vector<nlohmann::json> budget_candidates(const Grating& grating, SurfaceShape surface) {
    std::vector<nlohmann::json> list;
    for (const RepresentationInfo* info : representations())
        for (const std::string& settings : info->budget(is_flat(grating.lobe), surface)) {
            nlohmann::json quality =
                parse_method(settings.empty() ? info->name : fmt::format("{}/{}", info->name, settings)).quality;
            if (info->key_lights == KeyLightUse::Always) {
                list.push_back(std::move(quality));
                continue;
            }
            for (const bool keys : {false, true}) {
                quality["key_lights"] = keys;
                list.push_back(quality);
            }
        }
    return list;
}

BudgetChoice choose_representation(const Material& material, std::span<const BudgetProbe> probes,
                                   std::span<const Frame> frames, const std::string& file) {
    ROWLAND_CHECK(!probes.empty() && !frames.empty(), "an error needs light and views to be measured on");
    int key_lights = 0;
    for (const BudgetProbe& probe : probes) key_lights = std::max(key_lights, probe.key_lights);
    const std::vector<Candidate> candidates = bake_candidates(material, key_lights);
    std::vector<std::vector<std::optional<double>>> errors(candidates.size());
    Measurement measurement(material, probes, frames);
    const double max_error = material.quality.max_error;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (measurement.worst(candidates[i], errors[i], max_error) > max_error) continue;
        BudgetChoice choice{candidates[i].settings, measurement.take(candidates[i])};
        choice.cooked.measured = record_of(candidates[i], material, probes, errors[i], frames.size());
        return choice;
    }
    double best_error = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const double worst = measurement.worst(candidates[i], errors[i], best_error);
        if (worst >= best_error) continue;
        best_error = worst;
        best = i;
    }
    refuse_input(file, "/quality/max_error", fmt::format("{}", max_error),
                 fmt::format("at least {:.3g}, the best that can be reached here: {}", rounded_up(best_error),
                             candidates[best].settings.dump()),
                 "allow more, or pin a representation");
}

}  // namespace rowland::diffraction
