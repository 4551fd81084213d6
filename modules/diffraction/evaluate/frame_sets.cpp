#include "modules/diffraction/evaluate/frame_sets.h"

#include <string>

#include "engine/core/check.h"
#include "engine/core/embedded_file.h"
#include "engine/core/number_table.h"

namespace rowland::diffraction {

/// The files of frames/.
std::span<const EmbeddedFile> frame_files();

std::vector<ShadingPoint> measured_frames(SurfaceShape surface) {
    const std::string file = std::string("modules/diffraction/evaluate/frames/") +
                             (surface == SurfaceShape::Flat ? "tilted_disc.csv" : "sphere.csv");
    const NumberTable table =
        parse_number_table(embedded_text(frame_files(), file), file, "vx,vy,vz,nx,ny,nz,gx,gy,gz");
    std::vector<ShadingPoint> frames;
    for (const std::vector<double>& x : table.rows) {
        frames.push_back({.view = {x[0], x[1], x[2]}, .normal = {x[3], x[4], x[5]}, .grating = {x[6], x[7], x[8]}});
        ROWLAND_CHECK(is_valid(frames.back()), "a built-in frame has three directions");
    }
    return frames;
}

}  // namespace rowland::diffraction
