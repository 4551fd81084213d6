#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/colour/spectrum.h"

namespace rowland {
class JsonReader;
}

namespace rowland::colour {

/// A light source's relative spectral power S(λ), 0 outside its table. Its scale does not matter.
struct Illuminant {
    std::string name;
    SampledSpectrum power;
};

/// The built-in illuminants: "A", "D65", "E", "F2", "F11", "LED-B3".
std::vector<std::string> illuminant_names();

/// A built-in illuminant. Throws Error (input) that lists the names if `name` is none of them.
const Illuminant& illuminant(const std::string& name);

/// CIE standard illuminant D65.
const Illuminant& d65();

/// An illuminant from CSV text with the header `wavelength_nm,relative_power`. Throws Error (input) as
/// parse_spectrum_csv() does, for negative power, and unless is_visible().
Illuminant parse_illuminant(std::string_view text, const std::string& file);

inline constexpr std::uint64_t kMaximumIlluminantBytes = 1 << 20;

/// parse_illuminant() of a file of at most kMaximumIlluminantBytes.
Illuminant load_illuminant(const std::filesystem::path& path);

/// Inverse of parse_illuminant(): CSV text that gives the same numbers.
std::string write_illuminant_csv(const Illuminant& illuminant);

/// ∫S ȳ dλ over the visible range, trapezoid at 1 nm.
double luminous_power(const Illuminant& illuminant);

/// Whether luminous_power() is positive, and it and its reciprocal are finite.
bool is_visible(const Illuminant& illuminant);

/// B_c(λ): the spectra of linear Rec.709 red, green and blue, which sum to 1 [Mallett & Yuksel 2019]. Outside 380–780
/// nm the table's nearest value.
glm::dvec3 rgb_basis(double wavelength_nm);

/// Turns linear RGB into spectral radiance under an illuminant: L(λ) = Σ_c rgb_c E_c(λ), E_c(λ) = k_S S(λ) B_c(λ),
/// k_S = 1/∫S ȳ dλ. Linear, so it commutes with sums over light. rgb is relative to the illuminant's own white; with
/// D65 rgb (1,1,1) has Y = 1 and D65's white.
class LightSpectra {
 public:
    explicit LightSpectra(Illuminant illuminant = d65());

    /// (E_r, E_g, E_b) at a wavelength, per nm.
    glm::dvec3 operator()(double wavelength_nm) const;

    const Illuminant& illuminant() const { return illuminant_; }

 private:
    Illuminant illuminant_;
    double scale_;
};

/// XYZ of light of colour `rgb`: ∫ L(λ) cmf(λ) dλ, trapezoid at 1 nm over the visible range.
glm::dvec3 rgb_to_xyz(const LightSpectra& spectra, const glm::dvec3& rgb);

/// Reads "illuminant", a built-in name; D65 if it is absent. Throws Error (input) that lists the names.
Illuminant read_builtin_illuminant(JsonReader& json);

/// As read_builtin_illuminant(), but "illuminant" may also name a .csv file: then returns the name, and the caller
/// loads the file. `owner`, for messages, is what the name is relative to, as in "the material".
std::variant<Illuminant, std::string> read_illuminant(JsonReader& json, const std::string& owner);

}  // namespace rowland::colour
