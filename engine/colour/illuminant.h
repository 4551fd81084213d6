#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/colour/sampled_spectrum.h"

namespace rowland::colour {

/// A light source's relative spectral power S(λ); 0 where its table ends. Its scale does not matter.
struct Illuminant {
    std::string name;
    SampledSpectrum power;
};

/// The built-in illuminants: "A", "D65", "E", "F2", "F11", "LED-B3".
std::vector<std::string> illuminant_names();

/// A built-in illuminant. Throws Error (input) that lists them for another name.
const Illuminant& illuminant(const std::string& name);

/// CIE standard illuminant D65.
const Illuminant& d65();

/// An illuminant from CSV text `wavelength_nm,relative_power`. Throws Error (input) naming the file and the row as
/// parse_spectrum_csv() does, for negative power, and if it is not visible.
Illuminant parse_illuminant(std::string_view text, const std::string& file);

inline constexpr std::uint64_t kMaximumIlluminantBytes = 1 << 20;

/// The same from a file of at most kMaximumIlluminantBytes.
Illuminant load_illuminant(const std::filesystem::path& path);

/// The text that parse_illuminant() reads back to the same numbers.
std::string write_illuminant_csv(const Illuminant& illuminant);

/// ∫S ȳ dλ over the visible range, trapezoid at 1 nm.
double luminous_power(const Illuminant& illuminant);

/// Whether luminous_power() is positive and finite, as is its reciprocal.
bool is_visible(const Illuminant& illuminant);

}  // namespace rowland::colour
