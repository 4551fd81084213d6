#include "engine/math/spherical_harmonics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::math {

namespace {

constexpr auto kBands = static_cast<std::size_t>(kMaximumBands);

/// Factors of the recurrences of the normalised associated Legendre functions divided by sin^m θ,
/// P_m,m = diagonal[m],  P_l,m = a[m][l] z P_l−1,m − b[m][l] P_l−2,m  [Press et al., Numerical Recipes, 3rd ed., §6.7].
/// For m ≠ 0 `diagonal` includes the √2 of the real basis.
struct Recurrence {
    std::array<double, kBands> diagonal{};
    std::array<std::array<double, kBands>, kBands> a{};
    std::array<std::array<double, kBands>, kBands> b{};

    Recurrence();
};

Recurrence::Recurrence() {
    double squared = 1 / (4 * std::numbers::pi);
    diagonal[0] = std::sqrt(squared);
    for (std::size_t m = 1; m < kBands; ++m) {
        const auto k = static_cast<double>(m);
        squared *= (2 * k + 1) / (2 * k);
        diagonal[m] = std::sqrt(2 * squared);
    }
    for (std::size_t m = 0; m < kBands; ++m)
        for (std::size_t l = m + 1; l < kBands; ++l) {
            const auto x = static_cast<double>(l);
            const auto k = static_cast<double>(m);
            a[m][l] = std::sqrt((4 * x * x - 1) / (x * x - k * k));
            b[m][l] = std::sqrt((2 * x + 1) * ((x - 1) * (x - 1) - k * k) / ((2 * x - 3) * (x * x - k * k)));
        }
}

}  // namespace

void evaluate_sh(const glm::dvec3& direction, int bands, std::span<double> values) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    ROWLAND_CHECK_OP(bands, <=, kMaximumBands);
    ROWLAND_CHECK_OP(values.size(), >=, static_cast<std::size_t>(sh_count(bands)));
    static const Recurrence factors;
    const double z = direction.z;
    // sin^m θ cos mφ and sin^m θ sin mφ as polynomials in x and y: no angle, no pole.
    double cosine = 1;
    double sine = 0;
    for (int m = 0; m < bands; ++m) {
        const auto k = static_cast<std::size_t>(m);
        double before = 0;
        double legendre = factors.diagonal[k];
        for (int l = m; l < bands; ++l) {
            if (l > m) {
                const auto i = static_cast<std::size_t>(l);
                const double next = factors.a[k][i] * z * legendre - factors.b[k][i] * before;
                before = legendre;
                legendre = next;
            }
            values[static_cast<std::size_t>(sh_index(l, m))] = legendre * cosine;
            if (m > 0) values[static_cast<std::size_t>(sh_index(l, -m))] = legendre * sine;
        }
        const double next_cosine = direction.x * cosine - direction.y * sine;
        sine = direction.x * sine + direction.y * cosine;
        cosine = next_cosine;
    }
}

const char* window_name(SphericalWindow window) {
    constexpr std::array kNames = {"none", "lanczos", "hann"};
    return kNames.at(static_cast<std::size_t>(window));
}

SphericalWindow parse_window(std::string_view name) {
    for (const auto window : {SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann})
        if (name == window_name(window)) return window;
    ROWLAND_CHECK(false, "parse_window() of a name that is none");
    return SphericalWindow::None;
}

double window_factor(SphericalWindow window, int l, int bands) {
    ROWLAND_CHECK_OP(l, >=, 0);
    ROWLAND_CHECK_OP(l, <, bands);
    const double x = std::numbers::pi * l / bands;
    switch (window) {
        case SphericalWindow::None:
            return 1;
        case SphericalWindow::Lanczos:
            return l == 0 ? 1 : std::sin(x) / x;
        case SphericalWindow::Hann:
            return (1 + std::cos(x)) / 2;
    }
    ROWLAND_CHECK(false, "unknown window");
    return 0;
}

