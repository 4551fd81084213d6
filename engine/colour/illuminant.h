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

/// Illuminants that are built in: "A", "D65", "E", "F2", "F11", "LED-B3".
std::vector<std::string> illuminant_names();

/// A built-in illuminant. Throws Error (input) naming the ones there are.
const Illuminant& illuminant(const std::string& name);

/// CIE standard illuminant D65.
const Illuminant& d65();

/// An illuminant from CSV text `wavelength_nm,relative_power`. Throws Error (input) naming the file and the row for
/// what parse_spectrum_csv() refuses, for negative power, and if ∫S ȳ dλ is 0, or no number to
/// divide by: the eye must see something of it.
Illuminant parse_illuminant(std::string_view text, const std::string& file);

/// An illuminant's file may be so large.
inline constexpr std::uint64_t kMaximumIlluminantBytes = 1 << 20;

/// The same from a file of at most kMaximumIlluminantBytes.
Illuminant load_illuminant(const std::filesystem::path& path);

/// The text that parse_illuminant() reads back to the same numbers.
std::string write_illuminant_csv(const Illuminant& illuminant);

/// ∫S ȳ dλ over the visible range, trapezoid at 1 nm.
double luminous_power(const Illuminant& illuminant);

/// Whether luminous_power() is a positive number that can be divided by.
bool is_visible(const Illuminant& illuminant);

}  // namespace rowland::colour
