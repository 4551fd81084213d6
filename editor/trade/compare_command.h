#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rowland::trade {

/// `rowland-trade compare`: how far one method is from another, on the tool's scene or over given frames.
struct CompareCommand {
    std::filesystem::path material;
    std::string probe;
    std::string mapping = "auto";
    std::string method;
    std::string against = "reference";
    std::optional<std::filesystem::path> frames;
    std::optional<std::filesystem::path> difference;
    std::vector<int> size = {160, 90};
    int magnified = 3;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;
};

}  // namespace rowland::trade
