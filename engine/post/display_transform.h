#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "engine/post/ocio_config.h"

namespace rowland::post {

/// A display and one of its views; empty names mean the configuration's defaults.
struct DisplaySelection {
    std::string display;
    std::string view;
};

/// From the working space (the configuration's scene_linear) to the encoded values of a display: exposure, the view's
/// looks (gamut compression), the view transform, the display's encoding. NaN input becomes 0, and input is clamped
/// to the half floats' ±65504; output is not clamped. This is the CPU reference, and the source of the code that
/// DisplayPass runs on the GPU.
class DisplayTransform {
 public:
    /// Throws Error (input) if there is no such display or view (the message lists those there are and names the
    /// nearest), no scene_linear role, or a file the view needs is missing.
    explicit DisplayTransform(const OcioConfig& config, const DisplaySelection& selection = {});

    /// Replaces scene-linear pixels by display values. Not for two threads at once on one object.
    void apply_cpu(std::span<glm::vec3> pixels, float exposure_stops = 0.0F) const;

    const std::string& display() const { return selection_.display; }
    const std::string& view() const { return selection_.view; }
    const std::string& config_source() const { return config_source_; }
    const OCIO_NAMESPACE::ConstProcessorRcPtr& processor() const { return processor_; }

 private:
    DisplaySelection selection_;
    std::string config_source_;
    OCIO_NAMESPACE::ConstProcessorRcPtr processor_;
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr cpu_;
};

}  // namespace rowland::post
