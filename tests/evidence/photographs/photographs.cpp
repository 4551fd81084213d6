#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "editor/trade/measure_error.h"
#include "engine/colour/colour_space.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "tests/evidence/photographs/bench.h"
#include "tests/evidence/photographs/disc_line.h"
#include "tests/evidence/photographs/measure_disc.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

constexpr std::array<const char*, 2> kDiscs = {"CD-R", "DVD-R"};
constexpr std::array<const char*, 2> kFigureNames = {"cd", "dvd"};
constexpr std::array<int, 8> kShownTurns_deg = {15, 40, 65, 90, 115, 140, 165, 180};
constexpr int kShownSize = 200;
constexpr int kShownColumns = 4;
constexpr int kSamples = 2;  ///< per pixel's side
constexpr double kShownAsWhite = 0.995;
constexpr double kHole_m = 0.0218;  ///< where the recorded part begins and ends
constexpr double kEdge_m = 0.0597;
constexpr int kEdgeDots = 2000;
constexpr double kEdgeGrey = 0.06;
constexpr double kMostExposure = 16.0;  ///< of the darkest picture over the brightest one

/// Draws the disc's edges, and ticks beside them where the formula puts the line. `white`: a luminance.
void mark(const DrawnPicture& picture, const LampAndEye& setup, double white, std::vector<glm::dvec3>& pixels) {
    const auto dot_at = [&](double radius_m, double azimuth, double luminance) {
        const glm::ivec2 at(glm::round(picture.position_of(disc_point(radius_m, azimuth))));
        for (int i = 0; i < 4; ++i) {
            const glm::ivec2 pixel = at - glm::ivec2(i % 2, i / 2);
            if (glm::all(glm::greaterThanEqual(pixel, glm::ivec2(0))) &&
                glm::all(glm::lessThan(pixel, glm::ivec2(picture.size()))))
                pixels[static_cast<std::size_t>(pixel.y * picture.size() + pixel.x)] = luminance * colour::white_d65();
        }
    };
    for (const double radius_m : {kHole_m, kEdge_m})
        for (int i = 0; i < kEdgeDots; ++i) dot_at(radius_m, 2.0 * std::numbers::pi * i / kEdgeDots, kEdgeGrey * white);
    for (const auto& [from_m, to_m] : {std::pair{0.0165, 0.0205}, std::pair{0.0605, 0.0635}})
        for (double radius_m = from_m; radius_m < to_m; radius_m += 1e-4)
            for (const double azimuth : line_azimuths(setup, radius_m)) dot_at(radius_m, azimuth, white);
}

/// Each pixel is the mean of kSamples² drawn ones.
std::vector<glm::dvec3> smooth(const std::vector<glm::dvec3>& drawn) {
    std::vector<glm::dvec3> pixels;
    for (int row = 0; row < kShownSize; ++row)
        for (int column = 0; column < kShownSize; ++column) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < kSamples * kSamples; ++i)
                sum += drawn[static_cast<std::size_t>((kSamples * row + i / kSamples) * kSamples * kShownSize +
                                                      kSamples * column + i % kSamples)];
            pixels.push_back(sum / double{kSamples * kSamples});
        }
    return pixels;
}

/// The luminance that kShownAsWhite of the pixels do not exceed.
double white_of(const DrawnPicture& picture) {
    std::vector<double> luminance;
    for (const glm::dvec3& pixel : picture.xyz())
        if (pixel.y > 0.0) luminance.push_back(pixel.y);
    return diffraction::quantile(std::move(luminance), kShownAsWhite);
}

void place(const std::vector<glm::vec3>& pixels, int index, trade::RgbPicture& sheet) {
    const int left = kShownSize * (index % kShownColumns);
    const int top = kShownSize * (index / kShownColumns);
    for (int row = 0; row < kShownSize; ++row)
        for (int column = 0; column < kShownSize; ++column)
            for (int c = 0; c < 3; ++c)
                sheet.rgb[static_cast<std::size_t>(3 * ((top + row) * sheet.width + left + column) + c)] =
                    static_cast<std::uint8_t>(
                        std::lround(255.0F * pixels[static_cast<std::size_t>(row * kShownSize + column)][c]));
}

/// Pictures of a disc under the white lamp, each exposed by itself, as far as the disc's gloss stays dark.
Json contact_sheet(Bench& bench, const char* disc, const Station& camera) {
    bench.show(disc);
    std::vector<DrawnPicture> drawn;
    std::vector<double> white;
    for (const int turned_deg : kShownTurns_deg) {
        drawn.push_back(bench.draw(lamp_and_eye(camera, turned_deg), kSamples * kShownSize));
        white.push_back(white_of(drawn.back()));
    }
    const double least_white = std::ranges::max(white) / kMostExposure;
    const int rows = static_cast<int>(kShownTurns_deg.size()) / kShownColumns;
    trade::RgbPicture sheet{.width = kShownColumns * kShownSize, .height = rows * kShownSize, .rgb = {}};
    sheet.rgb.resize(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double exposed_for = std::max(white[i], least_white);
        std::vector<glm::dvec3> pixels = drawn[i].xyz();
        mark(drawn[i], lamp_and_eye(camera, kShownTurns_deg.at(i)), exposed_for, pixels);
        place(trade::displayed(smooth(pixels), static_cast<float>(-std::log2(exposed_for))), static_cast<int>(i),
              sheet);
    }
    return {{"caption", fmt::format("{}, camera at {} m and {}°; turned by 15°, 40°, 65°, 90° and 115°, 140°, 165°, "
                                    "180°. White ticks: the formula; grey: the grooves' edges",
                                    disc, camera.distance_m, camera.from_normal_deg)},
            {"image", trade::data_url(sheet)}};
}

