#include <fmt/format.h>

#include <algorithm>

#include "engine/core/log.h"
#include "engine/platform/gl_context.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "tests/evidence/peers/comparison.h"
#include "tests/evidence/peers/frame_costs.h"
#include "tests/evidence/peers/picture_grid.h"
#include "tests/evidence/peers/properties.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

constexpr double kLobe = 0.1;  ///< deviation of the second disc's groove lobe, in direction cosines

std::string frame_of(const Shown& row, const std::string& lights) {
    if (row.setting) return fmt::format("peer/{}/lights:{}", row.setting->peer->name, lights);
    if (row.name == "arc") return "arc/bands:8/rank:12";
    if (row.name == "arc_key_lights") return "arc/key-lights:16";
    return row.name == "direct" ? "direct/lights:" + lights : row.name;
}

/// A table of errors, and costs with so many lights.
Json error_table(const LightCase& light, const std::string& lights, const FrameCosts& costs, Json& figures) {
    Json rows = Json::array();
    for (const std::vector<Shown>* list : {&light.ours, &light.peers})
        for (const Shown& row : *list) {
            const std::string frame = frame_of(row, lights);
            rows.push_back({row.title, fmt::format("{:.4f}", row.error.relative_rms),
                            fmt::format("{:.1f}", row.error.median_delta_e),
                            fmt::format("{:.1f}", row.error.high_delta_e), fmt::format("{:.3f}", *row.error.flip),
                            FrameCosts::text(costs.time, frame), FrameCosts::text(costs.cycles, frame)});
            const std::string figure = fmt::format("peers.{}.{}.", light.name, row.name);
            figures[figure + "relative_rms"] = row.error.relative_rms;
            figures[figure + "median_delta_e"] = row.error.median_delta_e;
            figures[figure + "p95_delta_e"] = row.error.high_delta_e;
            figures[figure + "flip"] = *row.error.flip;
        }
    return {{"caption", fmt::format("{}: error against the reference, and cost with {} light{}", light.title, lights,
                                    lights == "1" ? "" : "s")},
            {"columns",
             {"", "relative RMS", "median ΔE2000", "95 % ΔE2000", "HDR-FLIP", "frame, × plain", "AMD cycles, × plain"}},
            {"rows", rows}};
}

std::string degrees(const std::optional<double>& value) {
    return value ? fmt::format("{:.1f}", *value) : "no peak";
}

/// The parameters that were chosen, as the peer's file names them.
std::string parameters_of(const PeerSetting& setting) {
    const std::string name = setting.peer->name;
    const glm::vec4& p = setting.parameters;
    if (name == "stam") return fmt::format("d {:.2f}", p.x);
    if (name == "zucconi") return fmt::format("d {:.0f} nm", p.x);
    if (name == "egholm") return fmt::format("a {:.0f} nm, width {:.3g}, C {:.2g}", p.x, p.y, p.w);
    if (name == "projected") return fmt::format("d {:.0f} nm, h {:.0f} nm", p.x, p.y);
    if (name == "three_lobes") return fmt::format("lean {:.2f}, α {:.2f} × {:.1f}", p.x, p.y, p.z);
    return fmt::format("{:.0f} nm, n {:.1f}, roughness {:.1f}, F0 {:.2g}", p.x, p.y, p.z, p.w);
}

std::string units(const PeerSetting& setting) {
    if (setting.orders == 0) return parameters_of(setting);
    return fmt::format("{}, {} order{}", parameters_of(setting), setting.orders, setting.orders == 1 ? "" : "s");
}

