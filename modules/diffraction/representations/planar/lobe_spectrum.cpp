#include "modules/diffraction/representations/planar/lobe_spectrum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/math/fourier_transform.h"

namespace rowland::diffraction {

namespace {

using math::FourierTransform;
constexpr std::size_t kLanes = FourierTransform::kLanes;

/// Pits' lobes are tabulated at this many wavelengths, and linear between.
constexpr std::size_t kPitWavelengths = 16;
/// Those of pit sequences, whose orders move with the wavelength, at up to this many.
constexpr std::size_t kMostSequenceWavelengths = 256;
/// Sample points of a lobe in each step of the grid.
constexpr int kLobePoints = 16;

/// From one wavelength to the next an order of a pit sequence at the farthest s_h + v_h, 2, moves by σ or a step of the
/// grid, whichever is more.
std::size_t wavelength_count(const GrooveLobe& lobe, double step) {
    if (!depends_on_wavelength(lobe)) return 1;
    if (!std::holds_alternative<PitSequenceLobe>(lobe)) return kPitWavelengths;
    const double spacing_nm = 0.5 * colour::kVisibleMin * std::max(lobe_extent(lobe).feature_size, step);
    const auto count = static_cast<std::size_t>(std::ceil((colour::kVisibleMax - colour::kVisibleMin) / spacing_nm));
    return std::clamp(count + 1, kPitWavelengths, kMostSequenceWavelengths);
}

std::vector<double> wavelengths_of(const GrooveLobe& lobe, double step) {
    const std::size_t count = wavelength_count(lobe, step);
    if (count == 1) return {0.5 * (colour::kVisibleMin + colour::kVisibleMax)};
    std::vector<double> wavelengths_nm;
    for (std::size_t i = 0; i < count; ++i)
        wavelengths_nm.push_back(colour::kVisibleMin + (colour::kVisibleMax - colour::kVisibleMin) *
                                                           static_cast<double>(i) / static_cast<double>(count - 1));
    return wavelengths_nm;
}

/// The Fourier transform of D_h at one wavelength, each sample divided between two nodes of the grid. Real, as D_h is
/// even.
std::vector<double> transformed_lobe(const GrooveLobe& lobe, double wavelength_nm, double step, std::size_t size) {
    const LobeDensity density(lobe, wavelength_nm);
    std::vector<double> nodes(size, 0.0);
    const double point = step / kLobePoints;
    const int last = static_cast<int>(2.0 / point);
    for (int i = -last; i <= last; ++i) {
        const double position = static_cast<double>(i) / kLobePoints;
        const double low = std::floor(position);
        const double weight = position - low;
        const auto node = [&](int offset) -> double& {
            const auto wrapped = static_cast<std::ptrdiff_t>(low) + offset + static_cast<std::ptrdiff_t>(size);
            return nodes[static_cast<std::size_t>(wrapped) % size];
        };
        node(0) += (1.0 - weight) * point * density(i * point);
        node(1) += weight * point * density(i * point);
    }
    std::vector<double> transform(size / 2 + 1);
    for (std::size_t f = 0; f < transform.size(); ++f)
        for (std::size_t p = 0; p < size; ++p)
            transform[f] += nodes[p] * std::cos(2.0 * std::numbers::pi * static_cast<double>(f * p % size) /
                                                static_cast<double>(size));
    return transform;
}

/// The transform along g of the pattern's nodes near one of the lobe's wavelengths: for each frequency X, Y, Z of three
/// columns.
struct TransformedOrders {
    std::array<std::vector<float>, 3> real;  ///< by column, kLanes floats a frequency
    std::array<std::vector<float>, 3> imaginary;
};

/// The fraction of a wavelength that belongs to entry `r` of an ascending, equidistant list.
double hat(const std::vector<double>& wavelengths_nm, std::size_t r, double wavelength_nm) {
    if (wavelengths_nm.size() == 1) return 1.0;
    const double spacing = wavelengths_nm[1] - wavelengths_nm[0];
    return std::max(0.0, 1.0 - std::abs(wavelength_nm - wavelengths_nm[r]) / spacing);
}

/// `term`: of the pattern's views.
TransformedOrders transformed_orders(const DiffractionPattern& pattern, std::size_t term,
                                     const std::vector<double>& wavelengths_nm, std::size_t r, double step,
                                     std::size_t size) {
    TransformedOrders orders;
    for (std::size_t c = 0; c < 3; ++c) {
        orders.real[c].assign(kLanes * size, 0.0F);
        orders.imaginary[c].assign(kLanes * size, 0.0F);
    }
    for (std::size_t i = 0; i < pattern.nodes.size(); ++i) {
        const DiffractionPattern::Node& node = pattern.nodes[i];
        const double fraction = hat(wavelengths_nm, r, static_cast<double>(node.wavelength_nm));
        if (fraction == 0.0) continue;
        const glm::mat3 of_node =
            pattern.views ? pattern.views->by_node[i * pattern.views->count + term] * pattern.views->observed[i]
                          : node.weight;
        const double position = static_cast<double>(node.u.x) / step;
        const double low = std::floor(position);
        for (int offset = 0; offset < 2; ++offset) {
            const auto wrapped = static_cast<std::ptrdiff_t>(low) + offset + static_cast<std::ptrdiff_t>(size);
            const std::size_t at = kLanes * (static_cast<std::size_t>(wrapped) % size);
            const double weight = fraction * (offset == 1 ? position - low : 1.0 - (position - low));
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t o = 0; o < 3; ++o)
                    orders.real[c][at + o] +=
                        static_cast<float>(weight) * of_node[static_cast<int>(c)][static_cast<int>(o)];
        }
    }
    const FourierTransform transform(size);
    std::vector<float> work_real(kLanes * size);
    std::vector<float> work_imaginary(kLanes * size);
    for (std::size_t c = 0; c < 3; ++c) {
        transform({orders.real[c], orders.imaginary[c]}, {work_real, work_imaginary});
        for (float& value : orders.imaginary[c]) value = -value;  // conjugate, as for TransformedPoints
    }
    return orders;
}

/// The pattern's points, each divided among four nodes of the grid, as the conjugate of their transform.
class TransformedPoints {
 public:
    TransformedPoints(const DiffractionPattern& pattern, const LobeMapViews& views, std::size_t size_g,
                      std::size_t size_h)
        : size_g_(size_g), size_h_(size_h) {
        for (auto* parts : {&real_, &imaginary_})
            for (std::vector<float>& column : *parts) column.assign(kLanes * size_g * size_h, 0.0F);
        for (const DiffractionPattern::Node& node : pattern.nodes) add(node, views);
        for (std::size_t c = 0; c < 3; ++c) {
            transform(c, size_g, [&](std::size_t line, std::size_t i) { return line * size_g_ + i; });
            transform(c, size_h, [&](std::size_t line, std::size_t i) { return i * size_g_ + line; });
            for (float& value : imaginary_[c]) value = -value;
        }
    }

