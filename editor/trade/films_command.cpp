#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "editor/trade/commands.h"
#include "editor/trade/results.h"
#include "engine/colour/primaries.h"
#include "engine/colour/srgb.h"
#include "engine/image/png.h"
#include "modules/diffraction/evaluate/radiance_error.h"
#include "modules/thin_film/model/film_colour.h"
#include "modules/thin_film/model/reflectance.h"
#include "modules/thin_film/reference/gltf_formula.h"

namespace rowland::trade {

namespace {

using thin_film::Film;

struct Swatch {
    const char* name;
    double film_ior;
    thin_film::Base base;
};

const std::array<Swatch, 6>& swatches() {
    static const std::array<Swatch, 6> all = {
        {{"soap (1.33 on air)", 1.33, std::complex<double>(1.0)},
         {"coating (1.38 on glass 1.5)", 1.38, std::complex<double>(1.5)},
         {"oil (1.47 on water 1.33)", 1.47, std::complex<double>(1.33)},
         {"oxide (1.77 on Al)", 1.77, colour::Metal::Al},
         {"glass (1.5 on Cu)", 1.5, colour::Metal::Cu},
         {"oxide (2.4 on titanium, 2.5 + 3.3i)", 2.4, std::complex<double>(2.5, 3.3)}}};
    return all;
}

constexpr int kThicknesses = 240;  ///< 0 to 1000 nm, from left to right
constexpr int kAngles = 60;        ///< 0 to 85 degrees, from the top down
constexpr int kGap = 6;

double thickness_nm(int column) {
    return 1000.0 * column / (kThicknesses - 1);
}

double cosine(int row) {
    return std::cos(85.0 * row / (kAngles - 1) * std::numbers::pi / 180.0);
}

/// Linear Rec.709 of reflected white light for all angles and thicknesses.
using Colours = std::vector<glm::dvec3>;

Colours exact(const Swatch& swatch) {
    const thin_film::FilmColour colour({.layers = {{swatch.film_ior, 0.0}}, .base = swatch.base},
                                       colour::LightSpectra{});
    Colours colours;
    for (int row = 0; row < kAngles; ++row) {
        const auto at = colour.at(cosine(row));
        for (int column = 0; column < kThicknesses; ++column)
            colours.push_back(colour::xyz_to_rec709() * (at(thickness_nm(column)) * glm::dvec3(1.0)));
    }
    return colours;
}

/// As a renderer has it that knows the base by its colour at normal incidence.
Colours by_formula(const Swatch& swatch) {
    const thin_film::FilmColour bare({.layers = {{1.0, 0.0}}, .base = swatch.base}, colour::LightSpectra{});
    const glm::dvec3 f0 = colour::xyz_to_rec709() * (bare(1.0) * glm::dvec3(1.0));
    Colours colours;
    for (int row = 0; row < kAngles; ++row)
        for (int column = 0; column < kThicknesses; ++column)
            colours.push_back(thin_film::gltf_formula(swatch.film_ior, thickness_nm(column), f0, cosine(row)));
    return colours;
}

/// Airy's sum at one wavelength for each of red, green and blue.
Colours three_wavelengths(const Swatch& swatch) {
    constexpr std::array<double, 3> kWavelengths_nm = {650.0, 550.0, 450.0};
    Colours colours;
    for (int row = 0; row < kAngles; ++row)
        for (int column = 0; column < kThicknesses; ++column) {
            const Film film{.layers = {{swatch.film_ior, thickness_nm(column)}}, .base = swatch.base};
            glm::dvec3 colour(0.0);
            for (int c = 0; c < 3; ++c)
                colour[c] = thin_film::reflectance(film, kWavelengths_nm.at(static_cast<std::size_t>(c)), cosine(row));
            colours.push_back(colour);
        }
    return colours;
}

std::uint8_t byte_of(double linear) {
    return static_cast<std::uint8_t>(std::lround(255.0 * colour::srgb_encoded(std::clamp(linear, 0.0, 1.0))));
}

/// A row of pictures for each base: exact, glTF's formula, three wavelengths.
class Page {
 public:
    static constexpr int kWidth = 3 * kThicknesses + 2 * kGap;
    static constexpr int kHeight = 6 * kAngles + 5 * kGap;

    Page() : rgb_(static_cast<std::size_t>(kWidth * kHeight * 3), 255) {}

    /// Brightened so that the largest of `scale_of` is white.
    void add(int block_column, int block_row, const Colours& colours, const Colours& scale_of) {
        double largest = 0.0;
        for (int i = 0; i < kThicknesses * kAngles * 2 / 3; ++i)  // up to 57 degrees: beyond, all are mirrors
            for (int c = 0; c < 3; ++c) largest = std::max(largest, scale_of[static_cast<std::size_t>(i)][c]);
        for (int row = 0; row < kAngles; ++row)
            for (int column = 0; column < kThicknesses; ++column)
                for (int c = 0; c < 3; ++c) {
                    const int x = block_column * (kThicknesses + kGap) + column;
                    const int y = block_row * (kAngles + kGap) + row;
                    const glm::dvec3& colour = colours[static_cast<std::size_t>(row * kThicknesses + column)];
                    rgb_[static_cast<std::size_t>((y * kWidth + x) * 3 + c)] = byte_of(colour[c] / largest);
                }
    }
    void write(const std::filesystem::path& path) const { image::write_png(path, kWidth, kHeight, rgb_); }

 private:
    std::vector<std::uint8_t> rgb_;
};

void show_films(const std::filesystem::path& picture) {
    Page page;
    std::string table = "| film | glTF's formula | three wavelengths |\n| --- | --- | --- |\n";
    int row = 0;
    for (const Swatch& swatch : swatches()) {
        const Colours truth = exact(swatch);
        const Colours formula = by_formula(swatch);
        const Colours three = three_wavelengths(swatch);
        page.add(0, row, truth, truth);
        page.add(1, row, formula, truth);
        page.add(2, row, three, truth);
        ++row;
        fmt::format_to(std::back_inserter(table), "| {} | {:.1f} % | {:.1f} % |\n", swatch.name,
                       100.0 * diffraction::relative_rms(formula, truth),
                       100.0 * diffraction::relative_rms(three, truth));
    }
    page.write(picture);
    write_results(table);
}

}  // namespace

void add_films_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("films", "Colours of thin films, exact and by common formulas");
    command->footer(
        "Writes a picture: a row for each of six bases; in it the exact colours, those of glTF's formula and of three\n"
        "wavelengths; from left to right 0 to 1000 nm, from the top down 0 to 85 degrees. Standard output: how far "
        "off\n"
        "the formulas are, relative RMS.\n"
        "Example:\n  rowland-trade films swatches.png");
    const auto picture = std::make_shared<std::filesystem::path>();
    command->add_option("picture", *picture, "PNG to write")->required()->type_name("FILE");
    command->callback([picture] { show_films(*picture); });
}

}  // namespace rowland::trade
