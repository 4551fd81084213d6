#include "engine/colour/illuminant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <string_view>
#include <vector>

#include "engine/colour/spectrum.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"

namespace rowland::colour {

namespace {

constexpr const char* kHeader = "wavelength_nm,relative_power";

const std::map<std::string, Illuminant>& builtin_illuminants() {
    static const std::map<std::string, Illuminant> illuminants = [] {
        std::map<std::string, Illuminant> result;
        for (const char* name : {"A", "D65", "E", "F2", "F11", "LED-B3"}) {
            const SpectrumTable table = builtin_table(fmt::format("illuminants/illuminant_{}.csv", name), kHeader);
            result.emplace(name, Illuminant{.name = name, .power = spectrum(table, 0, Outside::Zero)});
        }
        return result;
    }();
    return illuminants;
}

}  // namespace

std::vector<std::string> illuminant_names() {
    std::vector<std::string> names;
    for (const auto& [name, ignored] : builtin_illuminants()) names.push_back(name);
    return names;
}

const Illuminant& illuminant(const std::string& name) {
    const auto found = builtin_illuminants().find(name);
    if (found == builtin_illuminants().end())
        refuse_input("", "illuminant", fmt::format("\"{}\"", name),
                     fmt::format("one of {}", fmt::join(illuminant_names(), ", ")));
    return found->second;
}

const Illuminant& d65() {
    return illuminant("D65");
}

Illuminant parse_illuminant(std::string_view text, const std::string& file) {
    const SpectrumTable table = parse_spectrum_csv(text, file, kHeader);
    for (std::size_t i = 0; i < table.wavelengths_nm.size(); ++i)
        if (table.columns[0][i] < 0.0)
            refuse_input(file, fmt::format("{} nm", table.wavelengths_nm[i]),
                         fmt::format("relative power {}", table.columns[0][i]), "a power >= 0");
    Illuminant result{.name = file, .power = spectrum(table, 0, Outside::Zero)};
    if (!is_visible(result))
        refuse_input(file, "",
                     fmt::format("no visible power (luminous power {}) in {}-{} nm", luminous_power(result),
                                 table.wavelengths_nm.front(), table.wavelengths_nm.back()),
                     fmt::format("some power in {}-{} nm", kVisibleMin, kVisibleMax), "wavelengths are in nanometres");
    return result;
}

Illuminant load_illuminant(const std::filesystem::path& path) {
    return parse_illuminant(read_text_file(path, kMaximumIlluminantBytes), path.string());
}

std::string write_illuminant_csv(const Illuminant& illuminant) {
    std::string text = std::string(kHeader) + "\n";
    for (std::size_t i = 0; i < illuminant.power.values().size(); ++i)
        fmt::format_to(std::back_inserter(text), "{},{}\n", illuminant.power.wavelengths_nm()[i],
                       illuminant.power.values()[i]);
    return text;
}

bool is_visible(const Illuminant& illuminant) {
    // Extreme powers would turn every colour into 0 or infinity.
    const double luminous = luminous_power(illuminant);
    return luminous > 0.0 && std::isfinite(luminous) && std::isfinite(1.0 / luminous);
}

double luminous_power(const Illuminant& illuminant) {
    return integrate_visible<double>(
        [&](double wavelength_nm) { return illuminant.power(wavelength_nm) * cie_xyz(wavelength_nm).y; });
}

namespace {

std::array<SampledSpectrum, 3> load_basis() {
    const SpectrumTable table = builtin_table("mallett2019_srgb_basis_5nm.csv", "wavelength_nm,r,g,b");
    return {spectrum(table, 0, Outside::Clamp), spectrum(table, 1, Outside::Clamp), spectrum(table, 2, Outside::Clamp)};
}

}  // namespace

glm::dvec3 rgb_basis(double wavelength_nm) {
    static const std::array<SampledSpectrum, 3> basis = load_basis();
    return {basis[0](wavelength_nm), basis[1](wavelength_nm), basis[2](wavelength_nm)};
}

LightSpectra::LightSpectra(Illuminant illuminant)
    : illuminant_(std::move(illuminant)), scale_(1.0 / luminous_power(illuminant_)) {}

glm::dvec3 LightSpectra::operator()(double wavelength_nm) const {
    return scale_ * illuminant_.power(wavelength_nm) * rgb_basis(wavelength_nm);
}

glm::dvec3 rgb_to_xyz(const LightSpectra& spectra, const glm::dvec3& rgb) {
    return integrate_visible<glm::dvec3>(
        [&](double wavelength_nm) { return glm::dot(spectra(wavelength_nm), rgb) * cie_xyz(wavelength_nm); });
}

Illuminant read_builtin_illuminant(JsonReader& json) {
    const std::vector<std::string> names = illuminant_names();
    return illuminant(json.choice_or("illuminant", d65().name, {names.begin(), names.end()}));
}

std::variant<Illuminant, std::string> read_illuminant(JsonReader& json, const std::string& owner) {
    const std::string name = json.text_or("illuminant", d65().name);
    json.annotate("illuminant", R"({"minLength": 1})");
    if (json.is_recording_schema()) return d65();
    const std::vector<std::string> names = illuminant_names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return illuminant(name);
    if (name.ends_with(".csv")) return name;
    const auto near = nearest_word(name, names);
    json.fail("illuminant", fmt::format("\"{}\"", name),
              fmt::format("one of {}, or a .csv file beside {}", fmt::join(names, ", "), owner),
              near ? fmt::format("is \"{}\" meant?", *near) : "");
}

}  // namespace rowland::colour
