#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "editor/trade/inputs.h"
#include "editor/trade/measure_error.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

constexpr int kPictureWidth = 32;
constexpr int kPictureHeight = 24;

/// The pressed disc of content/materials, with another lobe along its tracks.
nlohmann::json pressed_disc(const nlohmann::json& lobe) {
    nlohmann::json material =
        diffraction::load_material_json(ROWLAND_SOURCE_FOLDER "/content/materials/cd_pressed.json");
    material["grating"]["groove_lobe"] = lobe;
    return material;
}

/// Sun's disc as Egholm & Christensen use it: pits of all lengths of the code.
nlohmann::json sequence_lobe() {
    nlohmann::json spacings;
    for (int spacing_nm = 900; spacing_nm <= 3300; spacing_nm += 300) spacings.push_back(spacing_nm);
    return {{"pit_sequence", {{"spacings_nm", spacings}, {"coherent", 0.5}}}};
}

nlohmann::json pits_lobe() {
    return {{"pits", {{"length_nm", 1350}, {"coherent", 0.5}}}};
}

diffraction::Material parsed(const nlohmann::json& material) {
    return diffraction::with_efficiencies(diffraction::parse_material(material, "the disc"), "the disc");
}

Json lobe_curve(const std::string& name, const nlohmann::json& lobe, double wavelength_nm) {
    const diffraction::LobeDensity density(parsed(pressed_disc(lobe)).grating.lobe, wavelength_nm);
    Json points = Json::array();
    for (int i = 0; i <= 400; ++i) {
        const double z = 1.2 * i / 400;
        points.push_back({z, density(z)});
    }
    return {{"name", name}, {"kind", "line"}, {"points", points}};
}

/// One probe's pictures: the disc with either lobe by the reference, and the sequence by `planar`.
struct ProbeResult {
    double change = 0.0;  ///< relative RMS by which the picture of the sequence differs from that of pits
    double median_delta_e = 0.0;
    double planar_error = 0.0;
    trade::RgbPicture picture;
};

ProbeResult measure(const lighting::ProbeImage& probe) {
    const trade::PictureFrames frames = trade::picture_frames(trade::far_camera(), kPictureWidth, kPictureHeight);
    // The map of a lobe serves flat surfaces: the disc without the sphere.
    const trade::FrameSet disc{.name = "disc", .surfaces = {frames.frames.surfaces.front()}};
    const auto points = all_frames(disc);
    const diffraction::PictureLayout layout{
        .width = frames.width,
        .height = frames.height,
        .pixels = {frames.pixels.begin(), frames.pixels.begin() + std::ssize(points)}};
    const colour::LightSpectra spectra;
    const auto reference = [&](const nlohmann::json& lobe) {
        return reference_radiance(parsed(pressed_disc(lobe)).grating, probe, spectra, points);
    };
    const std::vector<glm::dvec3> sequence = reference(sequence_lobe());
    const std::vector<glm::dvec3> pits = reference(pits_lobe());
    const diffraction::Method planar = diffraction::parse_method("planar");
    const diffraction::CookedMaterial cooked = cook(pressed_disc(sequence_lobe()), "the disc", planar);
    const diffraction::EvaluationLight light(probe, planar.key_lights, planar.window);
    const trade::MethodError change = trade::compare(sequence, pits);
    return {.change = change.relative_rms,
            .median_delta_e = change.median_delta_e,
            .planar_error = trade::compare(shaded(cooked, light, disc), sequence).relative_rms,
            .picture = trade::difference_image(picture(layout, sequence), picture(layout, pits), layout.width,
                                               layout.height, 3)};
}

}  // namespace

Json pit_sequence(const Inputs& inputs) {
    constexpr double kWavelength_nm = 550.0;
    Json rows = Json::array();
    Json pictures = Json::array();
    Json figures;
    for (const auto& [name, file, mapping] : {std::tuple("venice sunset", "venice_sunset_256.hdr", "auto"),
                                              std::tuple("ennis", "ennis_probulator.hdr", "auto")}) {
        const ProbeResult result = measure(trade::read_probe(inputs.data / "probes" / file, mapping));
        rows.push_back({name, digits(100.0 * result.change, 2) + " %", digits(result.median_delta_e, 2),
                        digits(100.0 * result.planar_error, 2) + " %"});
        pictures.push_back({{"caption", fmt::format("{}: the sequence, single pits, and their difference (ΔE2000, "
                                                    "yellow: {} or more), by the reference",
                                                    name, trade::kFullDifference)},
                            {"image", data_url(result.picture)}});
        figures[fmt::format("pit_sequence.change.{}", name)] = result.change;
        figures[fmt::format("pit_sequence.planar_error.{}", name)] = result.planar_error;
    }
    return {{"title", "A pressed disc's pits: one length, or a sequence"},
            {"text",
             {"Along its track a pressed disc is a row of pits. Stam's lobe (1999) takes pits of one length at random "
              "places. Sun, Fracchia, Drew & Calvert (2000), as Egholm & Christensen (2006) use them, take gratings of "
              "many spacings at once, 900 to 3300 nm in steps of 300: the lobe pit_sequence has peaks at mλ/b for "
              "each spacing b.",
              "Both discs have the pitch, relief, cover and metal of cd_pressed and half of their light in the middle "
              "peak; only the rest of the lobe differs. Nobody has published a photograph that decides between them "
              "here: the page shows by how much the choice matters."}},
            {"tables",
             {{{"caption", "The disc under a captured probe, relative RMS"},
               {"columns",
                {"probe", "the sequence against single pits", "the same, median ΔE2000",
                 "planar against the reference, of the sequence"}},
               {"rows", rows}}}},
            {"plots",
             {{{"caption", fmt::format("The lobe along the track at {:.0f} nm", kWavelength_nm)},
               {"x", {{"label", "s_h + v_h"}, {"from", 0.0}, {"to", 1.2}}},
               {"y", {{"label", "density D_h (its middle peak is cut off)"}, {"from", 0.0}, {"to", 2.0}}},
               {"series",
                {lobe_curve("sequence", sequence_lobe(), kWavelength_nm),
                 lobe_curve("single pits", pits_lobe(), kWavelength_nm)}}}}},
            {"pictures", pictures},
            {"figures", figures}};
}

}  // namespace rowland::evidence
