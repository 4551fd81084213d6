#pragma once

#include <map>
#include <optional>
#include <string>

namespace rowland::evidence {

/// What the benchmark's frames cost, as × the frame "plain"; the frame's name is the key. Measured when it is called,
/// by the programs that lie beside this one.
struct FrameCosts {
    std::string renderer;                ///< that times are of
    std::map<std::string, double> time;  ///< of all threads that draw
    std::string gpu;                     ///< that cycles are of
    std::map<std::string, double> cycles;
    std::string missing{};  ///< why there are no cycles

    /// "1.23", or "–" if it was not measured.
    static std::string text(const std::map<std::string, double>& values, const std::string& name);
};
/// Throws Error (system) if the benchmark fails.
FrameCosts measure_frame_costs();

}  // namespace rowland::evidence
