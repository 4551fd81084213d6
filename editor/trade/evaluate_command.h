#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/asset/representation.h"
#include "modules/diffraction/evaluate/evaluation_light.h"
#include "modules/diffraction/model/frame.h"
#include "modules/diffraction/reference/reference.h"

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
    std::string mapping = "equirect";
    std::string method;
    std::string window = "none";
    std::string storage = "unorm16";
    std::optional<int> bands;
    int spikes = 4;
    int bins = 16;
    int rank = 8;
    std::optional<int> key_lights;
    std::optional<int> resolution;
    bool error = false;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;

 private:
    void check_usage() const;
    diffraction::EvaluationLight light(int usual_key_lights) const;
    diffraction::Representation representation(const colour::LightSpectra& spectra) const;
    std::vector<glm::dvec3> by_reference(const colour::LightSpectra& spectra,
                                         const std::vector<diffraction::Frame>& points) const;
    std::vector<diffraction::CheckedRadiance> by_checked_reference(const colour::LightSpectra& spectra,
                                                                   const std::vector<diffraction::Frame>& points) const;
    std::vector<glm::dvec3> by_representation(const colour::LightSpectra& spectra,
                                              const std::vector<diffraction::Frame>& points) const;
};

}  // namespace rowland::trade