/// Azimuths so that each branch of the line is one curve: in [5°, 365°).
double unrolled_deg(double azimuth_deg) {
    return azimuth_deg < 5.0 ? azimuth_deg + 360.0 : azimuth_deg;
}

Json azimuth_plot(const char* disc, const Station& camera, const DiscErrors& errors) {
    std::array<Json, 2> curves = {Json::array(), Json::array()};
    for (int turned_deg = kFirstTurn_deg; turned_deg <= kLastTurn_deg; ++turned_deg)
        for (const double azimuth : line_azimuths(lamp_and_eye(camera, turned_deg), kPlottedRadius_m)) {
            const double deg = unrolled_deg(glm::degrees(azimuth));
            curves.at(deg > 185.0 ? 1 : 0).push_back({turned_deg, deg});
        }
    Json points = Json::array();
    for (const auto& [turned_deg, azimuth_deg] : errors.found_deg)
        points.push_back({turned_deg, unrolled_deg(azimuth_deg)});
    return {{"caption", fmt::format("{}, camera at {}°: azimuth of the line at a radius of {} mm", disc,
                                    camera.from_normal_deg, 1000.0 * kPlottedRadius_m)},
            {"x", {{"label", "turned by (°)"}, {"from", 0}, {"to", 180}}},
            {"y", {{"label", "azimuth from the camera's plane (°)"}, {"from", 0}, {"to", 360}}},
            {"series",
             {{{"name", "formula"}, {"kind", "line"}, {"points", curves[0]}},
              {{"name", "formula, other side"}, {"kind", "line"}, {"points", curves[1]}},
              {{"name", "found in the pictures"}, {"kind", "points"}, {"points", points}}}}};
}

std::string largest_and_rms(const ErrorSum& errors, int decimals) {
    return fmt::format("{:.{}f} / {:.{}f}", errors.largest, decimals, errors.rms(), decimals);
}

Json table_row(const char* disc, const Station& camera, const DiscErrors& errors) {
    Json row = {disc,
                fmt::format("{} m, {}°", camera.distance_m, camera.from_normal_deg),
                errors.pictures,
                errors.position_deg.count,
                fmt::format("{} of {}", errors.missed, errors.expected),
                largest_and_rms(errors.position_deg, 2)};
    for (const ErrorSum& order : errors.wavelength_nm)
        row.push_back(order.count == 0 ? std::string("none")
                                       : fmt::format("{}: {}", order.count, largest_and_rms(order, 1)));
    return row;
}

/// The same measurement of a few pictures, with something else.
struct Variant {
    const char* name;
    int size = kPictureSize;
    Disturbance disturbance{};
};
const std::array<Variant, 5> kVariants = {{{"as above"},
                                           {"pictures of 768² pixels", 768},
                                           {"the same, lobe half as wide", 768, {.lobe_factor = 0.5}},
                                           {"grooves 1 % farther apart", kPictureSize, {.pitch_factor = 1.01}},
                                           {"grooves turned by 2°", kPictureSize, {.groove_rotation_deg = 2.0}}}};
constexpr std::array<int, 4> kVariantTurns_deg = {30, 75, 120, 165};

Json variants_table(Bench& bench) {
    Json rows = Json::array();
    for (const Variant& variant : kVariants) {
        Json row = {variant.name};
        for (const char* disc : kDiscs) {
            ErrorSum position_deg;
            ErrorSum wavelength_nm;
            for (const Station& camera : kCameras) {
                const DiscErrors errors =
                    measure_disc(bench, disc, camera, kVariantTurns_deg, variant.size, variant.disturbance);
                position_deg.add(errors.position_deg);
                wavelength_nm.add(errors.all_wavelengths_nm());
            }
            row.push_back(largest_and_rms(position_deg, 2));
            row.push_back(largest_and_rms(wavelength_nm, 2));
        }
        rows.push_back(row);
    }
    return {{"caption",
             "What the errors depend on, and that a wrong disc is noticed: largest / RMS over four of the turns (30°, "
             "75°, 120°, 165°) and the three cameras"},
            {"columns", {"", "CD-R (°)", "CD-R (nm)", "DVD-R (°)", "DVD-R (nm)"}},
            {"rows", rows}};
}

