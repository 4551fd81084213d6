#include "editor/trade/frame_sets.h"

#include "editor/trade/inputs.h"
#include "modules/diffraction/evaluate/frame_sets.h"

namespace rowland::trade {

std::vector<diffraction::ShadingPoint> all_frames(const FrameSet& set) {
    std::vector<diffraction::ShadingPoint> frames;
    for (const auto& surface : set.surfaces) frames.insert(frames.end(), surface.begin(), surface.end());
    return frames;
}

FrameSet tilted_cd_frames() {
    return {.name = "tilted_cd", .surfaces = {diffraction::measured_frames(diffraction::SurfaceShape::Flat)}};
}

FrameSet sphere_frames() {
    return {.name = "sphere", .surfaces = {diffraction::measured_frames(diffraction::SurfaceShape::Curved)}};
}

FrameSet frames_of_file(const std::string& name, const std::filesystem::path& path) {
    return {.name = name, .surfaces = {read_frames(path)}};
}

}  // namespace rowland::trade
