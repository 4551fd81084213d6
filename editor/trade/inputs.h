#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/search.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::trade {

/// Named points that an error is measured over.
struct FrameSet {
    std::string name;
    std::vector<diffraction::Surface> surfaces;
};

/// The points of all surfaces, one surface after the other.
std::vector<diffraction::ShadingPoint> all_frames(const FrameSet& set);

/// The named sets that material budgets are measured on: "tilted_cd" and "sphere" (diffraction::measured_frames()).
FrameSet tilted_cd_frames();
FrameSet sphere_frames();
/// One surface with the frames of a CSV file (see read_frames()).
FrameSet frames_of_file(const std::string& name, const std::filesystem::path& path);

/// The scene of pictures and of timed frames: a compact disc in the XZ plane with a sphere over its hole, both of one
/// grating. Timed frames show the disc alone.
scene::Mesh disc_mesh();                                       ///< 25 000 vertices
scene::Mesh sphere_mesh();                                     ///< centred at its origin
inline constexpr glm::vec3 kSphereCentre{0.0F, 0.022F, 0.0F};  ///< metres

/// The camera of timed frames: the disc covers half of a wide picture.
scene::Camera close_camera();
/// The camera of error pictures: disc and sphere are completely visible.
scene::Camera far_camera();

/// The points of the scene that a camera sees, one per pixel. Both surfaces are exact, not meshes.
struct PictureFrames : diffraction::PictureLayout {
    FrameSet frames;  ///< "picture": the disc's points, then the sphere's
};
PictureFrames picture_frames(const scene::Camera& camera, int width, int height);
/// The same of the disc alone: "disc".
PictureFrames disc_frames(const scene::Camera& camera, int width, int height);

/// Frames from CSV `vx,vy,vz,nx,ny,nz,gx,gy,gz` (world axes; lengths do not matter). Throws Error (input) naming the
/// row for a frame without three directions.
std::vector<diffraction::ShadingPoint> read_frames(const std::filesystem::path& path);

/// Light from CSV `l,m,r,g,b`: every (l, m) of its bands once, in any order. Throws Error (input).
lighting::ShLight read_sh_light(const std::filesystem::path& path);

/// Reads a probe image. `mapping`: as for parse_mapping(). Reports the number of invalid texels on standard error.
lighting::ProbeImage read_probe(const std::filesystem::path& path, const std::string& mapping);

/// A probe's file and how it covers the sphere.
struct ProbeFile {
    std::filesystem::path path;
    std::string mapping = "auto";
};

/// "FILE" or "FILE:angular" or "FILE:equirect"; without a suffix, `mapping`.
ProbeFile parse_probe_file(const std::string& text, const std::string& mapping);

/// The CSV files in `folder` that a material's JSON names.
std::vector<std::filesystem::path> files_named_in(const nlohmann::json& material, const std::filesystem::path& folder);

/// Writes results to standard output. run_program() reports a failure to write.
void write_results(const std::string& text);

}  // namespace rowland::trade