double exponential_window_factor(double damping, int l) {
    ROWLAND_CHECK_OP(damping, >=, 0.0);
    ROWLAND_CHECK_OP(l, >=, 0);
    return std::exp(-damping * l * (l + 1));
}

double clamped_cosine_factor(int l) {
    ROWLAND_CHECK_OP(l, >=, 0);
    if (l == 1) return 2 * std::numbers::pi / 3;
    if (l % 2 == 1) return 0;
    // 2π (−1)^(l/2−1) / ((l+2)(l−1)) · l! / (2^l (l/2)!²); the last factor is Π (2k−1)/(2k), k = 1 … l/2.
    double factor = 2 * std::numbers::pi / (static_cast<double>(l + 2) * static_cast<double>(l - 1));
    for (int k = 1; k <= l / 2; ++k) factor *= static_cast<double>(2 * k - 1) / static_cast<double>(2 * k);
    return (l / 2) % 2 == 0 ? -factor : factor;
}

namespace {

/// First entry of band l in the block vector: Σ_{k<l} (2k+1)².
constexpr std::size_t block_offset(int l) {
    const auto k = static_cast<std::size_t>(l);
    return l == 0 ? 0 : k * (2 * k - 1) * (2 * k + 1) / 3;
}

/// The axis (0, 1, 2: x, y, z) along which function m of band 1 lies: y, z, x for m = −1, 0, 1.
constexpr int axis_of(int m) {
    return m == 0 ? 2 : m == 1 ? 0 : 1;
}

/// One addend of a row: weight · P(first, row), where P combines row `first` of band 1 with row `row` of band l − 1.
struct Term {
    double weight = 0;
    int first = 0;
    int row = 0;
};

/// Row m of band l is the sum of at most five terms, each entry n then divided by √d(n).
struct RowRule {
    std::array<Term, 5> terms{};
    int count = 0;

    void add(double weight, int first, int row) {
        if (weight != 0) terms[static_cast<std::size_t>(count++)] = {weight, first, row};
    }
};

/// U, V and W of Ivanic & Ruedenberg (J. Phys. Chem. 1996, 100, 6342; additions and corrections 1998, 102, 9099),
/// tables 1 and 2, with the numerators of u, v, w folded in.
RowRule make_row(int l, int m) {
    RowRule rule;
    const int k = std::abs(m);
    const double u = std::sqrt(static_cast<double>((l + m) * (l - m)));
    const double v = 0.5 * std::sqrt((m == 0 ? 2.0 : 1.0) * (l + k - 1) * (l + k)) * (m == 0 ? -1 : 1);
    const double w = m == 0 ? 0.0 : -0.5 * std::sqrt(static_cast<double>((l - k - 1) * (l - k)));
    rule.add(u, 0, m);
    if (m == 0) {
        rule.add(v, 1, 1);
        rule.add(v, -1, -1);
    } else if (m > 0) {
        rule.add(m == 1 ? v * std::sqrt(2.0) : v, 1, m - 1);
        rule.add(m == 1 ? 0.0 : -v, -1, 1 - m);
        rule.add(w, 1, m + 1);
        rule.add(w, -1, -m - 1);
    } else {
        rule.add(m == -1 ? 0.0 : v, 1, m + 1);
        rule.add(m == -1 ? v * std::sqrt(2.0) : v, -1, -m - 1);
        rule.add(w, 1, m - 1);
        rule.add(-w, -1, 1 - m);
    }
    return rule;
}

struct Rules {
    std::array<RowRule, static_cast<std::size_t>(sh_count(kMaximumBands))> rows{};
    /// 1/√d of (l, n), with d = (l+n)(l−n), or 2l(2l−1) at |n| = l.
    std::array<double, static_cast<std::size_t>(sh_count(kMaximumBands))> inverse_root{};

