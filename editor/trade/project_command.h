#pragma once

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace rowland::trade {

/// `rowland-trade project`: the raw radiance SH of a probe on standard output.
struct ProjectCommand {
    std::filesystem::path probe;
    std::string mapping = "equirect";
    int bands = 5;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;
};

}  // namespace rowland::trade