Json property_table(const LightCase& fitted, const FrameCosts& costs, Json& figures) {
    Json rows = Json::array();
    const DirectionError ours = direction_error_of_direct();
    rows.push_back({"ours: direct", "–", degrees(ours.across), degrees(ours.along),
                    fmt::format("{:.2f}", returned_by_disc()), FrameCosts::text(costs.time, "direct/lights:16"),
                    FrameCosts::text(costs.cycles, "direct/lights:16")});
    if (ours.across) figures["peers.direction_error_deg.direct"] = *ours.across;
    if (ours.along) figures["peers.direction_error_along_deg.direct"] = *ours.along;
    figures["peers.energy.direct"] = returned_by_disc();
    for (std::size_t i = 0; i < subjects().size(); ++i) {
        const Subject& subject = subjects()[i];
        const PeerSetting& setting = *fitted.peers[i].setting;
        const DirectionError error = direction_error(setting);
        const ReturnedEnergy energy = returned_energy(subject.published);
        const std::string frame = fmt::format("peer/{}/lights:16", setting.peer->name);
        rows.push_back({subject.title, units(setting), degrees(error.across), degrees(error.along),
                        fmt::format("{:.2f} – {:.2f}{}", energy.least, energy.most,
                                    energy.most > 1.0 ? ", more than arrives" : ""),
                        FrameCosts::text(costs.time, frame), FrameCosts::text(costs.cycles, frame)});
        if (error.across) figures["peers.direction_error_deg." + subject.name] = *error.across;
        if (error.along) figures["peers.direction_error_along_deg." + subject.name] = *error.along;
        figures["peers.energy." + subject.name] = energy.most;
        const auto cycles = costs.cycles.find(frame);
        if (cycles != costs.cycles.end()) figures["peers.cycles_16_lights." + subject.name] = cycles->second;
        const auto time = costs.time.find(frame);
        if (time != costs.time.end()) figures["peers.time_16_lights." + subject.name] = time->second;
    }
    return {{"caption",
             "Settings by search under the lamp; error of the first order's direction (light at 0, 30, 60° across the "
             "grooves; light at 45° along them); white light returned, in the units as published, views at 0, 30, 60°"},
            {"columns",
             {"", "settings", "across, degrees", "along, degrees", "energy returned", "frame with 16 lights, × plain",
              "AMD cycles with 16 lights, × plain"}},
            {"rows", rows}};
}

Json case_picture(const LightCase& light, const trade::PictureFrames& frames, int columns) {
    const float stops = diffraction::exposure_for(light.reference);
    std::vector<std::vector<glm::vec3>> panels{panel(frames, light.reference, stops)};
    std::string names = "reference";
    for (const std::vector<Shown>* list : {&light.ours, &light.peers})
        for (const Shown& row : *list) {
            panels.push_back(panel(frames, row.xyz, stops));
            names += "; " + row.title;
        }
    return {{"caption", fmt::format("{}. Row by row: {}.", light.title, names)},
            {"image", panel_grid(frames, panels, columns)}};
}

/// Each peer by itself, before anything is fitted: published parameters, with its highlight, one lamp.
Json known_picture(const trade::PictureFrames& frames, PointPass& pass) {
    render::DistantLight light{glm::vec3(lamp().direction), glm::vec3(3.14159265F)};  // shows a white card as 1
    std::vector<std::vector<glm::vec3>> panels;
    std::string names;
    for (const Peer& peer : peers_of_discs()) {
        const PeerSetting setting{&peer, peer.published, true};
        const std::vector<glm::dvec3> rgb = pass.draw(setting, std::span(&light, 1));
        const std::string name = peer.name;
        if (name == "stam" || name == "zucconi") {
            panels.push_back(raw_panel(frames, rgb));
        } else {
            const std::vector<glm::dvec3> xyz = xyz_of(rgb);
            panels.push_back(panel(frames, xyz, diffraction::exposure_for(xyz)));
        }
        names += std::string(names.empty() ? "" : "; ") + peer.title;
    }
    return {{"caption",
             fmt::format("Each peer by itself: its published parameters, order 0 and highlight included, one lamp. "
                         "Stam's and Zucconi's numbers go to the screen as their shaders write them. Row by row: {}.",
                         names)},
            {"image", panel_grid(frames, panels, 3)}};
}

/// The row of the least relative RMS.
const Shown& closest(const std::vector<Shown>& rows) {
    return *std::min_element(rows.begin(), rows.end(), [](const Shown& a, const Shown& b) {
        return a.error.relative_rms < b.error.relative_rms;
    });
}

std::string percent(double value) {
    return digits(100.0 * value, 2) + " %";
}