    /// Copies column `c` of a frequency's matrix, times `factor`.
    void copy(std::size_t c, std::size_t g, std::size_t h, float factor, float* real, float* imaginary) const {
        const std::size_t at = kLanes * (h * size_g_ + g);
        for (std::size_t o = 0; o < 3; ++o) {
            real[o] = factor * real_[c][at + o];
            imaginary[o] = factor * imaginary_[c][at + o];
        }
    }

 private:
    void add(const DiffractionPattern::Node& node, const LobeMapViews& views) {
        const glm::dvec2 position(static_cast<double>(node.u.x) / views.step_g(),
                                  static_cast<double>(node.u.y) / views.step_h());
        const glm::dvec2 low = glm::floor(position);
        const auto wrapped = [](double node_of, std::size_t size) {
            return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node_of) + static_cast<std::ptrdiff_t>(size)) %
                   size;
        };
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec2 upper(corner & 1, corner >> 1);
            const glm::dvec2 near = 1.0 - glm::abs(position - low - upper);
            const std::size_t at =
                kLanes * (wrapped(low.y + upper.y, size_h_) * size_g_ + wrapped(low.x + upper.x, size_g_));
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t o = 0; o < 3; ++o)
                    real_[c][at + o] +=
                        static_cast<float>(near.x * near.y) * node.weight[static_cast<int>(c)][static_cast<int>(o)];
        }
    }

    /// Transforms all lines along one axis; `index(line, i)`: the texel of a line's element.
    template <typename Index>
    void transform(std::size_t c, std::size_t size, const Index& index) {
        const FourierTransform along(size);
        parallel_for(size_g_ * size_h_ / size, [&](std::size_t line) {
            std::array<std::vector<float>, 4> parts;
            for (auto& part : parts) part.resize(kLanes * size);
            for (std::size_t i = 0; i < size; ++i) {
                std::copy_n(real_[c].data() + kLanes * index(line, i), kLanes, parts[0].data() + kLanes * i);
                std::copy_n(imaginary_[c].data() + kLanes * index(line, i), kLanes, parts[1].data() + kLanes * i);
            }
            along({parts[0], parts[1]}, {parts[2], parts[3]});
            for (std::size_t i = 0; i < size; ++i) {
                std::copy_n(parts[0].data() + kLanes * i, kLanes, real_[c].data() + kLanes * index(line, i));
                std::copy_n(parts[1].data() + kLanes * i, kLanes, imaginary_[c].data() + kLanes * index(line, i));
            }
        });
    }

    std::size_t size_g_;
    std::size_t size_h_;
    std::array<std::vector<float>, 3> real_;  ///< by column of the matrices, kLanes floats a frequency
    std::array<std::vector<float>, 3> imaginary_;
};

}  // namespace

