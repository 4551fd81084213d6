#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

#include "tests/benchmark/frame_variant.h"

namespace rowland::benchmark {

/// Draws each variant and writes the GLSL of all programs that were linked, N.vert with N.frag or N.comp, and
/// programs.json: "programs" (the files' names without extension), "frames" ("name", the "program" that draws its disc,
/// and "lengths", how often its loops run), each followed by the passes that its effect adds ("NAME/pass:1"). A context
/// must be current.
void write_programs(const std::filesystem::path& folder, const std::vector<FrameVariant>& variants, glm::ivec2 size,
                    bool software);

}  // namespace rowland::benchmark
