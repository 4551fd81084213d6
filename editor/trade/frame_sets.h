#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "modules/diffraction/model/frame.h"

namespace rowland::trade {

/// Shaded points that an error is a sum over.
struct FrameSet {
    std::string name;
    /// Points of one object each: a map of a flat object serves all points of its surface.
    std::vector<std::vector<diffraction::Frame>> surfaces;

    std::size_t size() const;
};

/// One after the other.
std::vector<diffraction::Frame> all_frames(const FrameSet& set);

/// The named sets that material budgets are measured on: "tilted_cd" and "sphere" (diffraction::measured_frames()).
FrameSet tilted_cd_frames();
FrameSet sphere_frames();
/// One surface of frames from a CSV file (see read_frames()), or, where the normals differ, a curved one.
FrameSet frames_of_file(const std::string& name, const std::filesystem::path& path);

/// Whether all normals are one.
bool is_flat(const std::vector<diffraction::Frame>& surface);

}  // namespace rowland::trade
