#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The colour kernel k of a grating under an illuminant, PHYSICS (1), flat lobe: the colour of the light that leaves
/// the grating at the path difference x = d u between neighbouring grooves. 3 × 3 matrices, linear RGB in, XYZ out.
///
/// k(x) = Σ_m (1/|m|) η_m(λ) cmf(λ) E(λ)ᵀ at λ = x/m, over the listed orders m ≠ 0 with λ in 380–780 nm; per nm. Each
/// order's product is sampled at 1 nm and linear between, so integrals of k have a closed form and equal the trapezoid
/// sums of the rest of the module. Below kManyGrooves grooves k includes the orders' Fejér width and order 0:
/// k(x) = ∫ path_density(x, λ) cmf Eᵀ dλ.
///
/// XYZ(v) = d ∫ k(d (a + v_g)) A(a) da + zero_order_xyz() · A(−v_g), A the light's arc profile. 58 kB per order.
/// Where efficiencies depend on the direction it is k(x; v_g), of one view (PHYSICS §14).
class ColourKernel {
 public:
    /// The grating must be solved: is_solved().
    ColourKernel(const Grating& grating, const colour::LightSpectra& spectra, double v_g = 0.0);

    /// k(x), x of either sign; 0 outside [begin_nm(), end_nm()].
    glm::dmat3 operator()(double x_nm) const;

    /// 𝒦(x) = ∫₀ˣ k dx'.
    glm::dmat3 antiderivative(double x_nm) const;

    /// Mean of k between `begin_nm` and `end_nm`, in either order, or k there if they are equal: for a light, a pixel
    /// or a cell of that extent in x.
    glm::dmat3 average(double begin_nm, double end_nm) const;

    /// ∫ η_0 cmf Eᵀ dλ if order 0 is listed: the weight of δ(x). 0 below kManyGrooves grooves: k includes order 0.
    const glm::dmat3& zero_order_xyz() const { return zero_order_; }

    /// The interval outside which k is 0. Empty, both 0, if no order but 0 is listed.
    double begin_nm() const { return begin_nm_; }
    double end_nm() const { return end_nm_; }

    /// Efficiency × observer × light of one order: linear between equidistant nodes, 0 outside.
    class Curve {
     public:
        Curve(double start, double step, std::vector<glm::dmat3> values);
        glm::dmat3 value(double at) const;
        /// Integral from the first node to `at`.
        glm::dmat3 integral_to(double at) const;
        double end() const { return start_ + step_ * static_cast<double>(values_.size() - 1); }

     private:
        double start_;
        double step_;
        std::vector<glm::dmat3> values_;
        std::vector<glm::dmat3> integral_;
    };

 private:
    struct OrderCurve {
        int order;
        Curve curve;  ///< over x/order
    };
    void add_sharp_orders(const Grating& grating, std::span<const glm::dmat3> observed, double v_g);
    void add_wide_orders(const Grating& grating, const colour::LightSpectra& spectra);

    std::vector<OrderCurve> orders_;
    glm::dmat3 zero_order_{0.0};
    double begin_nm_ = 0.0;
    double end_nm_ = 0.0;
};

/// 𝒦 at equidistant x over the interval where k is not 0, to be interpolated linearly; where k depends on the view, at
/// the views of EfficiencyGrid, between which it is also interpolated.
struct KernelTable {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    int views = 1;                          ///< 1, or EfficiencyGrid::kViews
    std::vector<glm::mat3> antiderivative;  ///< view by view; of each, first at begin_nm, last at end_nm
    double error = 0.0;                     ///< interpolation_error() of a cooked kernel of one view

    std::size_t entries() const { return antiderivative.size() / static_cast<std::size_t>(views); }
    /// 𝒦(x; v_g), clamped to the table's ends.
    glm::dmat3 at(double x_nm, double v_g = 0.0) const;
    /// Mean of k over a non-empty interval.
    glm::dmat3 average(double begin_nm_wanted, double end_nm_wanted, double v_g = 0.0) const;

 private:
    glm::dmat3 of_view(std::size_t view, std::size_t entry, double t) const;
};

/// The table of one view's kernel, entries ≥ 2.
KernelTable tabulate(const ColourKernel& kernel, std::size_t entries = 2048);
/// Largest error of an interpolated component of 𝒦 at v_g = 0, relative to the largest component of 𝒦(end) − 𝒦(begin);
/// measured at seven points between neighbouring entries.
double interpolation_error(const KernelTable& table, const ColourKernel& kernel);
/// The kernel of all views of a grating. Uses all cores.
KernelTable kernel_table(const Grating& grating, const colour::LightSpectra& spectra);

/// Whether k(−x; −v_g) = k(x; v_g), to the table's rounding: a rotation of the grooves by π then changes nothing.
bool is_even(const KernelTable& kernel);

/// The kernel that gives colours of another space instead of XYZ.
KernelTable in_space(KernelTable kernel, const glm::dmat3& xyz_to_space);

}  // namespace rowland::diffraction