    Rules() {
        for (int l = 2; l < kMaximumBands; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto i = static_cast<std::size_t>(sh_index(l, m));
                rows[i] = make_row(l, m);
                const int d = std::abs(m) < l ? (l + m) * (l - m) : 2 * l * (2 * l - 1);
                inverse_root[i] = 1 / std::sqrt(static_cast<double>(d));
            }
    }
};

const Rules& rules() {
    static const Rules all;
    return all;
}

/// Fills band l (≥ 2) from band l − 1 and band 1, both stored row-major.
void fill_band(int l, const double* first_band, const double* previous, double* band) {
    const Rules& table = rules();
    const std::ptrdiff_t width = 2 * l + 1;
    const std::ptrdiff_t previous_width = width - 2;
    const double* inverse_root = table.inverse_root.data() + sh_index(l, -l);
    for (int m = -l; m <= l; ++m) {
        double* row = band + (m + l) * width;
        for (std::ptrdiff_t n = 0; n < width; ++n) row[n] = 0;
        const RowRule& rule = table.rows[static_cast<std::size_t>(sh_index(l, m))];
        for (int t = 0; t < rule.count; ++t) {
            const Term& term = rule.terms[static_cast<std::size_t>(t)];
            const double* r = first_band + std::ptrdiff_t{3} * (term.first + 1);
            const double* source = previous + (term.row + l - 1) * previous_width;
            const double low = source[0];
            const double high = source[previous_width - 1];
            const double centre = term.weight * r[1];
            row[0] += term.weight * (r[2] * low + r[0] * high);
            for (std::ptrdiff_t n = 0; n < previous_width; ++n) row[n + 1] += centre * source[n];
            row[width - 1] += term.weight * (r[2] * high - r[0] * low);
        }
        for (std::ptrdiff_t n = 0; n < width; ++n) row[n] *= inverse_root[n];
    }
}

template <typename T>
void apply_blocks(const std::vector<double>& blocks, int bands, std::span<const T> in, std::span<T> out) {
    const auto count = static_cast<std::size_t>(sh_count(bands));
    ROWLAND_CHECK_OP(in.size(), >=, count);
    ROWLAND_CHECK_OP(out.size(), >=, count);
    const double* entry = blocks.data();
    for (int l = 0; l < bands; ++l) {
        const int width = 2 * l + 1;
        const T* source = in.data() + l * l;
        T* target = out.data() + l * l;
        for (int i = 0; i < width; ++i) {
            T sum(0);
            for (int j = 0; j < width; ++j) sum += *entry++ * source[j];
            target[i] = sum;
        }
    }
}

}  // namespace

ShRotation::ShRotation(const glm::dmat3& rotation, int bands) : bands_(bands) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    ROWLAND_CHECK_OP(bands, <=, kMaximumBands);
    ROWLAND_CHECK(std::abs(glm::determinant(rotation) - 1) < 1e-6, "an SH rotation needs a proper rotation matrix");
    blocks_.resize(block_offset(bands));
    blocks_[0] = 1;
    if (bands == 1) return;
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)  // glm indexes [column][row]
            blocks_[1 + static_cast<std::size_t>((i + 1) * 3 + j + 1)] = rotation[axis_of(j)][axis_of(i)];
    for (int l = 2; l < bands; ++l)
        fill_band(l, blocks_.data() + 1, blocks_.data() + block_offset(l - 1), blocks_.data() + block_offset(l));
}

double ShRotation::entry(int l, int i, int j) const {
    ROWLAND_CHECK_OP(l, <, bands_);
    ROWLAND_CHECK_OP(std::abs(i), <=, l);
    ROWLAND_CHECK_OP(std::abs(j), <=, l);
    return blocks_[block_offset(l) + static_cast<std::size_t>((i + l) * (2 * l + 1) + j + l)];
}

void ShRotation::apply(std::span<const double> in, std::span<double> out) const {
    apply_blocks(blocks_, bands_, in, out);
}

void ShRotation::apply(std::span<const glm::dvec3> in, std::span<glm::dvec3> out) const {
    apply_blocks(blocks_, bands_, in, out);
}

}  // namespace rowland::math
