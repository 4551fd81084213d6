#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/frame.h"

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
    std::optional<int> resolution;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;

 private:
    void check_usage() const;
    lighting::ShLight bandlimited_light(int bands_wanted) const;
    std::vector<glm::dvec3> by_reference(const colour::LightSpectra& spectra,
                                         const std::vector<diffraction::Frame>& points) const;
    std::vector<glm::dvec3> by_spikes(const colour::LightSpectra& spectra,
                                      const std::vector<diffraction::Frame>& points) const;
    std::vector<glm::dvec3> by_cooked_asset(const colour::LightSpectra& spectra,
                                            const std::vector<diffraction::Frame>& points) const;
};

}  // namespace rowland::trade
