#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/diffraction/evaluate/measured_scene.h"

namespace rowland::trade {

/// Named points that an error is measured over.
struct FrameSet {
    std::string name;
    std::vector<diffraction::Surface> surfaces;
};

/// The points of all surfaces, one surface after the other.
std::vector<diffraction::ShadingPoint> all_frames(const FrameSet& set);

/// The named sets that material budgets are measured on: "tilted_cd" and "sphere" (diffraction::measured_frames()).
FrameSet tilted_cd_frames();
FrameSet sphere_frames();
/// One surface with the frames of a CSV file (see read_frames()).
FrameSet frames_of_file(const std::string& name, const std::filesystem::path& path);

}  // namespace rowland::trade
