#pragma once

#include "tests/gpu_cost/amd_compiler.h"

namespace rowland::gpu_cost {

/// A stage's cost. Registers and waves are the program's; the others count loops as often as they run.
struct StageCost {
    StageStatistics statistics;
    double times_plain = 0.0;  ///< inverse throughput over that of the frame "plain"
};

struct FrameCost {
    std::string name;
    StageCost fragment;
    StageCost vertex;
};

/// All frames by the compiler of one generation.
struct GenerationCost {
    std::string name;    ///< "RDNA2"
    std::string device;  ///< "AMD RADV NAVI21"
    std::string driver;  ///< "Mesa 22.3.6"
    std::vector<FrameCost> frames;
};

/// Divides by the frame "plain", which must be among the frames.
void divide_by_plain(GenerationCost& cost);

std::string to_text(const GenerationCost& cost);
/// A line for each frame, so that changes of a committed file can be read.
std::string to_json(const std::vector<GenerationCost>& costs);

/// The costs of an earlier run against today's.
struct Comparison {
    std::vector<std::string> grown;  ///< a line for each ratio that is 5 % larger, or no longer measured
    bool same_driver = true;         ///< else nothing is compared: another version of the compiler has other ratios
};
/// `held`: what to_json() wrote, from the file `file`. Throws Error (input) for another kind of file.
Comparison compare_with(const std::string& held, const std::string& file, const std::vector<GenerationCost>& costs);

}  // namespace rowland::gpu_cost
