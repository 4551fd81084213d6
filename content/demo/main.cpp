#include <cstdio>
#include <optional>

#include "content/demo/options.h"
#include "content/demo/run.h"
#include "engine/core/error.h"
#include "engine/core/program.h"
#include "engine/platform/window.h"

namespace rowland::demo {
namespace {

int run(int argc, char** argv) {
    std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    const post::OcioConfig config = app::open_ocio_config(*options);
    if (options->list_views) {
        for (const std::string& view : config.views(config.default_display())) std::puts(view.c_str());
        return 0;
    }
    check_outputs(*options);
    const bool offscreen = options->headless || options->benchmark || options->captures();
    if (!offscreen && platform::display_available()) {
        run_in_window(*options, config);
        return 0;
    }
    if (options->record)
        refuse_input("--record", {}, "no window to play in", "a display, and neither --headless nor captures",
                     "leave --record out");
    options->watch = false;
    run_offscreen(*options, config);
    return 0;
}

}  // namespace
}  // namespace rowland::demo

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::demo::run(argc, argv); });
}
