#include "modules/diffraction/runtime/gpu_still.h"

#include <array>
#include <utility>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

/// Like a map without key lights, a still shows the whole probe and no other light.
CookedMaterial as_a_map(const CookedMaterial& cooked) {
    CookedMaterial map = cooked;
    map.material.quality.key_lights = 0;
    map.tables = CircleTables{};
    map.reflected = nullptr;  // the image shows both sides of a sheet
    return map;
}

}  // namespace

GpuStill::GpuStill(const CookedMaterial& cooked, std::shared_ptr<const gpu::Texture> still,
                   const glm::dmat3& xyz_to_working)
    : GpuMaterial(as_a_map(cooked), xyz_to_working), still_(std::move(still)) {}

void GpuStill::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "shaders/still.frag.glsl");
}

void GpuStill::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    still_->bind(kMapUnit);
    // The viewport is that of the whole image, whatever the scissor.
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    program.set("still_scale", 1.0F / glm::vec2(viewport[2], viewport[3]));
}

}  // namespace rowland::diffraction
