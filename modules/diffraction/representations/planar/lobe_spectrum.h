#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "modules/diffraction/bake/diffraction_pattern.h"

namespace rowland::diffraction {

/// The grid of a lobe map over views, both ends ±1 included. The light has the same grid.
struct LobeMapViews {
    int g = 128;  ///< ≥ 8
    int h = 128;  ///< ≥ 8

    double step_g() const { return 2.0 / (g - 1); }
    double step_h() const { return 2.0 / (h - 1); }
};

/// The Fourier transform of a diffraction pattern over a grid of u, as correlation with light on LobeMapViews needs it:
/// periods of at least 4, the extent of u.
class LobeSpectrum {
 public:
    LobeSpectrum(const DiffractionPattern& pattern, const LobeMapViews& views);

    const LobeMapViews& views() const { return views_; }
    /// The size of the LightDisc that holds the light.
    int disc_cells() const { return 2 * std::max(views_.g, views_.h); }
    /// Whether P(−u) = P(u).
    bool even() const { return even_; }
    /// The pattern's cover, whose T(s_n) dims the light.
    const std::optional<Cover>& cover() const { return cover_; }
    std::size_t size_g() const { return size_g_; }
    std::size_t size_h() const { return size_h_; }

    /// Terms of the pattern: 1 if it does not depend on the view.
    std::size_t terms() const { return terms_ ? terms_->count : 1; }
    /// The factor of a term at a node of the views along g.
    float factor_at(std::size_t term, int view_g) const;

    /// Three columns of a complex 3 × 3 matrix: the real parts, four floats a column, then the imaginary ones.
    static constexpr std::size_t kFloats = 24;
    /// A term's matrices of all frequencies along g at one frequency along h.
    std::span<const float> at(std::size_t frequency_h, std::size_t term = 0) const;

 private:
    /// Grooves: the transforms of orders along g times those of lobes along h.
    void fill_lobe(const DiffractionPattern& pattern);
    /// A pattern without a lobe.
    void fill_points(const DiffractionPattern& pattern);
    /// The scale of all matrices: of the inverse transform, the grid's steps and LightDisc's ½.
    double factor() const;
    /// Rows of matrices of a term.
    std::size_t rows() const { return points_ ? size_h_ : size_h_ / 2 + 1; }

    LobeMapViews views_;
    bool even_;
    std::optional<Cover> cover_;
    std::optional<DiffractionPattern::ViewTerms> terms_;
    bool points_;  ///< a pattern without a lobe
    std::size_t size_g_;
    std::size_t size_h_;
    std::vector<float> matrices_;  ///< rows of size_g: size_h/2 + 1 of a lobe, which is even, size_h of points; by term
};

}  // namespace rowland::diffraction
