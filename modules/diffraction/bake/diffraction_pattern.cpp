#include "modules/diffraction/bake/diffraction_pattern.h"

#include <Eigen/Core>
#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <span>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/lattice_terms.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

namespace {

/// Efficiencies that differ by less than this fraction count as equal.
constexpr double kSameEfficiency = 1e-6;
/// Efficiencies are compared at this step, in nanometres.
constexpr int kCompared_nm = 5;

/// Whether an order is as bright for light from `direction` as the opposite one for light from −direction.
bool as_bright(const Grating& grating, int order, double direction) {
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kCompared_nm) {
        const double first = order_efficiency(grating, order, nm, direction);
        if (std::abs(first - order_efficiency(grating, -order, nm, -direction)) > kSameEfficiency * std::abs(first))
            return false;
    }
    return true;
}

bool is_even_lattice(const Grating& grating) {
    constexpr double kDark = 1e-12;
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += kCompared_nm) {
        const std::vector<double> orders = lattice_order_efficiencies(grating, nm);
        for (std::size_t i = 0; i < orders.size() / 2; ++i)
            if (std::abs(orders[i] - orders[orders.size() - 1 - i]) > kSameEfficiency * orders[i] + kDark) return false;
    }
    return true;
}

void add_order(const Grating& grating, const colour::LightSpectra& spectra, int order, double step,
               std::vector<DiffractionPattern::Node>& nodes, std::vector<glm::dmat3>& observed) {
    constexpr double kFarthest = 2.0;
    const double u_per_nm = order / grating.pitch_nm;
    const int nodes_per_nm = std::max(1, static_cast<int>(std::ceil(std::abs(u_per_nm) / step)));
    const int last = (colour::kVisibleMax - colour::kVisibleMin) * nodes_per_nm;
    for (int i = 0; i <= last; ++i) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(i) / nodes_per_nm;
        const double u = u_per_nm * wavelength_nm;
        if (std::abs(u) > kFarthest) break;
        const double step_nm = (i == 0 || i == last ? 0.5 : 1.0) / nodes_per_nm;
        observed.push_back(step_nm * observed_spectra(spectra, wavelength_nm));
        const double efficiency = order_efficiency(grating, order, wavelength_nm);
        nodes.push_back(
            {glm::vec2(u, 0.0), static_cast<float>(wavelength_nm), glm::mat3(efficiency * observed.back())});
    }
}

struct Eigenpair {
    double value = 0.0;
    Eigen::VectorXd vector;
};

/// Eigenpairs of a symmetric, positive semidefinite matrix, the largest first, by Jacobi's method (Golub & Van Loan,
/// Matrix Computations, 8.5). Eigen's solver would take a twentieth of the module that browsers load.
std::vector<Eigenpair> eigenpairs(Eigen::MatrixXd matrix) {
    constexpr int kMostSweeps = 30;
    constexpr double kRounding = 1e-14;
    Eigen::MatrixXd vectors = Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
    const double negligible = kRounding * matrix.diagonal().sum();
    for (int sweep = 0, rotated = 1; sweep < kMostSweeps && rotated > 0; ++sweep) {
        rotated = 0;
        for (Eigen::Index p = 0; p + 1 < matrix.rows(); ++p)
            for (Eigen::Index q = p + 1; q < matrix.rows(); ++q) {
                if (std::abs(matrix(p, q)) <= negligible) continue;
                Eigen::JacobiRotation<double> rotation;
                rotation.makeJacobi(matrix, p, q);
                matrix.applyOnTheLeft(p, q, rotation.adjoint());
                matrix.applyOnTheRight(p, q, rotation);
                vectors.applyOnTheRight(p, q, rotation);
                ++rotated;
            }
    }
    std::vector<Eigenpair> pairs;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) pairs.push_back({matrix(i, i), vectors.col(i)});
    std::sort(pairs.begin(), pairs.end(), [](const Eigenpair& a, const Eigenpair& b) { return a.value > b.value; });
    return pairs;
}

