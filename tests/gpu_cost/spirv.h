#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rowland::gpu_cost {

/// A program's two stages as SPIR-V for Vulkan. Uniform blocks are bound from 0 on, storage blocks and textures as
/// follows.
struct Spirv {
    std::vector<std::uint32_t> vertex;
    std::vector<std::uint32_t> fragment;
};
inline constexpr std::uint32_t kFirstStorageBinding = 32;
inline constexpr std::uint32_t kFirstTextureBinding = 64;
inline constexpr std::uint32_t kBindings = 96;
inline constexpr std::uint32_t kTexelBufferBinding =
    kFirstTextureBinding + 12;  ///< the one samplerBuffer: tangent_light.glsl

/// A program's two stages as GLSL.
struct ProgramText {
    std::string vertex;
    std::string fragment;
};

/// The GLSL of OpenGL as Vulkan's relaxed rules want it: what passes from stage to stage is located by name, in the
/// order of the vertex stage, arrays last.
ProgramText for_vulkan(const ProgramText& text);

/// The same with its loops written out, as far as their length is known. `lengths`: by the GLSL expression of the
/// length, which the number replaces. Loops over the parts of a pixel, "part < parts", get one: in the benchmark's
/// frames its grooves do not vary.
ProgramText with_loops_unrolled(const ProgramText& text, const std::map<std::string, int>& lengths);

/// Compiles with glslangValidator, the reference front end. Throws Error (system) with its first message.
Spirv compile_to_spirv(const ProgramText& text);

}  // namespace rowland::gpu_cost
