#pragma once

#include <vector>

namespace rowland::colour {

/// The range all spectra are integrated over, by the trapezoid rule at 1 nm.
inline constexpr int kVisibleMin = 380;
inline constexpr int kVisibleMax = 780;

/// ∫ f(λ) dλ over that range. `T` is what f returns.
template <typename T, typename Function>
T integrate_visible(const Function& f) {
    T sum(0.0);
    for (int wavelength_nm = kVisibleMin; wavelength_nm <= kVisibleMax; ++wavelength_nm) {
        const bool at_an_end = wavelength_nm == kVisibleMin || wavelength_nm == kVisibleMax;
        sum += (at_an_end ? 0.5 : 1.0) * f(wavelength_nm);
    }
    return sum;
}

/// Values of a spectrum outside its table.
enum class Outside {
    Zero,   ///< for emission and sensitivity
    Clamp,  ///< the nearest value: for properties of materials
};

/// A function of wavelength given by samples, linear between them.
class SampledSpectrum {
 public:
    /// `wavelengths_nm` ascends strictly and has as many elements (≥ 2) as `values`; both finite.
    SampledSpectrum(std::vector<double> wavelengths_nm, std::vector<double> values, Outside outside);

    double operator()(double wavelength_nm) const;

    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }
    const std::vector<double>& values() const { return values_; }

 private:
    std::vector<double> wavelengths_nm_;
    std::vector<double> values_;
    Outside outside_;
    double even_step_nm_;  ///< distance of the samples where it is the same for all, else 0
};

}  // namespace rowland::colour