/// The closest peer under a probe, and which rows of ours it leaves behind.
std::string probe_sentence(const LightCase& light) {
    const Shown& peer = closest(light.peers);
    std::string behind;
    for (const Shown& row : light.ours)
        if (row.error.relative_rms > peer.error.relative_rms)
            behind += fmt::format("{}{} ({})", behind.empty() ? "" : ", ", row.title, percent(row.error.relative_rms));
    const Shown& ours = closest(light.ours);
    return fmt::format("{}: {} is {} off, the closest peer ({}) {}.{}", light.title, ours.title,
                       percent(ours.error.relative_rms), peer.title, percent(peer.error.relative_rms),
                       behind.empty() ? "" : " That peer is closer than " + behind + ".");
}

/// "A (1.2), B (1.3)": peers whose frame costs less than that of `ours` by more than measurements scatter.
std::string cheaper_peers(const std::map<std::string, double>& values, const std::string& ours,
                          const std::string& lights) {
    constexpr double kScatter = 0.05;
    std::string names;
    const auto limit = values.find(ours);
    if (limit == values.end()) return "not measured";
    for (const Peer& peer : peers_of_discs()) {
        const auto found = values.find(fmt::format("peer/{}/lights:{}", peer.name, lights));
        if (found == values.end() || found->second >= (1.0 - kScatter) * limit->second) continue;
        names += fmt::format("{}{} ({:.2f})", names.empty() ? "" : ", ", peer.title, found->second);
    }
    return names.empty() ? "none" : names;
}

Json paragraphs(const LightCase& one_lamp, const LightCase& with_lobe, const LightCase& grace, const LightCase& ennis,
                const FrameCosts& costs, std::size_t points) {
    const auto row = [](const LightCase& light, const std::string& name) -> const Shown& {
        return *std::find_if(light.peers.begin(), light.peers.end(),
                             [&](const Shown& shown) { return shown.name == name; });
    };
    const Shown& lamp_peer = closest(one_lamp.peers);
    const Shown& lobe_peer = closest(with_lobe.peers);
    Json text = Json::array();
    text.push_back(
        "Six shaders that others use for discs, each written from its published formula, beside our methods, on one "
        "disc: bare aluminium, slits of 800 nm every 1600 nm (content/materials/cd_paper.json). Each peer gets its "
        "best units: the parameters of the least error under the lamp, and one exposure per picture. Order 0, "
        "highlights and diffuse terms are left out on both sides.");
    text.push_back(
        fmt::format("One lamp is the fair case: every peer takes it. The closest peer is {}, {} off; ours, which looks "
                    "up the same lamp in a table of the grating's colours, {}. On a disc with a lobe of {} along the "
                    "grooves, fairer to peers that have one, the closest is {}, {} off; ours {}.",
                    lamp_peer.title, percent(lamp_peer.error.relative_rms),
                    percent(one_lamp.ours.front().error.relative_rms), kLobe, lobe_peer.title,
                    percent(lobe_peer.error.relative_rms), percent(with_lobe.ours.front().error.relative_rms)));
    text.push_back(fmt::format(
        "Two of them turn the colours by 90°. GPU Gems says that T is the direction of a disc's tracks, and Zucconi "
        "takes the same T; the path difference needs T across the tracks. Zucconi also subtracts the two cosines, "
        "although both directions point away from the surface; the grating equation adds them. Turned across and cut "
        "to the disc's own orders, Stam's error falls from {} to {}; repaired and cut, Zucconi's from {} to {}. What "
        "remains is colour: parabolas in place of the eye's response, no efficiency, no cosine.",
        percent(row(one_lamp, "stam").error.relative_rms), percent(row(one_lamp, "stam_across").error.relative_rms),
        percent(row(one_lamp, "zucconi").error.relative_rms),
        percent(row(one_lamp, "zucconi_repaired").error.relative_rms)));
    const DirectionError projected =
        direction_error({.peer = &peer_named("projected"), .parameters = peer_named("projected").published});
    if (projected.across && projected.along)
        text.push_back(
            fmt::format("Projected angles, at the true pitch: the first order is {:.1f}° off while light and eye are "
                        "in the plane across the grooves, and {:.1f}° with the light at 45° along them. The search "
                        "trades one for the other by a wrong pitch. Three lobes: a normal that leans is no grating "
                        "equation, so the order moves with the light. A thin film has no order at all.",
                        *projected.across, *projected.along));
    text.push_back("Probes: peers get 16 lamps fitted to the probe, ours the whole probe. " + probe_sentence(grace) +
                   " " + probe_sentence(ennis) +
                   " Our own formula under the same 16 lamps is far off as well: what the peers lack here is the "
                   "light, not only the formula.");
    text.push_back(fmt::format(
        "Cost. Frames cheaper than ours by more than 5 %, in × plain: with one lamp (direct {}) {}; with 16 (direct "
        "{}) {}. The whole probe by planar costs {}. By AMD's compiler: with one lamp (direct {}) {}; with 16 (direct "
        "{}) {}.",
        FrameCosts::text(costs.time, "direct/lights:1"), cheaper_peers(costs.time, "direct/lights:1", "1"),
        FrameCosts::text(costs.time, "direct/lights:16"), cheaper_peers(costs.time, "direct/lights:16", "16"),
        FrameCosts::text(costs.time, "planar"), FrameCosts::text(costs.cycles, "direct/lights:1"),
        cheaper_peers(costs.cycles, "direct/lights:1", "1"), FrameCosts::text(costs.cycles, "direct/lights:16"),
        cheaper_peers(costs.cycles, "direct/lights:16", "16")));
    text.push_back(
        fmt::format("Conditions: {} points; the reference is the arc integral per nanometre, the lamp a lobe of a "
                    "quarter of a degree (standard deviation), Grace resampled to 512 × 256 texels. Under the lamp "
                    "most of the disc is black in the reference, so its median ΔE says little: read the 95th "
                    "percentile. Frames: {}, 480 × 270, time of all threads. Cycles: {}, fragment stage.",
                    points, costs.renderer, costs.missing.empty() ? costs.gpu : costs.missing));
    text.push_back(
        "Ours where a source has no number: the constants of Egholm & Christensen's combs and its mirror; the spread "
        "along the grooves of the path tracer, which samples single directions; all of the three lobes. Their energies "
        "are therefore of our units. A lamp of strength 1 shows a white card as 1 in Stam's, Zucconi's and Egholm's "
        "units.");
    return text;
}

}  // namespace

