#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "content/demo/demo_scene.h"
#include "content/demo/options.h"
#include "engine/lighting/light_probe.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::demo {

/// What the command line's scene is made of. Throws Error (input).
SceneSources load_sources(const Options& options, const glm::dmat3& xyz_to_working);

/// The probe of the command line, or all shipped ones.
std::vector<std::filesystem::path> probe_paths(const Options& options);

/// The folder that holds the cooked assets when the command line names none: ../cooked beside the program.
std::filesystem::path default_cooked_folder();

/// A cooked probe, a probe recipe, or an image with the given mapping, told apart by content and extension.
lighting::LightProbe load_probe(const std::filesystem::path& path, const std::string& mapping);

/// All triangles of a glTF file as one mesh.
scene::Mesh load_mesh(const std::filesystem::path& path);

/// A cooked material, or a material file that is baked now.
diffraction::CookedMaterial load_material(const std::filesystem::path& path);

}  // namespace rowland::demo