/// The principal components of η over views: `efficiencies` has a row for each node, weighted by its light.
DiffractionPattern::ViewTerms view_terms(const Eigen::MatrixXd& efficiencies, const std::vector<glm::dmat3>& observed) {
    Eigen::VectorXd light(efficiencies.rows());
    for (Eigen::Index i = 0; i < light.size(); ++i) {
        const glm::dvec3 white = observed[static_cast<std::size_t>(i)] * glm::dvec3(1.0);
        light[i] = white.x + white.y + white.z;
    }
    const Eigen::MatrixXd weighted = light.asDiagonal() * efficiencies;
    const std::vector<Eigenpair> components = eigenpairs(weighted.transpose().lazyProduct(weighted));
    double left = 0.0;
    for (const Eigenpair& component : components) left += component.value;
    const double tolerated = kTermError * kTermError * left;
    DiffractionPattern::ViewTerms terms;
    for (terms.count = 0; terms.count < kMostTerms && left > tolerated; ++terms.count)
        left -= components[terms.count].value;
    const std::span<const Eigenpair> shown(components.data(), terms.count);
    for (Eigen::Index i = 0; i < efficiencies.rows(); ++i)
        for (const Eigenpair& component : shown)
            terms.by_node.push_back(static_cast<float>(efficiencies.row(i).dot(component.vector)));
    for (const Eigenpair& component : shown)
        for (const double value : component.vector) terms.by_view.push_back(static_cast<float>(value));
    for (const glm::dmat3& node : observed) terms.observed.emplace_back(node);
    return terms;
}

DiffractionPattern groove_pattern(const Grating& grating, const colour::LightSpectra& spectra, double step) {
    DiffractionPattern pattern{
        .nodes = {}, .views = {}, .lobe = grating.lobe, .even = is_even(grating), .cover = grating.cover};
    std::vector<glm::dmat3> observed;
    std::vector<int> orders;  // by node
    for (const int order : grating.orders) {
        add_order(grating, spectra, order, step, pattern.nodes, observed);
        orders.resize(pattern.nodes.size(), order);
    }
    if (!depends_on_direction(grating) || orders.empty()) return pattern;
    Eigen::MatrixXd efficiencies(static_cast<Eigen::Index>(orders.size()), Eigen::Index{EfficiencyGrid::kViews});
    for (Eigen::Index i = 0; i < efficiencies.rows(); ++i)
        for (int view = 0; view < EfficiencyGrid::kViews; ++view) {
            const auto node = static_cast<std::size_t>(i);
            efficiencies(i, view) =
                order_efficiency(grating, orders[node], static_cast<double>(pattern.nodes[node].wavelength_nm),
                                 EfficiencyGrid::view_at(view));
        }
    pattern.views = view_terms(efficiencies, observed);
    return pattern;
}

}  // namespace

bool is_even(const Grating& grating) {
    if (grating.lattice) return is_even_lattice(grating);
    return std::ranges::all_of(grating.orders, [&](int order) {
        return lists(grating, -order) && as_bright(grating, order, 0.0) &&
               (!depends_on_direction(grating) || as_bright(grating, order, 0.6));
    });
}

DiffractionPattern diffraction_pattern(const Grating& grating, const colour::LightSpectra& spectra, double step) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    if (grating.lattice)
        return {.nodes = lattice_nodes(grating, spectra, step),
                .views = std::nullopt,
                .lobe = std::nullopt,
                .even = is_even(grating),
                .cover = grating.cover};
    return groove_pattern(grating, spectra, step);
}

double DiffractionPattern::ViewTerms::at(std::size_t term, double v_g) const {
    const EfficiencyGrid::ViewCell cell = EfficiencyGrid::view_cell(v_g);
    const float* const first = by_view.data() + term * EfficiencyGrid::kViews + cell.first;
    return std::lerp(double{first[0]}, double{first[1]}, cell.weight);
}

DiffractionPattern shaded_pattern(const Grating& grating, const colour::LightSpectra& spectra, double step) {
    DiffractionPattern pattern = diffraction_pattern(grating, spectra, step);
    if (grating.transmission)
        for (DiffractionPattern::Node& node : pattern.nodes) node.u.y = -node.u.y;
    return pattern;
}

DiffractionPattern in_space(DiffractionPattern pattern, const glm::dmat3& xyz_to_space) {
    for (DiffractionPattern::Node& node : pattern.nodes)
        node.weight = glm::mat3(xyz_to_space * glm::dmat3(node.weight));
    if (pattern.views)
        for (glm::mat3& observed : pattern.views->observed) observed = glm::mat3(xyz_to_space * glm::dmat3(observed));
    return pattern;
}

