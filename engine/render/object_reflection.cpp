#include "engine/render/object_reflection.h"

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "engine/render/bindings.h"

namespace rowland::render {

namespace {

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2.0F;

struct CubeFace {
    glm::vec3 forward;
    glm::vec3 up;
};
// A face's first row of texels is the lowest of a picture that is taken this way up.
constexpr std::array<CubeFace, ObjectReflection::kFaces> kCubeFaces = {{{{1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}},
                                                                        {{-1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}},
                                                                        {{0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}},
                                                                        {{0.0F, -1.0F, 0.0F}, {0.0F, 0.0F, -1.0F}},
                                                                        {{0.0F, 0.0F, 1.0F}, {0.0F, -1.0F, 0.0F}},
                                                                        {{0.0F, 0.0F, -1.0F}, {0.0F, -1.0F, 0.0F}}}};

gpu::Texture empty_cube(gpu::Format format, int face_size, int levels, gpu::Filter filter) {
    gpu::Texture cube({.kind = gpu::TextureKind::CubeMap,
                       .format = format,
                       .width = face_size,
                       .height = face_size,
                       .levels = levels},
                      {.filter = filter});
    const auto face = static_cast<std::size_t>(face_size) * static_cast<std::size_t>(face_size);
    const std::vector<glm::vec4> nothing(ObjectReflection::kFaces * face, glm::vec4(0.0F));
    cube.upload(std::span<const glm::vec4>(nothing), {.layers = ObjectReflection::kFaces});
    return cube;
}

}  // namespace

ObjectReflection::ObjectReflection(int face_size)
    : light_(empty_cube(gpu::Format::RGBA16F, face_size, 0, gpu::Filter::Trilinear)),
      nearness_(empty_cube(gpu::Format::R32F, face_size, 1, gpu::Filter::Nearest)) {
    for (int face = 0; face < kFaces; ++face) {
        targets_.push_back(gpu::Framebuffer::onto(light_, 0, face));
        targets_.push_back(gpu::Framebuffer::onto(nearness_, 0, face));
    }
}

scene::Camera ObjectReflection::camera(int face) const {
    const CubeFace& axes = kCubeFaces.at(static_cast<std::size_t>(face));
    return {.eye = centre,
            .target = centre + axes.forward,
            .up = axes.up,
            .vertical_field_of_view = kQuarterTurn,
            .near_plane = 0.002F};
}

void ObjectReflection::store(ProgramCache& programs, const gpu::FullScreenTriangle& triangle,
                             const gpu::Framebuffer& picture, int face) {
    const scene::Camera seen_by = camera(face);
    const gpu::Program& program = programs.get(
        {.vertex = gpu::full_screen_vertex_shader, .fragment = "engine/render/shaders/surroundings.frag.glsl"});
    program.use();
    program.set("planes", glm::vec2(seen_by.near_plane, seen_by.far_plane));
    picture.colour().bind(0);
    picture.depth().bind(1);
    for (const bool nearness : {false, true}) {
        program.set("nearness", nearness ? 1 : 0);
        triangle.draw(program, targets_.at(static_cast<std::size_t>(2 * face + (nearness ? 1 : 0))));
    }
}

void ObjectReflection::bind(const gpu::Program& program) const {
    program.set("surroundings", glm::vec4(centre, kQuarterTurn / static_cast<float>(light_.size().x)));
    light_.bind(kSurroundingLightUnit);
    nearness_.bind(kSurroundingNearnessUnit);
}

ObjectReflections::ObjectReflections() : all_visible(gpu::TextureDesc{}) {
    all_visible.upload(std::span<const glm::vec4>(std::vector<glm::vec4>{glm::vec4(1.0F)}));
}

ObjectReflection& ObjectReflections::of(ecs::Entity group) {
    return of_groups_.try_emplace({group.index, group.version}, kFaceSize).first->second;
}

}  // namespace rowland::render
