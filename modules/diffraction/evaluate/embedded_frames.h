#pragma once

#include <string_view>

/// The files of frames/ as text, built in by embed_frames.cmake. Private to this folder.
namespace rowland::diffraction::embedded {

extern const std::string_view kTiltedDisc;
extern const std::string_view kSphere;

}  // namespace rowland::diffraction::embedded
