#include "modules/diffraction/representations/streak/streak.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <type_traits>

#include "engine/colour/observer.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/bake/wavelength_cuts.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::diffraction {

namespace {

/// The taps cover so many σ on either side. The 4 % of the power beyond goes to the outer taps.
constexpr double kTapReach = 2.05;

/// One order at every nanometre.
struct OrderSpectrum {
    int order = 0;
    std::vector<glm::dmat3> observed;  ///< η_m cmf Eᵀ
    std::vector<double> weight;        ///< sum of the entries of `observed`, about
};

OrderSpectrum spectrum_of(const Grating& grating, int order, const colour::LightSpectra& spectra) {
    OrderSpectrum result{.order = order, .observed = {}, .weight = {}};
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
        const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
        const glm::dvec3 light = spectra(wavelength_nm);
        const double efficiency = order_efficiency(grating, order, wavelength_nm);
        result.observed.push_back(efficiency * glm::outerProduct(cmf, light));
        result.weight.push_back(efficiency * (cmf.x + cmf.y + cmf.z) * (light.x + light.y + light.z));
    }
    return result;
}

StreakNode make_node(const OrderSpectrum& spectrum, std::size_t begin, std::size_t end) {
    glm::dmat3 sum(0.0);
    double total = 0.0;
    double moment = 0.0;
    double square = 0.0;
    each_node(begin, end, [&](std::size_t j, double step) {
        const double at = static_cast<double>(j - begin);
        const double weight = step * spectrum.weight[j];
        sum += step * spectrum.observed[j];
        total += weight;
        moment += weight * at;
        square += weight * at * at;
    });
    const double middle = 0.5 * static_cast<double>(end - begin);
    const double mean = total > 0.0 ? moment / total : middle;
    const double variance = total > 0.0 ? std::max(square / total - mean * mean, 0.0) : 0.0;
    const double wavelength_nm = colour::kVisibleMin + static_cast<double>(begin) + mean;
    return {.path_nm = static_cast<float>(spectrum.order * wavelength_nm),
            .width_nm = static_cast<float>(std::abs(spectrum.order) * std::sqrt(12.0 * variance)),
            .wavelength_nm = static_cast<float>(wavelength_nm),
            .weight = glm::mat3(sum)};
}

struct NarrowLobe {
    double sigma = 0.0;
    double power = 1.0;
};

NarrowLobe narrow_lobe(const GrooveLobe& lobe) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) return {gaussian->sigma, 1.0};
    if (const auto* pits = std::get_if<PitsLobe>(&lobe))
        if (pits->coherent > 0.0) return {kCoherentSigma, pits->coherent};
    throw Error({.file = {},
                 .location = "groove_lobe",
                 .found = is_flat(lobe) ? "flat" : "pits without a coherent part",
                 .expected = "a narrow lobe: sigma, or pits with a coherent part, for the representation \"streak\"",
                 .remedy = "use \"arc\", \"transfer\" or \"spikes\""});
}

/// An interval of a direction cosine after clipping.
struct Piece {
    double middle = 0.0;
    double length = 0.0;
    double fraction = 0.0;  ///< of the length before clipping
};

Piece cut(double middle, double length, double limit) {
    const double begin = std::max(middle - 0.5 * length, -limit);
    const double end = std::min(middle + 0.5 * length, limit);
    if (length <= 0.0) return {middle, 0.0, std::abs(middle) < limit ? 1.0 : 0.0};
    return {0.5 * (begin + end), end - begin, std::max(end - begin, 0.0) / length};
}

double normal_below(double sigmas) {
    return 0.5 * std::erfc(-sigmas / std::numbers::sqrt2);
}

}  // namespace

std::vector<LobeTap> lobe_taps(int count) {
    ROWLAND_CHECK_OP(count, >=, 1);
    std::vector<LobeTap> taps;
    const double width = 2.0 * kTapReach / count;
    for (int i = 0; i < count; ++i) {
        const double begin = -kTapReach + width * i;
        const double below = i == 0 ? 0.0 : normal_below(begin);
        const double above = i + 1 == count ? 1.0 : normal_below(begin + width);
        taps.push_back({.offset = begin + 0.5 * width, .width = width, .weight = above - below});
    }
    return taps;
}

Streak make_streak(const Grating& grating, const StreakSettings& settings) {
    ROWLAND_CHECK_OP(settings.nodes_per_order, >=, 1);
    require_many_grooves(grating);
    const NarrowLobe lobe = narrow_lobe(grating.lobe);
    Streak streak{.pitch_nm = grating.pitch_nm, .sigma = lobe.sigma, .power = lobe.power, .nodes = {}};
    const colour::LightSpectra spectra(settings.illuminant);
    for (const int order : grating.orders) {
        const OrderSpectrum spectrum = spectrum_of(grating, order, spectra);
        if (std::all_of(spectrum.weight.begin(), spectrum.weight.end(), [](double w) { return w == 0.0; })) continue;
        const auto cuts = equal_weight_cuts(spectrum.weight, order == 0 ? 1 : settings.nodes_per_order);
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
            streak.nodes.push_back(make_node(spectrum, cuts[k], cuts[k + 1]));
    }
    return streak;
}

