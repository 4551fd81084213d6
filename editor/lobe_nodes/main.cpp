// Writes engine/lighting/lobe_nodes.csv: `./rowland update-lobe-nodes`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <string>

#include "editor/lobe_nodes/fit_lobe_nodes.h"
#include "engine/command_line/command_line.h"
#include "engine/core/file.h"
#include "engine/core/program.h"

namespace rowland::lighting {
namespace {

std::string csv(const LobeNodeTable& table) {
    std::string text = std::string(kLobeNodesHeader) + "\n";
    for (int row = 0; row < LobeNodeTable::kRows; ++row)
        for (int column = 0; column < LobeNodeTable::kColumns; ++column) {
            fmt::format_to(std::back_inserter(text), "{},{}", column, row);
            for (int plane = 0; plane < LobeNodeTable::kPlanes; ++plane)
                for (int node = 0; node < kLobeNodes; ++node)
                    fmt::format_to(std::back_inserter(text), ",{:.4g}",
                                   table.texels.at(LobeNodeTable::index(plane, column, row))[node]);
            text += '\n';
        }
    return text;
}

int run(int argc, const char* const* argv) {
    CLI::App app("Fits the table of GGX lobe nodes.", "fit-lobe-nodes");
    std::filesystem::path file;
    app.add_option("file", file, "The .csv file to write")->required();
    if (!parse_command_line(app, argc, argv)) return 0;
    write_file_atomic(file, csv(fit_lobe_nodes()));
    return 0;
}

}  // namespace
}  // namespace rowland::lighting

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::lighting::run(argc, argv); });
}
