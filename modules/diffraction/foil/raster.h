#pragma once

#include <cstdint>
#include <string>

#include "engine/image/byte_image.h"
#include "modules/diffraction/foil/pattern.h"

namespace rowland::diffraction::foil {

/// A picture scaled to fill width × height texels: what is beyond them on two sides is cut off, evenly. Each texel is
/// a mean over a tent of its own width, of colours weighted by alpha, as the file encodes them.
image::ByteImage fill_card(const image::ByteImage& picture, int width, int height);

/// Whether a picture has the proportions of width × height, to half a texel of it.
bool has_proportions(const image::ByteImageSize& picture, int width, int height);

/// Luminance times alpha, 0 to 1, linear in light.
Brightness brightness_of(const image::ByteImage& picture);

}  // namespace rowland::diffraction::foil
