#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "editor/trade/inputs.h"
#include "editor/trade/measure_error.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

constexpr int kPictureWidth = 150;
constexpr int kPictureHeight = 110;

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

diffraction::CookedMaterial planar(const nlohmann::json& lobe) {
    return cook(pressed_disc(lobe), "the disc", diffraction::parse_method("planar"));
}

/// The disc, larger in the picture than in that of errors.
trade::PictureFrames bare_disc() {
    scene::Camera camera = trade::far_camera();
    camera.vertical_field_of_view = 0.42F;
    return trade::disc_frames(camera, kPictureWidth, kPictureHeight);
}

/// Under one probe.
struct ProbeResult {
    double change = 0.0;  ///< relative RMS of the sequence from single pits, both by the reference
    double median_delta_e = 0.0;
    double planar_error = 0.0;  ///< of the sequence
    trade::RgbPicture picture;  ///< by `planar`
};

ProbeResult measure(const lighting::ProbeImage& probe, const diffraction::CookedMaterial& sequence,
                    const diffraction::CookedMaterial& pits) {
    const trade::FrameSet measured = trade::tilted_cd_frames();
    const colour::LightSpectra spectra;
    const auto reference = [&](const diffraction::CookedMaterial& disc) {
        return reference_radiance(disc.material.grating, probe, spectra, all_frames(measured));
    };
    const std::vector<glm::dvec3> exact = reference(sequence);
    const trade::MethodError change = trade::compare(exact, reference(pits));
    const diffraction::EvaluationLight light(probe, 0, math::SphericalWindow::None);
    const trade::PictureFrames frames = bare_disc();
    const auto drawn = [&](const diffraction::CookedMaterial& disc) {
        return picture(frames, shaded(disc, light, frames.frames));
    };
    return {.change = change.relative_rms,
            .median_delta_e = change.median_delta_e,
            .planar_error = trade::compare(shaded(sequence, light, measured), exact).relative_rms,
            .picture = trade::difference_image(drawn(sequence), drawn(pits), frames.width, frames.height, 2)};
}

}  // namespace

Json pit_sequence(const Inputs& inputs) {
    constexpr double kWavelength_nm = 550.0;
    const diffraction::CookedMaterial sequence = planar(sequence_lobe());
    const diffraction::CookedMaterial pits = planar(pits_lobe());
    Json rows = Json::array();
    Json pictures = Json::array();
    Json figures;
    for (const auto& [name, file, mapping] : {std::tuple("venice sunset", "venice_sunset_256.hdr", "auto"),
                                              std::tuple("ennis", "ennis_probulator.hdr", "auto")}) {
        const ProbeResult result = measure(trade::read_probe(inputs.data / "probes" / file, mapping), sequence, pits);
        rows.push_back({name, digits(100.0 * result.change, 2) + " %", digits(result.median_delta_e, 2),
                        digits(100.0 * result.planar_error, 2) + " %"});
        pictures.push_back({{"caption", fmt::format("{}: the sequence, single pits, and their difference (ΔE2000, "
                                                    "yellow: {} or more), by planar",
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
             {{{"caption", "120 views of a tilted disc under a captured probe, relative RMS"},
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