Json peers(const Inputs& inputs) {
    const platform::HeadlessContext context({.debug = false});
    const trade::PictureFrames frames = disc_picture();
    PointPass pass(frames.frames.surfaces.front());
    const std::filesystem::path probes = inputs.data / "probes";
    const LightCase one_lamp = lamp_case("lamp", {}, frames, pass);
    const LightCase with_lobe = lamp_case("lamp_lobe", kLobe, frames, pass);
    const LightCase grace =
        probe_case("grace", "Grace cathedral", probes / "grace_probe.hdr", "angular", one_lamp, frames, pass);
    const LightCase ennis =
        probe_case("ennis", "Ennis house", probes / "ennis_probulator.hdr", "equirect", one_lamp, frames, pass);
    log_info("measuring frames");
    const FrameCosts costs = measure_frame_costs();

    Json figures = Json::object();
    Json tables = Json::array();
    tables.push_back(error_table(one_lamp, "1", costs, figures));
    tables.push_back(error_table(with_lobe, "1", costs, figures));
    tables.push_back(error_table(grace, "16", costs, figures));
    tables.push_back(error_table(ennis, "16", costs, figures));
    tables.push_back(property_table(one_lamp, costs, figures));
    Json pictures = Json::array();
    pictures.push_back(known_picture(frames, pass));
    pictures.push_back(case_picture(one_lamp, frames, 5));
    pictures.push_back(case_picture(with_lobe, frames, 5));
    pictures.push_back(case_picture(grace, frames, 5));
    pictures.push_back(case_picture(ennis, frames, 5));
    return {{"title", "What others would use, on the same disc"},
            {"text", paragraphs(one_lamp, with_lobe, grace, ennis, costs, frames.pixels.size())},
            {"tables", tables},
            {"pictures", pictures},
            {"figures", figures}};
}

}  // namespace rowland::evidence
