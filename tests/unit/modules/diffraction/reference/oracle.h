#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/grating.h"
#include "tests/support/csv.h"

namespace rowland::diffraction::test {

/// One grating of an oracle file, with the frames it was evaluated at and the XYZ it should give.
struct OracleCase {
    std::string name;
    Grating grating;
    std::vector<ShadingPoint> frames;
    std::vector<glm::dvec3> xyz;
};

/// Frames of columns vx … gz.
std::vector<ShadingPoint> read_frames(const rowland::test::Csv& table);
std::vector<glm::dvec3> read_xyz(const rowland::test::Csv& table);

/// The cases of radiance_bandlimited.csv and radiance_venice_sunset_256.csv.
std::vector<OracleCase> read_cases(const std::filesystem::path& path);

/// The SH light of a table `l,m,r,g,b`.
lighting::ShLight read_sh_light(const std::filesystem::path& path);

/// PHYSICS §1: √(Σ‖XYZ − ref‖² / Σ‖ref‖²).
double relative_rms(const std::vector<glm::dvec3>& found, const std::vector<glm::dvec3>& expected);

}  // namespace rowland::diffraction::test
