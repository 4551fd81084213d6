#include "engine/colour/illuminant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <map>

#include "engine/colour/observer.h"
#include "engine/colour/spectrum_csv.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

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

}  // namespace rowland::colour
