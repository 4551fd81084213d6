#include "engine/command_line/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/core/program.h"
#include "engine/core/system.h"

namespace rowland {

CLI::Validator finite(double least, double most) {
    const auto refusal = [least, most](std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string();
        return fmt::format("'{}' is no number from {} to {}", text, least, most);
    };
    return {refusal, fmt::format("{} to {}", least, most), "finite"};
}

namespace {

void check_not_empty(const CLI::App& app, std::span<const char* const> arguments) {
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string_view text = arguments[i];
        const std::string_view option = text.empty() ? arguments[i - 1] : text.substr(0, text.size() - 1);
        if (!text.empty() && !(text.starts_with("--") && option.find('=') == text.npos && text.ends_with('=')))
            continue;
        refuse_input((i > 1 || !text.empty()) && option.starts_with('-') ? std::string(option) : app.get_name(), {},
                     "an empty argument", "a name or a value", "see " + app.get_name() + " --help");
    }
}

/// CLI11 reports a misspelt command only as a missing one.
void check_command(const CLI::App& app, std::string_view word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    if (names.empty() || word.starts_with('-') || std::ranges::find(names, word) != names.end()) return;
    const auto near = nearest_word(word, names);
    refuse_input(app.get_name(), {}, fmt::format("command \"{}\"", word),
                 fmt::format("one of {}", fmt::join(names, ", ")),
                 near ? fmt::format("is \"{}\" meant?", *near) : fmt::format("see {} --help", app.get_name()));
}

}  // namespace

bool parse_command_line(CLI::App& app, int argc, const char* const* argv) {
    const std::vector<std::string> texts = utf8_arguments(argc, argv);
    std::vector<const char*> arguments;
    for (const std::string& text : texts) arguments.push_back(text.c_str());
    check_not_empty(app, arguments);
    if (arguments.size() > 1) check_command(app, arguments[1]);
    // CLI11 by default takes /name for an option on Windows.
    app.allow_windows_style_options(false);
    for (CLI::App* command : app.get_subcommands({})) command->allow_windows_style_options(false);
    app.set_version_flag("--version", [&app] { return version_text(app.get_name()); });
    try {
        app.parse(argc, arguments.data());
        return true;
    } catch (const CLI::Success& asked) {
        const bool version = asked.get_name() == "CallForVersion";
        std::fputs((version ? asked.what() + std::string("\n") : app.help()).c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> commands = app.get_subcommands();
        const std::string name = app.get_name() + (commands.empty() ? "" : " " + commands.front()->get_name());
        refuse_input(name, {}, error.what(), {}, "see " + name + " --help");
    }
}

}  // namespace rowland