std::optional<Grating> incoherent_rest(const Grating& grating) {
    const auto* pits = std::get_if<PitsLobe>(&grating.lobe);
    if (pits == nullptr || pits->coherent >= 1.0) return std::nullopt;
    Grating rest = grating;
    rest.lobe = PitsLobe{.length_nm = pits->length_nm, .coherent = 0.0};
    return rest;
}

glm::dvec3 evaluate(const Streak& streak, const FilteredRadiance& radiance, const glm::dvec3& view, int taps,
                    const std::optional<Cover>& cover) {
    glm::dvec3 xyz(0.0);
    if (!(view.z > 0.0)) return xyz;
    const std::vector<LobeTap> lobe = lobe_taps(taps);
    for (const StreakNode& node : streak.nodes) {
        const Piece across = cut(static_cast<double>(node.path_nm) / streak.pitch_nm - view.x,
                                 static_cast<double>(node.width_nm) / streak.pitch_nm, 1.0);
        if (across.fraction == 0.0) continue;
        const double r = std::sqrt(std::max((1.0 - across.middle) * (1.0 + across.middle), 0.0));
        glm::dvec3 sum(0.0);
        for (const LobeTap& tap : lobe) {
            const Piece along = cut(streak.sigma * tap.offset - view.y, streak.sigma * tap.width, r);
            if (along.fraction == 0.0) continue;
            const double height = std::sqrt(std::max(r * r - along.middle * along.middle, 0.0));
            const double slope = 1.0 / std::max(height, kLowestStreakHeight);
            sum += tap.weight * along.fraction * transmittance(cover, height) *
                   radiance({across.middle, along.middle, height},
                            across.length * glm::dvec3(1.0, 0.0, -across.middle * slope),
                            along.length * glm::dvec3(0.0, 1.0, -along.middle * slope));
        }
        xyz += across.fraction * (glm::dmat3(node.weight) * sum);
    }
    return streak.power / std::erf(1.0 / (streak.sigma * std::numbers::sqrt2)) * xyz;
}

int most_seen_nodes(const Streak& streak) {
    std::size_t most = 0;
    // A node is visible where x/d − 1 ≤ v_g ≤ x/d + 1. The count has its maximum where a node becomes visible.
    for (const StreakNode& first : streak.nodes) {
        const double from = static_cast<double>(first.path_nm) / streak.pitch_nm;
        most = std::max(most, static_cast<std::size_t>(
                                  std::count_if(streak.nodes.begin(), streak.nodes.end(), [&](const StreakNode& node) {
                                      const double x = static_cast<double>(node.path_nm) / streak.pitch_nm;
                                      return x >= from && x <= from + 2.0;
                                  })));
    }
    return static_cast<int>(most);
}

namespace {

/// A node in a file.
struct StoredNode {
    float path_nm, width_nm, wavelength_nm;
    float weight[9];
};
static_assert(sizeof(StoredNode) == 48 && std::is_trivially_copyable_v<StoredNode>);

}  // namespace

void write(const Streak& streak, ByteWriter& writer) {
    writer.value(streak.pitch_nm);
    writer.value(streak.sigma);
    writer.value(streak.power);
    std::vector<StoredNode> nodes;
    for (const StreakNode& node : streak.nodes) {
        StoredNode stored{node.path_nm, node.width_nm, node.wavelength_nm, {}};
        for (int i = 0; i < 9; ++i) stored.weight[i] = node.weight[i / 3][i % 3];
        nodes.push_back(stored);
    }
    writer.array(std::span<const StoredNode>(nodes));
}

Streak read_streak(ByteReader& reader) {
    Streak streak;
    streak.pitch_nm = reader.value<double>();
    streak.sigma = reader.value<double>();
    streak.power = reader.value<double>();
    const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
    if (!positive(streak.pitch_nm) || !positive(streak.sigma) || !(streak.power >= 0.0 && streak.power <= 1.0))
        reader.fail(fmt::format("pitch {}, sigma {}, power {}", streak.pitch_nm, streak.sigma, streak.power),
                    "a pitch and a sigma above 0, a power of 0 to 1");
    const auto nodes = reader.array<StoredNode>();
    if (nodes.size() > kMostStreakNodes)
        reader.fail(fmt::format("{} nodes", nodes.size()), fmt::format("at most {}", kMostStreakNodes));
    for (const StoredNode& stored : nodes) {
        StreakNode node{stored.path_nm, stored.width_nm, stored.wavelength_nm, {}};
        bool finite = std::isfinite(node.path_nm) && std::isfinite(node.wavelength_nm) &&
                      std::isfinite(node.width_nm) && node.width_nm >= 0.0F;
        for (int i = 0; i < 9; ++i) {
            node.weight[i / 3][i % 3] = stored.weight[i];
            finite = finite && std::isfinite(stored.weight[i]);
        }
        if (!finite) reader.fail("a node with a number that is not finite or a width below 0", "finite numbers");
        streak.nodes.push_back(node);
    }
    return streak;
}

}  // namespace rowland::diffraction
