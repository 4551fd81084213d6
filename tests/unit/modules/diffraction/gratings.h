#pragma once

#include "modules/diffraction/model/grating.h"

// Gratings that many tests use.
namespace rowland::diffraction::test {

inline Grating compact_disc() {
    return {.pitch_nm = 1600.0, .profile = SlitProfile{800.0}};
}

inline Grating foil() {
    return {.pitch_nm = 1000.0, .profile = BlazedProfile{150.0}, .lobe = GaussianLobe{0.3}};
}

}  // namespace rowland::diffraction::test