namespace {

/// Texels along a side of the coarsest level, the middle half of which the pattern covers.
constexpr int kCoarsestPicture = 8;
/// Largest |u_g| and |u_h| of any pair of directions.
constexpr double kFarthestPair = 2.0;
/// The blur of a level: its variance over the square of a texel.
constexpr double kLevelVariance = 0.64;
/// That variance plus that of the interpolation between texels, averaged over positions.
constexpr double kShownVariance = kLevelVariance + 1.0 / 6.0;
/// Step of the pattern from which a picture's extent is computed.
constexpr double kCoarseStep = 0.01;

/// Divides a point's weight among the four texels around it.
template <typename Level, typename Value>
void add_point(const glm::vec2& u, const Value& weight, double half_width, Level& level) {
    const glm::dvec2 position = (glm::dvec2(u) / half_width + 1.0) * (0.5 * level.size) - 0.5;
    const glm::dvec2 low = glm::floor(position);
    const double texel = 2.0 * half_width / level.size;
    for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 at = low + glm::dvec2(corner & 1, corner >> 1);
        const glm::dvec2 near = 1.0 - glm::abs(position - at);
        const glm::ivec2 cell = glm::clamp(glm::ivec2(at), 0, level.size - 1);
        level.density[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(level.size) +
                      static_cast<std::size_t>(cell.x)] +=
            static_cast<float>(near.x * near.y / (texel * texel)) * weight;
    }
}

/// Weights of a normal distribution, of this deviation in texels, at distances of `first`, `first` + 1 … −`first`.
std::vector<float> normal_weights(double deviation, double first) {
    std::vector<float> weights;
    double sum = 0.0;
    for (double x = first; x <= -first; x += 1.0) sum += std::exp(-0.5 * x * x / (deviation * deviation));
    for (double x = first; x <= -first; x += 1.0)
        weights.push_back(static_cast<float>(std::exp(-0.5 * x * x / (deviation * deviation)) / sum));
    return weights;
}

/// Weighted sums over the neighbours of every `stride`th texel of each row, transposed. Black beyond the border.
template <typename Level>
Level blurred_and_transposed(const Level& level, std::span<const float> weights, int stride, int rows) {
    using Value = typename decltype(level.density)::value_type;
    const int columns = level.size / stride;
    const int before = static_cast<int>(weights.size()) / 2 - (stride == 2 ? 1 : 0);
    Level transposed{.size = level.size, .density = {}};
    transposed.density.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), Value(0.0F));
    parallel_for(static_cast<std::size_t>(rows), [&](std::size_t row) {
        const Value* from = level.density.data() + row * static_cast<std::size_t>(level.size);
        for (int column = 0; column < columns; ++column) {
            Value sum(0.0F);
            for (int i = 0; i < static_cast<int>(weights.size()); ++i) {
                const int at = column * stride + i - before;
                if (at >= 0 && at < level.size) sum += weights[static_cast<std::size_t>(i)] * from[at];
            }
            transposed.density[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) + row] = sum;
        }
    });
    transposed.size = rows;
    return transposed;
}

template <typename Level>
Level blurred(const Level& level, std::span<const float> weights, int stride) {
    const Level half = blurred_and_transposed(level, weights, stride, level.size);
    return blurred_and_transposed(half, weights, stride, level.size / stride);
}

/// Blurs points that were divided among four texels, which gave them a variance of 1/6 of a squared texel. `variance`:
/// of the result, in squared texels.
template <typename Level>
Level smoothed(const Level& points, double variance) {
    const double deviation = std::sqrt(variance - 1.0 / 6.0);
    return blurred(points, normal_weights(deviation, -std::ceil(4.0 * deviation)), 1);
}

/// The next level: its texels' centres lie between those of the finer one. `variance`: of the blur that it adds, in
/// squared texels of the finer one.
template <typename Level>
Level halved(const Level& finer, double variance) {
    // Interpolation between its texels adds 4/6, where that of the finer one added 1/6.
    const double deviation = std::sqrt(variance - 0.5);
    return blurred(finer, normal_weights(deviation, 0.5 - std::ceil(4.0 * deviation)), 2);
}

