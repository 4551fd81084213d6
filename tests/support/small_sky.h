#pragma once

#include <fmt/format.h>

#include <string>

namespace rowland::test {

/// A recipe of a clear sky's probe that is so small that the reference is quick under it; `width` in texels.
inline std::string small_sky(int width) {
    return fmt::format(
        R"({{"probe": {{"type": "clear_sky", "sun_azimuth_deg": 40, "sun_elevation_deg": 35, "width": {}}}}})", width);
}

}  // namespace rowland::test
