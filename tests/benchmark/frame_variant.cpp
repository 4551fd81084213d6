#include "tests/benchmark/frame_variant.h"

#include <fnmatch.h>

#include <set>

#include "engine/core/error.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/evidence/peers/peer_material.h"

namespace rowland::benchmark {

namespace {

using nlohmann::json;

constexpr int kLampCounts[] = {1, 4, 16, 64};

/// The representation's surface in `lighting`.
FrameVariant grating(const TimedRepresentation& drawn, const std::string& suffix, const std::string& baseline,
                     Lighting lighting = Lighting::Studio) {
    TimedRepresentation timed = drawn;
    if (drawn.folds_lights) timed.quality["key_lights"] = lighting == Lighting::StudioKeyLights;
    FrameVariant variant;
    variant.name = drawn.name + suffix;
    variant.baseline = baseline;
    variant.shader = Shader::Grating;
    variant.material = material_of(timed);
    variant.lighting = lighting;
    return variant;
}

FrameVariant with(FrameVariant variant, const std::string& suffix, bool FrameVariant::*feature) {
    variant.name += suffix;
    variant.*feature = true;
    return variant;
}

FrameVariant with_effect(FrameVariant variant, const std::string& suffix, Effect effect) {
    variant.name += suffix;
    variant.effect = effect;
    return variant;
}

FrameVariant with_lamps(FrameVariant variant, int lamps) {
    variant.name += std::to_string(lamps);
    variant.baseline += "1";
    variant.lamps = lamps;
    return variant;
}

FrameVariant engine_surface(const std::string& name, Shader shader, Lighting lighting = Lighting::Studio) {
    FrameVariant variant;
    variant.name = name;
    variant.baseline = "plain";
    variant.shader = shader;
    variant.lighting = lighting;
    return variant;
}

void add_plain(std::vector<FrameVariant>& variants) {
    variants.push_back(engine_surface("plain", Shader::Plain));
    variants.push_back(engine_surface("unlit", Shader::Unlit));
    variants.push_back(engine_surface("plain/key-lights:16", Shader::Plain, Lighting::StudioKeyLights));
    const FrameVariant plain = engine_surface("plain", Shader::Plain);
    const FrameVariant shadow = with(plain, "/shadow", &FrameVariant::shadow);
    variants.push_back(shadow);
    variants.push_back(with_effect(plain, "/ambient-occlusion", Effect::AmbientOcclusion));
    variants.push_back(with(plain, "/worn", &FrameVariant::worn));
    variants.push_back(with(plain, "/in-box", &FrameVariant::in_box));
    variants.push_back(with(plain, "/between-boxes", &FrameVariant::between_boxes));
    variants.push_back(with(plain, "/instance", &FrameVariant::instance));
    variants.push_back(with_effect(shadow, "/ambient-occlusion", Effect::AmbientOcclusion));
    FrameVariant film = engine_surface("film", Shader::Film);
    film.material = {{"film", {{"ior", 1.33}, {"thickness_nm", 400}}}, {"base", {{"ior", 1.5}}}, {"roughness", 0.3}};
    variants.push_back(film);
    variants.push_back(with(film, "/thickness-map", &FrameVariant::thickness_map));
    variants.push_back(with_effect(film, "/rough-reflections", Effect::RoughReflection));
    variants.push_back(with_effect(shadow, "/soft", Effect::SoftShadow));
    variants.push_back(with_effect(plain, "/local-reflection", Effect::LocalReflection));
    variants.push_back(with_effect(plain, "/rough-reflections", Effect::RoughReflection));
}

void add_representation(const TimedRepresentation& drawn, std::vector<FrameVariant>& variants) {
    variants.push_back(grating(drawn, "", "plain"));
    if (drawn.name == "streak") return;             // it reads key lights in the probe
    if (drawn.name.starts_with("planar/")) return;  // otherwise as planar
    variants.push_back(grating(drawn, "/key-lights:16", "plain", Lighting::StudioKeyLights));
    TimedRepresentation at_vertices = drawn;
    at_vertices.quality["lights_at"] = "vertices";
    variants.push_back(grating(at_vertices, "/key-lights:16/lights-at-vertices", "plain", Lighting::StudioKeyLights));
    if (drawn.name != "planar" && drawn.name != "circle") return;
    variants.push_back(grating(at_vertices, "/lights-at-vertices", "plain"));
    at_vertices.quality["map_at"] = "vertices";
    variants.push_back(grating(at_vertices, "/at-vertices", "plain"));
    variants.push_back(grating(at_vertices, "/key-lights:16/at-vertices", "plain", Lighting::StudioKeyLights));
}

void add_lamps_in_probe(const TimedRepresentation& drawn, std::vector<FrameVariant>& variants) {
    const std::string suffix = "/lights-in-probe:";
    for (const int lamps : kLampCounts)
        variants.push_back(with_lamps(grating(drawn, suffix, drawn.name + suffix, Lighting::LampsInProbe), lamps));
}

void add_lamps_in_scene(const TimedRepresentation& direct, std::vector<FrameVariant>& variants) {
    for (const int lamps : kLampCounts) {
        variants.push_back(with_lamps(engine_surface("plain/lights:", Shader::Plain, Lighting::LampsInScene), lamps));
        variants.back().baseline = "plain/lights:1";
        variants.push_back(with_lamps(grating(direct, "/lights:", "direct/lights:", Lighting::LampsInScene), lamps));
        variants.push_back(
            with_lamps(engine_surface("light-loop/lights:", Shader::LightLoop, Lighting::LampsInScene), lamps));
        variants.back().baseline = "light-loop/lights:1";
    }
}

/// Another grating under the lights of grooves of one spectrum: of a lattice they take one look-up each as well, or
/// three for key lights, of efficiencies that depend on the view one in a volume.
void add_under_lights(const std::string& name, const json& material, const TimedRepresentation& direct,
                      std::vector<FrameVariant>& variants) {
    const auto add = [&](FrameVariant variant) {
        variant.name.replace(0, direct.name.size(), name);
        variant.material = material;
        variants.push_back(variant);
    };
    add(grating(direct, "/key-lights:16", "plain", Lighting::StudioKeyLights));
    for (const int lamps : {1, 16})
        add(with_lamps(grating(direct, "/lights:", "direct/lights:", Lighting::LampsInScene), lamps));
}

void add_peers(std::vector<FrameVariant>& variants) {
    for (const evidence::Peer& peer : evidence::peers_of_discs())
        for (const int lamps : {1, 16}) {
            const std::string name = std::string("peer/") + peer.name + "/lights:" + std::to_string(lamps);
            variants.push_back(engine_surface(name, Shader::Peer, Lighting::LampsInScene));
            variants.back().peer = peer.name;
            variants.back().lamps = lamps;
        }
}

bool matches(const std::string& pattern, const std::string& name) {
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace

std::vector<FrameVariant> all_variants() {
    std::vector<FrameVariant> variants;
    add_plain(variants);
    for (const TimedRepresentation& drawn : timed_representations()) {
        add_representation(drawn, variants);
        if (drawn.name == "arc" || drawn.name == "direct")
            variants.push_back(with(grating(drawn, "", "plain"), "/groove-map", &FrameVariant::groove_map));
        if (drawn.name == "arc") variants.push_back(with(grating(drawn, "", "plain"), "/worn", &FrameVariant::worn));
        if (drawn.name == "arc" || drawn.name == "planar") {
            variants.push_back(with(grating(drawn, "", drawn.name), "/in-box", &FrameVariant::in_box));
            variants.push_back(with(grating(drawn, "", drawn.name), "/between-boxes", &FrameVariant::between_boxes));
        }
        if (drawn.name == "planar")
            variants.push_back(with(grating(drawn, "", drawn.name), "/instance", &FrameVariant::instance));
        if (drawn.name == "arc" || drawn.name == "planar" || drawn.name == "direct")
            variants.push_back(with(grating(drawn, "", "plain"), "/shadow", &FrameVariant::shadow));
        if (drawn.name == "direct")
            variants.push_back(with(grating(drawn, "", "plain"), "/mean-colour", &FrameVariant::mean_colour));
        if (drawn.name == "planar/pits") {
            variants.push_back(grating(drawn, "/cover", "plain"));
            variants.back().material["cover"] = {{"ior", 1.58}};
        }
        // By harmonics and by maps, which cost nothing per lamp.
        if (drawn.name == "spikes" || drawn.name == "planar") add_lamps_in_probe(drawn, variants);
        if (drawn.name == "direct") {
            add_lamps_in_scene(drawn, variants);
            add_under_lights("lattice", lattice_material(drawn.quality), drawn, variants);
            add_under_lights("rigorous", rigorous_material(drawn.quality), drawn, variants);
        }
    }
    variants.push_back(
        grating({"arc", {{"representation", "arc"}, {"bands", 8}, {"rank", 12}}, true}, "/bands:8/rank:12", "plain"));
    add_peers(variants);
    return variants;
}

std::vector<FrameVariant> choose_variants(const std::vector<std::string>& patterns) {
    std::vector<FrameVariant> variants = all_variants();
    if (patterns.empty()) return variants;
    std::set<std::string> chosen;
    for (const std::string& pattern : patterns) {
        bool found = false;
        for (const FrameVariant& variant : variants) {
            if (!matches(pattern, variant.name)) continue;
            found = true;
            chosen.insert({variant.name, variant.baseline});
        }
        if (!found)
            refuse_input("", "--only", pattern, "the name of a variant, or a pattern such as 'arc*'",
                         "--list prints the names");
    }
    std::erase_if(variants, [&](const FrameVariant& variant) { return chosen.count(variant.name) == 0; });
    return variants;
}

}  // namespace rowland::benchmark
