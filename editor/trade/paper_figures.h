#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "editor/trade/difference_image.h"
#include "editor/trade/stage.h"
#include "engine/platform/headless_context.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::trade {

/// A curve of a figure.
struct Curve {
    std::vector<double> x;
    std::vector<double> y;
};

/// Fig. 2 of Lindsay & Agu 2006: diffraction varies faster than interference.
struct Figure2 {
    Curve diffraction;   ///< x: half the phase between neighbouring grooves, −π to π; y: 1 at the highest peak
    Curve interference;  ///< of a thin film over the same phase; y likewise
    Curve peak;          ///< one order: x in degrees of view from its peak, y 1 at the peak
    double peak_width_degrees = 0.0;  ///< between the half heights of `peak`
};

/// The curves of a slit grating (for other profiles, of slits of half the pitch) at normal incidence, at its first
/// order for 550 nm; the film is two-beam interference of a soap film.
Figure2 figure_2(const diffraction::Grating& grating);

/// Fig. 3: frames per second against the number of lights.
struct Figure3 {
    std::vector<int> lights;
    std::vector<double> loop_fps;  ///< light by light, order by order
    std::vector<double> sh_fps;    ///< the paper's 5 bands and 4 spikes
};

/// Fig. 6: light by light, and by SH; one light, and several.
struct Figure6 {
    RgbPicture direct_one;
    RgbPicture direct_several;
    RgbPicture sh_one;
    RgbPicture sh_several;
    int several = 6;
};

/// The frame rates of section 5: the disc of 25 000 vertices.
struct PaperRates {
    std::size_t vertices = 0;
    double plain_fps = 0.0;
    double fps = 0.0;
    double fps_with_effects = 0.0;  ///< environment, blur, exposure, vignette, display transform, dither
};

/// The figures that need a GL device, drawn on one stage of `size` pixels. `paper`: a material in the paper's setting;
/// its grating has the flat lobe.
class PaperStage {
 public:
    PaperStage(const diffraction::CookedMaterial& paper, glm::ivec2 size);

    Figure3 figure_3(const std::vector<int>& light_counts);
    Figure6 figure_6();
    PaperRates rates();

 private:
    void show_loop(int lights);
    void show_sh(int lights);
    double fps(bool effects = false);

    platform::HeadlessContext context_;
    glm::ivec2 size_;
    Stage stage_;
    diffraction::CookedMaterial material_;
    std::shared_ptr<const diffraction::GpuMaterial> spikes_;
};

}  // namespace rowland::trade
