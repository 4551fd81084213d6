#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "content/demo/demo_scene.h"
#include "content/demo/options.h"
#include "engine/post/glare.h"

namespace rowland::demo {

/// A sheet of glasses or a screen that one may look through.
struct Sheet {
    std::string name;
    std::filesystem::path file;  ///< a material; empty: the scene's own
};

/// That of the command line, or the scene's own and the shipped ones.
std::vector<Sheet> sheets(const Options& options, const DemoScene& scene);

/// Reads a sheet. Throws Error (input).
post::GlareSettings glare_of(const Sheet& sheet, const DemoScene& scene, const glm::dmat3& xyz_to_working);

}  // namespace rowland::demo
