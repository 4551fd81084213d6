#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rowland::benchmark {

/// A representation with the settings that are timed.
struct TimedRepresentation {
    std::string name;
    nlohmann::json quality;  ///< as in the material file
    /// Whether key lights may stay in the probe, for harmonics or maps. Harmonics include directional lights; the
    /// other representations shade them one by one.
    bool folds_lights = false;
    nlohmann::json groove_lobe = "flat";
};

std::vector<TimedRepresentation> timed_representations();

/// The compact disc's material file, drawn as `quality` says.
nlohmann::json cd_material(const nlohmann::json& quality, const nlohmann::json& groove_lobe = "flat");
/// Crossed foil's material file.
nlohmann::json lattice_material(const nlohmann::json& quality);
/// The disc's with a solved relief: its efficiencies depend on the view.
nlohmann::json rigorous_material(const nlohmann::json& quality);
nlohmann::json material_of(const TimedRepresentation& representation);

}  // namespace rowland::benchmark
