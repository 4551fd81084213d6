#include "engine/post/display_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr float largest_half = 65504.0F;

/// Fills in the defaults and checks the names.
DisplaySelection resolve(const OcioConfig& config, DisplaySelection selection) {
    if (selection.display.empty()) selection.display = config.default_display();
    if (selection.view.empty()) selection.view = config.default_view(selection.display);
    config.require_view(selection.display, selection.view);
    return selection;
}

/// What a view transform makes of NaN and infinities differs between OpenColorIO's CPU and GPU code (an infinite
/// highlight comes out black, or as NaN), so they are replaced on the way in.
glm::vec3 displayable(const glm::vec3& colour) {
    const auto component = [](float value) {
        return std::isnan(value) ? 0.0F : std::clamp(value, -largest_half, largest_half);
    };
    return {component(colour.r), component(colour.g), component(colour.b)};
}

OCIO::ConstProcessorRcPtr make_processor(const OcioConfig& config, const DisplaySelection& selection) {
    const OCIO::ExposureContrastTransformRcPtr exposure = OCIO::ExposureContrastTransform::Create();
    exposure->setStyle(OCIO::EXPOSURE_CONTRAST_LINEAR);
    exposure->makeExposureDynamic();

    const OCIO::DisplayViewTransformRcPtr display = OCIO::DisplayViewTransform::Create();
    display->setSrc(OCIO::ROLE_SCENE_LINEAR);
    display->setDisplay(selection.display.c_str());
    display->setView(selection.view.c_str());

    const OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(exposure);
    group->appendTransform(display);
    return config.ocio()->getProcessor(group);
}

}  // namespace

DisplayTransform::DisplayTransform(const OcioConfig& config, const DisplaySelection& selection)
    : selection_(resolve(config, selection)), config_source_(config.source()) {
    if (!config.ocio()->hasRole(OCIO::ROLE_SCENE_LINEAR)) {
        refuse_input(config.source(), "roles", "no scene_linear",
                     "the colour space light is computed in, as the role scene_linear",
                     "add the role to the configuration");
    }
    try {
        processor_ = make_processor(config, selection_);
        cpu_ = processor_->getDefaultCPUProcessor();
    } catch (const OCIO::Exception& exception) {
        refuse_input(config.source(), fmt::format("display \"{}\", view \"{}\"", selection_.display, selection_.view),
                     exception.what(), "a view that can be built", "correct the configuration, or choose another view");
    }
}

void DisplayTransform::apply_cpu(std::span<glm::vec3> pixels, float exposure_stops) const {
    if (pixels.empty()) return;
    OCIO::DynamicPropertyRcPtr exposure = cpu_->getDynamicProperty(OCIO::DYNAMIC_PROPERTY_EXPOSURE);
    OCIO::DynamicPropertyValue::AsDouble(exposure)->setValue(static_cast<double>(exposure_stops));
    std::transform(pixels.begin(), pixels.end(), pixels.begin(), displayable);
    OCIO::PackedImageDesc image(&pixels.front().x, static_cast<long>(pixels.size()), 1, 3);
    cpu_->apply(image);
}

}  // namespace rowland::post
