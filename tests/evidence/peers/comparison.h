#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/trade/inputs.h"
#include "editor/trade/measure_error.h"
#include "engine/lighting/key_lights.h"
#include "tests/evidence/peers/point_pass.h"

namespace rowland::evidence {

/// A row of the tables: a peer, as published or repaired, and the settings that its search chooses from.
struct Subject {
    std::string name;  ///< in figures
    std::string title;
    PeerSetting published;
    std::vector<glm::vec4> candidates;
    std::vector<int> orders{0};  ///< likewise: PeerSetting::orders
};
const std::vector<Subject>& subjects();

/// A picture of the disc alone, 80 × 60 pixels, grooves around its centre.
trade::PictureFrames disc_picture();

/// The lamp of the fair case: white, of irradiance 1, a von Mises–Fisher lobe whose directions deviate by a quarter of
/// a degree on each axis.
lighting::KeyLight lamp();

/// One method's picture against the reference.
struct Shown {
    std::string name;
    std::string title;
    std::vector<glm::dvec3> xyz;  ///< exposed, one value per point
    double exposure = 1.0;
    trade::MethodError error{};
    std::optional<PeerSetting> setting{};  ///< of a peer
};

/// A light, what the disc shows under it, and what each method makes of it.
struct LightCase {
    std::string name;
    std::string title;
    std::vector<glm::dvec3> reference;
    std::vector<Shown> ours;
    std::vector<Shown> peers;  ///< as subjects()
};

/// The lamp; the settings of the peers are those of the least error. `sigma`: of the disc's groove lobe; none: flat.
LightCase lamp_case(const std::string& name, std::optional<double> sigma, const trade::PictureFrames& frames,
                    PointPass& pass);
/// A probe on the flat disc: 16 lamps for the peers in the settings of `fitted`, the whole probe for ours.
LightCase probe_case(const std::string& name, const std::string& title, const std::filesystem::path& file,
                     const std::string& mapping, const LightCase& fitted, const trade::PictureFrames& frames,
                     PointPass& pass);

/// Luminance that the flat disc's orders return of white light: the sum of their efficiencies.
double returned_by_disc();

/// XYZ of the flat disc by `direct` under a distant light of irradiance 1.
std::vector<glm::dvec3> disc_by_direct(std::span<const diffraction::ShadingPoint> points, const glm::dvec3& light);

}  // namespace rowland::evidence
