#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/asset/method.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace CLI {
class App;
}

namespace rowland::trade {

/// `rowland-trade evaluate`: XYZ of a material's diffraction term at given frames, by any method, on standard output.
struct EvaluateCommand {
    std::optional<std::filesystem::path> material;
    std::optional<std::filesystem::path> cooked;
    std::optional<std::filesystem::path> probe;
    std::optional<std::filesystem::path> probe_sh;
    std::optional<std::filesystem::path> illuminant;
    std::filesystem::path frames;
    std::string mapping = "auto";
    std::string method;
    /// Settings of the method, as its text would have them after a slash.
    std::map<std::string, std::string> settings;
    bool error = false;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;

 private:
    void check_usage() const;
    void run_film() const;
    diffraction::Method asked_method() const;
    diffraction::EvaluationLight light(int key_lights, math::SphericalWindow window) const;
    std::vector<diffraction::CheckedRadiance> by_reference(const colour::LightSpectra& spectra,
                                                           const std::vector<diffraction::ShadingPoint>& points) const;
    std::vector<glm::dvec3> by_representation(const colour::Illuminant& illuminant,
                                              const std::vector<diffraction::ShadingPoint>& points) const;
};

}  // namespace rowland::trade
