#include <algorithm>
#include <optional>
#include <thread>

#include "editor/inspector/capture.h"
#include "editor/inspector/options.h"
#include "editor/inspector/window_loop.h"
#include "engine/app/context.h"
#include "engine/core/parallel.h"
#include "engine/core/program.h"

namespace rowland::inspector {
namespace {

int run(int argc, char** argv) {
    const std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    const post::OcioConfig config = app::open_ocio_config(*options);
    if (options->capture) {
        capture(*options, config);
        return 0;
    }
    app::require_display("rowland-inspector", "write a picture with --capture FILE");
    const ThreadLimit one_core_for_frames(std::max(1U, std::thread::hardware_concurrency() - 1));
    run_in_window(*options, config);
    return 0;
}

}  // namespace
}  // namespace rowland::inspector

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::inspector::run(argc, argv); });
}
