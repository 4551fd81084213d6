#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/trade/sweep.h"

namespace CLI {
class App;
}

namespace rowland::trade {

/// The options of commands that sweep.
struct SweepOptions {
    std::vector<std::filesystem::path> materials;
    std::vector<std::string> probes;
    std::string mapping = "equirect";
    std::vector<std::string> frames;  ///< NAME=FILE
    std::vector<std::string> settings;
    std::vector<int> picture_size = {160, 90};
    std::vector<int> frame_size = {640, 360};
    bool no_times = false;
    std::filesystem::path output;

    void declare(CLI::App& command);
    /// Throws Error (input).
    SweepInputs inputs() const;
};

}  // namespace rowland::trade
