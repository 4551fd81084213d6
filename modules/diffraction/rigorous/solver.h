#pragma once

#include <complex>
#include <string>
#include <vector>

#include "modules/diffraction/rigorous/relief.h"

namespace rowland::diffraction {

/// Efficiencies of one polarisation or the mean of both.
enum class Light { TE, TM, Unpolarised };

/// The efficiencies of one solve: of light from every s_g + kλ/d that propagates, into every order.
///
/// All directions are g components in air: light from s_g = −v_g[i] that leaves as v_g[j] is of order j − i. In an
/// ambient medium of index n directions up to |v_g| < n propagate; those of |v_g| > 1 do not leave it into air.
class OrderEfficiencies {
 public:
    std::vector<double> v_g;              ///< of what is reflected, ascending in steps of λ/d
    std::vector<double> transmitted_v_g;  ///< the same in a transparent substrate: v_g up to its index
    int first = 0;                        ///< order of v_g[0] for light from the s_g that was asked for
    int transmitted_first = 0;

    /// η of `order` for light from s_g − kλ/d, the order counted from that light; 0 where it or the light does not
    /// propagate.
    double reflected(int order, Light light = Light::Unpolarised, int k = 0) const;
    double transmitted(int order, Light light = Light::Unpolarised, int k = 0) const;
    /// Sum over everything that leaves, for light from s_g − kλ/d. 1 minus this is absorbed.
    double sum(Light light, int k = 0) const;

    std::vector<double> reflected_te, reflected_tm;      ///< row i: light from −v_g[i]; column j: into v_g[j]
    std::vector<double> transmitted_te, transmitted_tm;  ///< row i as above; column j: into transmitted_v_g[j]
};

/// η of `order` for light from s_g − kλ/d that a sheet of index `ior` under the relief sends into air on its other
/// side: transmitted(), times Fresnel's transmittance of the flat face there. 0 for what that face reflects totally.
/// Reflections to and fro between the two faces are left out: .2 % for an index of 1.5.
double through_sheet(const OrderEfficiencies& solved, int order, double ior, Light light = Light::Unpolarised,
                     int k = 0);

/// η of the light that leaves `substrate`: reflected() by a metal, or through_sheet().
double leaving(const OrderEfficiencies& solved, int order, const Substrate& substrate, Light light = Light::Unpolarised,
               int k = 0);

/// The largest truncation that solve() takes: 2 s for a lamellar relief.
inline constexpr int kMaximumTruncation = 160;

/// Rigorous efficiencies of classical incidence (s_h = 0): Maxwell's equations with 2 `truncation` + 1 orders, of which
/// those that propagate are given. A lamellar relief is solved by the Fourier modal method with adaptive spatial
/// resolution, others by the coordinate-transformation method. 0 ≤ truncation ≤ kMaximumTruncation. Throws Error
/// (input) as check_relief() does, and unless |s_g| < 1 (in air), 0 < wavelength_nm < 1e5 and substrate_index = n + ik
/// with n > 0, k ≥ 0 and |n + ik| < 100.
OrderEfficiencies solve(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm, double s_g,
                        int truncation);

/// The smallest truncation that is worth trying: it holds all orders that propagate, and as many as the relief's shape
/// needs.
int first_truncation(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm);

/// first_truncation() plus `margin`, at most kMaximumTruncation.
int truncation_with(int margin, const Relief& relief, std::complex<double> substrate_index, double wavelength_nm);

/// Light that a solve includes: from `s_g`, |s_g| < 1, with its `k` for OrderEfficiencies::reflected().
struct CombLight {
    int k = 0;
    double s_g = 0.0;
};

/// All light of a solve for `s_g` that comes from air; `period` is λ/d.
std::vector<CombLight> comb_of(const OrderEfficiencies& solved, double s_g, double period);

/// How far a sum of efficiencies may exceed 1: a lossless relief has 1.
inline constexpr double kSumTolerance = 1e-6;

struct Converged {
    OrderEfficiencies efficiencies;
    int truncation = 0;
    int added = 0;       ///< difference from the truncation before
    double error = 0.0;  ///< largest change of any efficiency between the two
};

/// Raises the truncation until no efficiency of light from s_g, in either polarisation, changes by more than
/// `tolerance`, and their sum is at most 1 + kSumTolerance. Throws Error (input) as solve() does, and if the limit, at
/// most kMaximumTruncation, is reached first: it then states the last changes and what to do.
Converged solve_converged(const Relief& relief, std::complex<double> substrate_index, double wavelength_nm, double s_g,
                          double tolerance = 5e-4);

/// The classical problem whose efficiencies approximate those of light from (s_g, s_h), |s| < 1: the same relief at
/// this wavelength and s_g, with the substrate's index at the true wavelength (PHYSICS §14).
struct ClassicalIncidence {
    double wavelength_nm = 0.0;
    double s_g = 0.0;
};
ClassicalIncidence classical_incidence(double ambient_ior, double wavelength_nm, double s_g, double s_h);

}  // namespace rowland::diffraction
