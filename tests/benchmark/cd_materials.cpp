#include "tests/benchmark/cd_materials.h"

namespace rowland::benchmark {

std::vector<TimedRepresentation> timed_representations() {
    return {
        {"spikes", {{"representation", "spikes"}, {"bands", 5}, {"spikes", 4}}, true},
        {"arc", {{"representation", "arc"}, {"bands", 5}, {"rank", 8}}, true},
        {"planar", {{"representation", "planar"}, {"map_resolution", 128}}, true},
        {"planar/sigma", {{"representation", "planar"}, {"map_resolution", 128}}, true, {{"sigma", 0.05}}},
        {"planar/pits",
         {{"representation", "planar"}, {"map_resolution", 128}},
         true,
         {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}}},
        {"circle", {{"representation", "circle"}, {"map_resolution", 104}}, true},
        {"streak", {{"representation", "streak"}}, false, {{"sigma", 0.05}}},
        {"direct", {{"representation", "direct"}}},
    };
}

nlohmann::json cd_material(const nlohmann::json& quality, const nlohmann::json& groove_lobe) {
    return {{"grating",
             {{"pitch_nm", 1600},
              {"profile", {{"type", "slit"}, {"width_nm", 800}}},
              {"orders", {-2, -1, 1, 2}},
              {"groove_lobe", groove_lobe}}},
            {"metal", "Al"},
            {"base", {{"color", {0.02, 0.02, 0.02}}, {"roughness", 0.3}}},
            {"quality", quality}};
}

nlohmann::json lattice_material(const nlohmann::json& quality) {
    const nlohmann::json grooves = {{"type", "sinusoidal"}, {"depth_nm", 110}};
    nlohmann::json material = cd_material(quality);
    material["grating"] = {{"lattice", {{"a_nm", {1000, 0}}, {"b_nm", {0, 1000}}}},
                           {"profile", {{"type", "crossed"}, {"along_a", grooves}, {"along_b", grooves}}},
                           {"orders", 2}};
    return material;
}

nlohmann::json rigorous_material(const nlohmann::json& quality) {
    nlohmann::json material = cd_material(quality);
    material["grating"]["profile"] = {{"type", "lamellar"}, {"duty", 0.5}, {"depth_nm", 120}};
    material["grating"]["theory"] = "rigorous";
    return material;
}

nlohmann::json material_of(const TimedRepresentation& representation) {
    return cd_material(representation.quality, representation.groove_lobe);
}

}  // namespace rowland::benchmark
