#pragma once

#include "engine/image/image.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

/// What the tests of maps measure: a map of the probe less its key lights, and the key lights by `direct`.
namespace rowland::diffraction::test {

struct OracleProbe {
    const char* name;
    const char* file;
    lighting::Mapping mapping;
    double tolerance;
};

/// A sample of radiance 1 in each texel of a cube map.
inline lighting::LightSamples even_light(int face_size) {
    lighting::LightSamples samples;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < face_size; ++row)
            for (int column = 0; column < face_size; ++column)
                samples.push_back(glm::normalize(lighting::cube_direction(face, (2 * column + 1.0) / face_size - 1.0,
                                                                          (2 * row + 1.0) / face_size - 1.0)),
                                  glm::dvec3(lighting::cube_solid_angle(face_size, column, row)));
    return samples;
}

/// A probe in two parts.
struct SplitProbe {
    std::vector<lighting::KeyLight> keys;
    lighting::LightSamples texels;
};

inline SplitProbe split(const std::filesystem::path& path, lighting::Mapping mapping, int count) {
    const lighting::ProbeImage probe(image::load_image(path), mapping, path.string());
    std::vector<lighting::KeyLight> keys = lighting::fit_key_lights(probe, count);
    lighting::LightSamples texels = lighting::light_samples(probe, keys);
    return {std::move(keys), std::move(texels)};
}

/// All of a frame set's light: sample(map, frame) + key lights.
template <typename Map>
std::vector<glm::dvec3> radiance(const Map& map, const KernelTable& kernel, const std::vector<lighting::KeyLight>& keys,
                                 const std::vector<ShadingPoint>& frames) {
    std::vector<glm::dvec3> xyz;
    for (const ShadingPoint& frame : frames)
        xyz.push_back(sample(map, frame) + direct_radiance(kernel, {compact_disc().pitch_nm},
                                                           std::span<const lighting::KeyLight>(keys), frame));
    return xyz;
}

/// Expects the oracle's radiance at a frame set of the map that fill(texels, kernel, normal) gives and 16 key lights.
template <typename Fill>
void matches_oracle(const OracleProbe& probe, const std::string& frame_set, const Fill& fill) {
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_" + frame_set + ".csv");
    ROWLAND_TEST_DATA(oracle_path, "oracle/radiance_" + frame_set + "_" + probe.name + ".csv");
    ROWLAND_TEST_DATA(probe_path, std::string("probes/") + probe.file);
    const auto frames = read_frames(rowland::test::read_csv(frames_path));
    const SplitProbe light = split(probe_path, probe.mapping, 16);
    const KernelTable kernel = tabulate(ColourKernel(compact_disc(), colour::LightSpectra()));
    const double error =
        relative_rms(radiance(fill(light.texels, kernel, frames.front().normal), kernel, light.keys, frames),
                     read_xyz(rowland::test::read_csv(oracle_path)));
    EXPECT_LT(error, probe.tolerance) << probe.name;
}

}  // namespace rowland::diffraction::test
