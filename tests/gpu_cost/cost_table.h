#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
nlohmann::ordered_json to_json(const std::vector<GenerationCost>& costs);

/// What grew by more than 5 % over a file that to_json() wrote, or is missing in `costs`: a line for each. Of a file by
/// another version of the driver nothing is compared, and `comparable` becomes false. Throws Error (input) for another
/// kind of file, which `file` names.
std::vector<std::string> grown(const std::vector<GenerationCost>& costs, const nlohmann::json& held,
                               const std::string& file, bool& comparable);

}  // namespace rowland::gpu_cost
