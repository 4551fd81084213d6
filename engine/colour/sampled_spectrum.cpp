#include "engine/colour/sampled_spectrum.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace rowland::colour {

namespace {

/// The distance of evenly spaced samples, else 0. Even tables need no search.
double even_step(const std::vector<double>& x) {
    const double step = x[1] - x[0];
    for (std::size_t i = 1; i < x.size(); ++i)
        if (x[i] != x[0] + step * static_cast<double>(i)) return 0.0;
    return step;
}

}  // namespace

SampledSpectrum::SampledSpectrum(std::vector<double> wavelengths_nm, std::vector<double> values, Outside outside)
    : wavelengths_nm_(std::move(wavelengths_nm)), values_(std::move(values)), outside_(outside) {
    ROWLAND_CHECK_OP(wavelengths_nm_.size(), >=, std::size_t{2});
    ROWLAND_CHECK_OP(wavelengths_nm_.size(), ==, values_.size());
    for (std::size_t i = 1; i < wavelengths_nm_.size(); ++i)
        ROWLAND_CHECK_OP(wavelengths_nm_[i - 1], <, wavelengths_nm_[i]);
    even_step_nm_ = even_step(wavelengths_nm_);
}

double SampledSpectrum::operator()(double wavelength_nm) const {
    const auto& x = wavelengths_nm_;
    if (wavelength_nm < x.front()) return outside_ == Outside::Zero ? 0.0 : values_.front();
    if (wavelength_nm >= x.back()) {
        if (wavelength_nm == x.back() || outside_ == Outside::Clamp) return values_.back();
        return 0.0;
    }
    std::size_t i = 0;
    if (even_step_nm_ > 0.0) {
        i = std::min(static_cast<std::size_t>((wavelength_nm - x.front()) / even_step_nm_), x.size() - 2);
    } else {
        i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), wavelength_nm) - x.begin()) - 1;
    }
    const double t = (wavelength_nm - x[i]) / (x[i + 1] - x[i]);
    return values_[i] + t * (values_[i + 1] - values_[i]);
}

}  // namespace rowland::colour
