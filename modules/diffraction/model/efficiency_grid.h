#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/colour/spectrum.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

/// Efficiencies of all orders over wavelength and one direction, the metal included: η_m(λ; s_g), which by reciprocity
/// is η_m(λ; v_g) for v_g = mλ/d − s_g (PHYSICS §14). It is tabulated where both directions are above the horizon;
/// entries beyond hold the nearest value along v_g. 107 kB for ten orders.
struct EfficiencyGrid {
    double pitch_nm = 0.0;
    std::vector<int> orders;    ///< ascending; all others are 0
    std::vector<float> values;  ///< [(order · kWavelengths + wavelength) · kViews + view]

    static constexpr int kStep_nm = 10;
    static constexpr int kWavelengths = (colour::kVisibleMax - colour::kVisibleMin) / kStep_nm + 1;
    /// Nodes are in the middle of equal cells of v_g ∈ [−1, 1], so that none is at grazing incidence.
    static constexpr int kViews = 65;
    static constexpr double view_at(int node) { return (2.0 * node + 1.0) / kViews - 1.0; }
    static constexpr double wavelength_at(int row) { return colour::kVisibleMin + double{kStep_nm} * row; }

    /// The nodes around v_g.
    struct ViewCell {
        std::size_t first = 0;
        double weight = 0.0;  ///< of the one after `first`
    };
    static ViewCell view_cell(double v_g);

    /// η_m(λ; v_g), bilinear; constant beyond the nodes. 0 for an order that is not in `orders`.
    double at(int order, double wavelength_nm, double v_g) const;

    struct Sample {
        double v_g = 0.0;
        double efficiency = 0.0;
    };
    /// Sets the views of one order and wavelength by linear interpolation of samples with both directions above the
    /// horizon, in ascending v_g. Without samples they stay as they are.
    void set(std::size_t order_index, int row, std::span<const Sample> samples);
};

/// A grid of `orders`, ascending, all 0.
EfficiencyGrid empty_grid(double pitch_nm, std::vector<int> orders);

/// A table of several angles of incidence on a grid.
EfficiencyGrid efficiency_grid(const EfficiencyTable& table, double pitch_nm);

}  // namespace rowland::diffraction
