#pragma once

#include <memory>

#include "tests/gpu_cost/spirv.h"

namespace rowland::gpu_cost {

/// A generation of AMD's GPUs, and the names under which versions of Mesa know one of it.
struct Generation {
    std::string name;
    std::vector<std::string> families;
};
const std::vector<Generation>& generations();

/// What the compiler makes of a stage.
struct StageStatistics {
    int instructions = 0;
    int fetches = 0;  ///< instructions that read textures, buffers or attributes, for each lane an address of its own
    int vector_registers = 0;
    int waves = 0;                  ///< that a SIMD unit holds at once
    double inverse_throughput = 0;  ///< cycles per 64 vertices or pixels: inverse throughput
};
struct PipelineStatistics {
    StageStatistics vertex;
    StageStatistics fragment;
};

/// RADV, Mesa's Vulkan driver of AMD's GPUs, on its null device: compiles as for the GPU and needs none.
class AmdCompiler {
 public:
    /// Throws Error (system) where the driver is missing or does not know the generation.
    explicit AmdCompiler(const Generation& generation);
    ~AmdCompiler();
    AmdCompiler(const AmdCompiler&) = delete;
    AmdCompiler& operator=(const AmdCompiler&) = delete;

    /// As "AMD RADV NAVI21" and "Mesa 22.3.6".
    const std::string& device() const;
    const std::string& driver() const;

    /// A pipeline of meshes with all attributes, four samples per pixel and half-float colours.
    PipelineStatistics compile(const Spirv& spirv) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rowland::gpu_cost