LobeSpectrum::LobeSpectrum(const DiffractionPattern& pattern, const LobeMapViews& views)
    : views_(views),
      even_(pattern.even),
      cover_(pattern.cover),
      terms_(pattern.views),
      points_(!pattern.lobe),
      size_g_(std::bit_ceil(2 * static_cast<std::size_t>(views.g))),
      size_h_(std::bit_ceil(2 * static_cast<std::size_t>(views.h))) {
    ROWLAND_CHECK_OP(views.g, >=, 8);
    ROWLAND_CHECK_OP(views.h, >=, 8);
    if (points_)
        fill_points(pattern);
    else
        fill_lobe(pattern);
}

float LobeSpectrum::factor_at(std::size_t term, int view_g) const {
    return terms_ ? static_cast<float>(terms_->at(term, 2.0 * view_g / (views_.g - 1) - 1.0)) : 1.0F;
}

double LobeSpectrum::factor() const {
    // A LightDisc holds half the flux.
    return 2.0 / (views_.step_g() * views_.step_h() * static_cast<double>(size_g_ * size_h_));
}

void LobeSpectrum::fill_lobe(const DiffractionPattern& pattern) {
    const std::vector<double> wavelengths_nm = wavelengths_of(*pattern.lobe, views_.step_h());
    std::vector<std::vector<double>> lobes(wavelengths_nm.size());
    std::vector<TransformedOrders> orders(wavelengths_nm.size() * terms());  // by term
    parallel_for(orders.size(), [&](std::size_t i) {
        const std::size_t r = i % wavelengths_nm.size();
        const std::size_t term = i / wavelengths_nm.size();
        if (term == 0) lobes[r] = transformed_lobe(*pattern.lobe, wavelengths_nm[r], views_.step_h(), size_h_);
        orders[i] = transformed_orders(pattern, term, wavelengths_nm, r, views_.step_g(), size_g_);
    });
    matrices_.assign(terms() * rows() * size_g_ * kFloats, 0.0F);
    parallel_for(terms() * rows(), [&](std::size_t row) {
        const std::size_t h = row % rows();
        const TransformedOrders* const of_term = orders.data() + row / rows() * lobes.size();
        for (std::size_t g = 0; g < size_g_; ++g) {
            float* to = matrices_.data() + (row * size_g_ + g) * kFloats;
            for (std::size_t r = 0; r < lobes.size(); ++r) {
                const auto weight = static_cast<float>(factor() * lobes[r][h]);
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t o = 0; o < 3; ++o) {
                        to[kLanes * c + o] += weight * of_term[r].real[c][kLanes * g + o];
                        to[kLanes * (3 + c) + o] += weight * of_term[r].imaginary[c][kLanes * g + o];
                    }
            }
        }
    });
}

void LobeSpectrum::fill_points(const DiffractionPattern& pattern) {
    const TransformedPoints points(pattern, views_, size_g_, size_h_);
    matrices_.assign(size_h_ * size_g_ * kFloats, 0.0F);
    parallel_for(size_h_, [&](std::size_t h) {
        for (std::size_t g = 0; g < size_g_; ++g) {
            float* to = matrices_.data() + (h * size_g_ + g) * kFloats;
            const auto weight = static_cast<float>(factor());
            for (std::size_t c = 0; c < 3; ++c) points.copy(c, g, h, weight, to + kLanes * c, to + kLanes * (3 + c));
        }
    });
}

std::span<const float> LobeSpectrum::at(std::size_t frequency_h, std::size_t term) const {
    const std::size_t row = points_ ? frequency_h : std::min(frequency_h, size_h_ - frequency_h);
    return std::span(matrices_).subspan((term * rows() + row) * size_g_ * kFloats, size_g_ * kFloats);
}

}  // namespace rowland::diffraction
