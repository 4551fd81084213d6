#pragma once

#include <filesystem>

#include "engine/gpu/framebuffer.h"

namespace rowland::view {

/// `path` with the frame's number before the extension if there is more than one frame.
std::filesystem::path numbered(const std::filesystem::path& path, int frame, int frames);

/// Both write a picture and log where.
/// A display-encoded framebuffer as PNG. Throws Error (system) if the context is lost.
void write_display_capture(const gpu::Framebuffer& display, const std::filesystem::path& path);

/// A scene-linear framebuffer as OpenEXR. Throws Error (system) if a pixel is not finite or the
/// context is lost.
void write_linear_capture(const gpu::Framebuffer& linear, const std::filesystem::path& path);

}  // namespace rowland::view
