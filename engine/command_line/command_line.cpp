#include "engine/command_line/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "engine/core/error.h"

namespace rowland {

CLI::Validator finite(double least, double most) {
    const auto refusal = [least, most](std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string();
        return fmt::format("'{}' is no number from {} to {}", text, least, most);
    };
    return {refusal, fmt::format("{} to {}", least, most), "finite"};
}

bool parse_command_line(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& error) {
        refuse_input(app.get_name(), {}, error.what(), {}, "see " + app.get_name() + " --help");
    }
}

}  // namespace rowland
