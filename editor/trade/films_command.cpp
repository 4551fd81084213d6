#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "editor/trade/commands.h"
#include "editor/trade/film_methods.h"
#include "editor/trade/inputs.h"
#include "editor/trade/sweep.h"
#include "engine/colour/colour_space.h"
#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/thin_film/model/film.h"
#include "modules/thin_film/reference/film_reference.h"

namespace rowland::trade {

namespace {

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

Colours exact(const FilmSubject& subject) {
    const thin_film::FilmColour colour(subject.film(0.0), colour::LightSpectra{});
    Colours colours;
    for (int row = 0; row < kAngles; ++row) {
        const auto at = colour.at(cosine(row));
        for (int column = 0; column < kThicknesses; ++column)
            colours.push_back(colour::xyz_to_rec709() * (at(thickness_nm(column)) * glm::dvec3(1.0)));
    }
    return colours;
}

/// By glTF's formula, which represents the base by its colour at normal incidence.
Colours by_formula(const FilmSubject& subject) {
    const glm::dvec3 f0 = thin_film::normal_colour(subject.base);
    Colours colours;
    for (int row = 0; row < kAngles; ++row)
        for (int column = 0; column < kThicknesses; ++column)
            colours.push_back(thin_film::gltf_formula(subject.film_ior, thickness_nm(column), f0, cosine(row)));
    return colours;
}

Colours by_three_wavelengths(const FilmSubject& subject) {
    Colours colours;
    for (int row = 0; row < kAngles; ++row)
        for (int column = 0; column < kThicknesses; ++column)
            colours.push_back(three_wavelengths(subject.film(thickness_nm(column)), cosine(row)));
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
        for (int i = 0; i < kThicknesses * kAngles * 2 / 3; ++i)  // up to 56 degrees: beyond, all are mirrors
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

/// Writes the picture; returns a table of the errors of the formulas.
std::string swatches(const std::filesystem::path& picture) {
    Page page;
    std::string table = "| film | glTF's formula | three wavelengths |\n| --- | --- | --- |\n";
    int row = 0;
    for (const FilmSubject& subject : film_subjects()) {
        const Colours truth = exact(subject);
        const Colours formula = by_formula(subject);
        const Colours three = by_three_wavelengths(subject);
        page.add(0, row, truth, truth);
        page.add(1, row, formula, truth);
        page.add(2, row, three, truth);
        ++row;
        fmt::format_to(std::back_inserter(table), "| {} | {:.1f} % | {:.1f} % |\n", subject.name,
                       100.0 * diffraction::relative_rms(formula, truth),
                       100.0 * diffraction::relative_rms(three, truth));
    }
    page.write(picture);
    return table;
}

/// A table of the methods under one probe.
std::string trade_under(const ProbeFile& probe) {
    std::string table = fmt::format(
        "\n{}:\n\n| film | roughness | method | error | bytes | fetches | multiply-adds | functions |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- |\n",
        probe.path.stem().string());
    for (const FilmRow& row : film_rows(read_probe(probe.path, probe.mapping)))
        fmt::format_to(std::back_inserter(table), "| {} | {} | {} | {:.1f} % | {} | {} | {} | {} |\n", row.film,
                       row.roughness, row.method, 100.0 * row.relative_rms, row.table_bytes, row.fetches,
                       row.multiply_adds, row.functions);
    return table;
}

struct FilmsOptions {
    std::filesystem::path picture;
    std::vector<std::string> probes;
};

void show_films(const FilmsOptions& options) {
    std::vector<ProbeFile> probes;
    std::vector<std::filesystem::path> files;
    for (const std::string& probe : options.probes)
        files.push_back(probes.emplace_back(parse_probe_file(probe, "auto")).path);
    check_outputs(files, std::array{Output{"picture", options.picture, ".png"}});
    std::string tables = swatches(options.picture);
    for (const ProbeFile& probe : probes) tables += trade_under(probe);
    write_results(tables);
}

}  // namespace

void add_films_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("films", "Colours of thin films, exact and by common formulas");
    command->footer(
        "Writes a picture: a row for each of six bases; in it the exact colours, those of glTF's formula and of three\n"
        "wavelengths; from left to right 0 to 1000 nm, from the top down 0 to 85 degrees. Standard output: the errors "
        "of\n"
        "the formulas, relative RMS; under each probe, what the table, spherical harmonics and the formulas make "
        "of rough films.\n"
        "Example:\n  rowland-trade films swatches.png");
    const auto options = std::make_shared<FilmsOptions>();
    command->add_option("picture", options->picture, "PNG to write")->required()->type_name("FILE");
    command
        ->add_option(
            "--probe", options->probes,
            "Also prints error and cost of six methods on rough films under this light; may be given several\n"
            "times. FILE:angular and FILE:equirect name its mapping")
        ->type_name("FILE[:MAPPING]");
    command->callback([options] { show_films(*options); });
}

}  // namespace rowland::trade
