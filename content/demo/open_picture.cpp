#include "content/demo/open_picture.h"

#include <limits>

#include "content/demo/demo_scene.h"
#include "modules/material_types.h"

namespace rowland::demo {

namespace {

post::PostSettings post_settings(const Options& options) {
    post::PostSettings settings;
    settings.exposure_stops = options.exposure_stops;
    if (options.bloom > 0.0F) settings.bloom = post::BloomSettings{.strength = options.bloom};
    if (options.auto_exposure) settings.auto_exposure = post::AutoExposureSettings{};
    if (options.vignette > 0.0F)
        settings.vignette = post::VignetteSettings{.vertical_fov = kFieldOfView, .strength = options.vignette};
    if (options.dither) settings.dither = post::DitherSettings{};
    return settings;
}

diffraction::DiffractionSettings diffraction_settings(const Options& options, Pace pace) {
    diffraction::DiffractionSettings settings;
    if (options.light_window != "auto") settings.window = math::parse_window(options.light_window);
    if (pace == Pace::Still) settings.slices_per_frame = std::numeric_limits<int>::max();
    return settings;
}

}  // namespace

std::unique_ptr<view::Picture> open_picture(const Options& options, const post::OcioConfig& config, glm::ivec2 size,
                                            Pace pace) {
    auto picture = std::make_unique<view::Picture>(config, options.view, size);
    picture->post_settings() = post_settings(options);
    modules::register_material_types(picture->renderer(), {.diffraction = diffraction_settings(options, pace)});
    return picture;
}

}  // namespace rowland::demo