template <typename Precise, typename Level>
Precise bilinear(const Level& level, const glm::dvec2& uv) {
    const glm::dvec2 position = glm::clamp(uv * double(level.size) - 0.5, 0.0, level.size - 1.0);
    const glm::ivec2 low = glm::min(glm::ivec2(position), level.size - 2);
    const glm::dvec2 t = position - glm::dvec2(low);
    const auto of = [&](int row, int column) {
        return Precise(level.density[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.size) +
                                     static_cast<std::size_t>(column)]);
    };
    return (1.0 - t.y) * ((1.0 - t.x) * of(low.y, low.x) + t.x * of(low.y, low.x + 1)) +
           t.y * ((1.0 - t.x) * of(low.y + 1, low.x) + t.x * of(low.y + 1, low.x + 1));
}

/// A picture of `weight_of(node)` at each node, of this variance at least.
template <typename Value, typename WeightOf>
MippedPattern<Value> mipped(const DiffractionPattern& pattern, double half_width, double variance, int size,
                            const WeightOf& weight_of) {
    MippedPattern<Value> picture{.half_width = half_width, .variance = variance, .growth = 0.0, .levels = {}};
    auto& finest = picture.levels.emplace_back();
    finest.size = size;
    finest.density.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), Value(0.0F));
    picture.variance = std::max(variance, picture.texel_variance());
    picture.growth = std::max(picture.variance / 3.0, picture.texel_variance());
    for (const DiffractionPattern::Node& node : pattern.nodes) add_point(node.u, weight_of(node), half_width, finest);
    const double in_texels = kShownVariance * picture.variance / picture.texel_variance();
    finest = smoothed(finest, in_texels - 1.0 / 6.0);
    const double added = 3.0 * kShownVariance * picture.growth / picture.texel_variance();
    while (picture.levels.back().size > kCoarsestPicture)
        picture.levels.push_back(halved(picture.levels.back(), added));
    return picture;
}

}  // namespace

template <typename Value>
double MippedPattern<Value>::texel_variance() const {
    const double texel = 2.0 * half_width / levels[0].size;
    return kShownVariance * texel * texel;
}

template <typename Value>
typename MippedPattern<Value>::Precise MippedPattern<Value>::at(const glm::dvec2& u, double level) const {
    if (std::max(std::abs(u.x), std::abs(u.y)) > half_width) return Precise(0.0);
    const double held = std::clamp(level, 0.0, static_cast<double>(levels.size() - 1));
    const auto finer = std::min(static_cast<std::size_t>(held), levels.size() - 2);
    const double t = held - static_cast<double>(finer);
    const glm::dvec2 uv = 0.5 * (u / half_width + 1.0);
    return (1.0 - t) * bilinear<Precise>(levels[finer], uv) + t * bilinear<Precise>(levels[finer + 1], uv);
}

template struct MippedPattern<glm::mat3>;
template struct MippedPattern<glm::vec3>;

double level_of(const PatternPicture& picture, double variance) {
    return 0.5 * std::log2(std::max(variance, 1e-30) / picture.texel_variance());
}

double level_of(const LightPicture& picture, double variance) {
    const double wider = 1.0 + std::max(variance - picture.variance, 0.0) / picture.growth;
    const double finer = std::floor(0.5 * std::log2(wider));
    return finer + (wider * std::exp2(-2.0 * finer) - 1.0) / 3.0;
}

double picture_half_width(const Grating& grating, const colour::LightSpectra& spectra) {
    float farthest = 1e-6F;
    for (const DiffractionPattern::Node& node : shaded_pattern(grating, spectra, kCoarseStep).nodes)
        farthest = std::max({farthest, std::abs(node.u.x), std::abs(node.u.y)});
    return std::min(2.05 * static_cast<double>(farthest), kFarthestPair);
}

PatternPicture pattern_picture(const Grating& grating, const colour::LightSpectra& spectra, int size) {
    ROWLAND_CHECK_OP(size, >=, 2 * kCoarsestPicture);
    const double half_width = picture_half_width(grating, spectra);
    return mipped<glm::mat3>(shaded_pattern(grating, spectra, 2.0 * half_width / size), half_width, 0.0, size,
                             [](const DiffractionPattern::Node& node) { return node.weight; });
}

LightPicture light_picture(const DiffractionPattern& pattern, double half_width, const glm::vec3& flux, double variance,
                           int size) {
    ROWLAND_CHECK_OP(size, >=, 2 * kCoarsestPicture);
    return mipped<glm::vec3>(pattern, half_width, variance, size,
                             [&](const DiffractionPattern::Node& node) { return node.weight * flux; });
}

}  // namespace rowland::diffraction
