#pragma once

#include <filesystem>

#include "tests/gpu_cost/spirv.h"

namespace rowland::gpu_cost {

/// A frame of rowland-benchmark: the program that draws its disc.
struct CapturedFrame {
    std::string name;
    ProgramText text;
    std::map<std::string, int> lengths;  ///< of loops, by the GLSL expression of the length
};

/// Lets rowland-benchmark, which lies beside this program, draw its frames whose names match one of the patterns (none:
/// all), and their baselines, to a folder: program_folder.h. Throws Error (input) for a pattern that matches none, and
/// Error (system).
void capture_programs(const std::filesystem::path& folder, const std::vector<std::string>& patterns);

/// The frames of such a folder. A frame that is drawn like an earlier one, by the same program with the same loops, is
/// left out.
std::vector<CapturedFrame> read_frames(const std::filesystem::path& folder);

}  // namespace rowland::gpu_cost