Json text(int pictures, int points, double largest_deg, double largest_nm) {
    return {
        fmt::format(
            "In {} drawn pictures, under a white lamp and four of one colour, the bright line of a CD-R and a DVD-R "
            "lies within {:.1f}° of where the grating equation puts it and shows its wavelengths within {:.1f} nm ({} "
            "points; aim: 1° and 5 nm). The same discs with grooves 1 % farther apart, or turned by 2°, miss the aim.",
            pictures, largest_deg, largest_nm, points),
        "The set-ups are those of Egholm & Christensen, \"Rendering compact disks and other diffractive surfaces "
        "illuminated by linear light sources\" (GRAPHITE 2006): a lamp 0.7 m from the disc at 83.5° from its normal, "
        "cameras at 0.227, 0.298 and 0.35 m and 38°, 29° and 23°, turned from 15° to 180° in steps of 5°. Their "
        "photographs are not ours to show; only their geometry is used. So this compares our own drawing with the "
        "grating equation, not with photographs.",
        // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): one paragraph
        "Formula: at a point of the disc light leaves where s_h + v_h = 0 along the track, which is sin α sin θ_s = "
        "sin φ sin θ_o, and order m shows the wavelength |s_g + v_g| d / m. It is solved in double precision for each "
        "radius and shares no code with the drawing.",
        fmt::format(
            "Pictures: content/scenes/bench.glb, drawn by the engine with {0} × {0} pixels, one sample each, and "
            "measured before the display transform. The lamp is a point and the only light. Unbroken grooves 1600 and "
            "740 nm apart, orders −3 to 3, under polycarbonate; light spreads along the track by σ = 0.02. Our "
            "assumptions: the turn is the azimuth between lamp and camera, and the camera looks at the disc's centre.",
            kPictureSize),
        "Position: around circles of 25, 33, 41, 49 and 58 mm, the centroid of what exceeds half of a maximum of X + Y "
        "+ Z under the white lamp. Maxima above 2 % of the picture's brightest point and 0.2 % of the series' "
        "brightest point count, and are compared with the formula's nearest crossing. \"Not found\": crossings where "
        "an order has a wavelength of 450 to 650 nm.",
        fmt::format("Wavelength: under lamps of one colour (450, 530, 600, 650 nm, normal distributions, σ = {} nm) "
                    "the line shrinks to spots. The formula's wavelength at the middle of each complete spot is "
                    "compared with the lamp's mean; before the colon stands the number of spots. Nothing is corrected "
                    "for the slopes of colour matching functions, efficiency and cosine inside the band. Where the "
                    "table says none, that order of these colours does not reach the camera.",
                    kBandDeviation_nm),
        "The second table states what limits: not the pixels, but the lobe's width, for the position. The error is "
        "largest where the line ends or passes from one order's red to the next one's blue, since brightness changes "
        "along the circle there."};
}

}  // namespace

Json photographs(const Inputs& /*inputs*/) {
    Bench bench(ROWLAND_SOURCE_FOLDER "/content/scenes/bench.glb");
    const std::vector<int> turns_deg = all_turns_deg();
    Json rows = Json::array();
    Json plots = Json::array();
    Json pictures = Json::array();
    Json figures;
    int drawn = 0;
    int points = 0;
    double largest_deg = 0.0;
    double largest_nm = 0.0;
    for (std::size_t i = 0; i < kDiscs.size(); ++i) {
        ErrorSum position_deg;
        ErrorSum wavelength_nm;
        for (const Station& camera : kCameras) {
            const DiscErrors errors = measure_disc(bench, kDiscs.at(i), camera, turns_deg);
            rows.push_back(table_row(kDiscs.at(i), camera, errors));
            if (&camera == &kCameras[1]) plots.push_back(azimuth_plot(kDiscs.at(i), camera, errors));
            position_deg.add(errors.position_deg);
            wavelength_nm.add(errors.all_wavelengths_nm());
            drawn += errors.pictures;
            points += errors.position_deg.count + errors.all_wavelengths_nm().count;
        }
        pictures.push_back(contact_sheet(bench, kDiscs.at(i), kCameras[1]));
        largest_deg = std::max(largest_deg, position_deg.largest);
        largest_nm = std::max(largest_nm, wavelength_nm.largest);
        figures[fmt::format("photographs.position_deg.{}", kFigureNames.at(i))] = position_deg.largest;
        figures[fmt::format("photographs.wavelength_nm.{}", kFigureNames.at(i))] = wavelength_nm.largest;
    }
    figures["photographs.pictures"] = drawn;
    figures["photographs.points"] = points;
    return {{"title", "Discs in photographs"},
            {"text", text(drawn, points, largest_deg, largest_nm)},
            {"tables",
             {{{"caption", "Errors of what is found in the pictures, largest / RMS"},
               {"columns",
                {"disc", "camera", "pictures", "crossings found", "not found", "position (°)", "order 1 (nm)",
                 "order 2 (nm)", "order 3 (nm)"}},
               {"rows", rows}},
              variants_table(bench)}},
            {"plots", plots},
            {"pictures", pictures},
            {"figures", figures}};
}

}  // namespace rowland::evidence
