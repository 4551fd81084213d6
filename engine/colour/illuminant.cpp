#include "engine/colour/illuminant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <map>

#include "engine/colour/embedded_tables.h"
#include "engine/colour/observer.h"
#include "engine/colour/spectrum_csv.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::colour {

namespace {

const std::map<std::string, Illuminant>& builtin_illuminants() {
    static const std::map<std::string, Illuminant> illuminants = [] {
        std::map<std::string, Illuminant> result;
        const auto add = [&](const std::string& name, std::string_view text) {
            Illuminant parsed = parse_illuminant(text, "illuminant_" + name + ".csv");
            parsed.name = name;
            result.emplace(name, std::move(parsed));
        };
        add("A", embedded::kIlluminantA);
        add("D65", embedded::kIlluminantD65);
        add("E", embedded::kIlluminantE);
        add("F2", embedded::kIlluminantF2);
        add("F11", embedded::kIlluminantF11);
        add("LED-B3", embedded::kIlluminantLedB3);
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
        throw Error({.file = {},
                     .place = "illuminant",
                     .found = fmt::format("\"{}\"", name),
                     .expected = fmt::format("one of {}", fmt::join(illuminant_names(), ", ")),
                     .remedy = {}});
    return found->second;
}

const Illuminant& d65() {
    return illuminant("D65");
}

Illuminant parse_illuminant(std::string_view text, const std::string& file) {
    const SpectrumTable table = parse_spectrum_csv(text, file, "wavelength_nm,relative_power");
    for (std::size_t i = 0; i < table.wavelengths_nm.size(); ++i)
        if (table.columns[0][i] < 0.0)
            throw Error({.file = file,
                         .place = fmt::format("{} nm", table.wavelengths_nm[i]),
                         .found = fmt::format("relative power {}", table.columns[0][i]),
                         .expected = "a power >= 0",
                         .remedy = {}});
    Illuminant result{.name = file, .power = SampledSpectrum(table.wavelengths_nm, table.columns[0], Outside::Zero)};
    if (!is_visible(result))
        throw Error({.file = file,
                     .place = {},
                     .found = fmt::format("no visible power (luminous power {}) in {}-{} nm", luminous_power(result),
                                          table.wavelengths_nm.front(), table.wavelengths_nm.back()),
                     .expected = fmt::format("some power in {}-{} nm", kVisibleMin, kVisibleMax),
                     .remedy = "wavelengths are in nanometres"});
    return result;
}

Illuminant load_illuminant(const std::filesystem::path& path) {
    return parse_illuminant(read_text_file(path, kMaximumIlluminantBytes), path.string());
}

std::string write_illuminant_csv(const Illuminant& illuminant) {
    std::string text = "wavelength_nm,relative_power\n";
    for (std::size_t i = 0; i < illuminant.power.values().size(); ++i)
        fmt::format_to(std::back_inserter(text), "{},{}\n", illuminant.power.wavelengths_nm()[i],
                       illuminant.power.values()[i]);
    return text;
}

bool is_visible(const Illuminant& illuminant) {
    // Powers near the ends of double's range would make 0 or infinity of every colour.
    const double luminous = luminous_power(illuminant);
    return luminous > 0.0 && std::isfinite(luminous) && std::isfinite(1.0 / luminous);
}

double luminous_power(const Illuminant& illuminant) {
    double sum = 0.0;
    for (int wavelength_nm = kVisibleMin; wavelength_nm <= kVisibleMax; ++wavelength_nm) {
        const double weight = wavelength_nm == kVisibleMin || wavelength_nm == kVisibleMax ? 0.5 : 1.0;
        sum += weight * illuminant.power(wavelength_nm) * cie_xyz(wavelength_nm).y;
    }
    return sum;
}

}  // namespace rowland::colour
