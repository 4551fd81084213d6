// What mirrors show of the scene: the plane they stand on and the objects around them.

#include "engine/render/reflections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "engine/lighting/environment_map.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/render/draw_list.h"
#include "engine/render/material.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_lights.h"
#include "engine/render/shader_interface.h"
#include "engine/render/shaders/scene_blocks.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

glm::vec2 along_plane(const glm::vec3& position) {
    return {position.x, position.z};
}

glm::vec3 ambient_radiance(const LitProbe& probe, const glm::mat3& rec709_to_working, const glm::dvec3& normal) {
    std::array<double, 9> basis = {};
    math::evaluate_sh(normal, 3, basis);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * probe.ambient.coefficients[i];
    sum += lighting::LobeIrradiance(probe.light.key_lights())(normal) / std::numbers::pi;
    return glm::max(rec709_to_working * glm::vec3(sum), 0.0F);
}

void add_lights(const SceneLights& lights, const glm::vec3& normal, ReflectionBlock& block) {
    for (int i = 0; i < static_cast<int>(lights.block.light_counts.x); ++i) {
        const Light& light = lights.block.lights[i];
        const float cosine = std::max(glm::dot(glm::vec3(light.position), normal), 0.0F);
        const bool shadowed = i == 0 && lights.shadow_light;
        (shadowed ? block.plane_lamp : block.plane_ambient) += light.strength * cosine / std::numbers::pi_v<float>;
    }
}

/// Sets the map's coordinates on the plane, including its texture transform.
void set_uv(const ReflectedTop& top, const scene::TextureTransform& transform, ReflectionBlock& block) {
    const UvTransform map = uv_transform(transform);
    const glm::mat2 linear(map.linear.x, map.linear.y, map.linear.z, map.linear.w);
    const glm::mat2 whole = linear * top.uv_linear;
    block.plane_uv_linear = glm::vec4(whole[0], whole[1]);
    block.plane_uv_offset = glm::vec4(linear * top.uv_offset + glm::vec2(map.offset), 0.0F, 0.0F);
}

}  // namespace

ReflectedTop top_of(const scene::Mesh& mesh) {
    const scene::Bounds box = scene::bounds(mesh);
    const glm::vec3 middle = 0.5F * (box.minimum + box.maximum);
    ReflectedTop top{.centre = {middle.x, box.maximum.y, middle.z}, .half = along_plane(box.maximum - middle)};
    float largest = 0.0F;
    const float level = box.maximum.y - 1e-4F * (box.maximum.y - box.minimum.y);
    for (std::size_t i = 0; i + 2 < mesh.indices.size() && !mesh.uvs.empty(); i += 3) {
        const std::array<std::uint32_t, 3> corner = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        if (std::ranges::any_of(corner, [&](std::uint32_t c) { return mesh.positions[c].y < level; })) continue;
        const glm::vec2 first = along_plane(mesh.positions[corner[0]]);
        const glm::mat2 edges(along_plane(mesh.positions[corner[1]]) - first,
                              along_plane(mesh.positions[corner[2]]) - first);
        const float area = std::abs(glm::determinant(edges));
        if (area <= largest) continue;
        largest = area;
        const glm::vec2 uv = mesh.uvs[corner[0]];
        top.uv_linear = glm::mat2(mesh.uvs[corner[1]] - uv, mesh.uvs[corner[2]] - uv) * glm::inverse(edges);
        top.uv_offset = uv + top.uv_linear * (along_plane(top.centre) - first);
    }
    return top;
}

bool LocalReflection::update(ecs::World& world, const PlaneLight& light, float pixel_angle) {
    std::optional<ReflectionBlock> block;
    map_ = nullptr;
    world.view<ReflectedTop, StandardMaterial, MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity, const ReflectedTop& top, const StandardMaterial& material, const MeshInstance&,
            const scene::WorldMatrix& world_matrix) {
            if (block) return;
            block = ReflectionBlock{};
            const glm::mat4& matrix = world_matrix.matrix;
            block->world_to_plane = glm::inverse(glm::translate(matrix, top.centre));
            const SurfaceTexture& map = material.base_colour_texture;
            if (map && map.uv_set == 0) map_ = map.texture.get();
            block->plane_size = glm::vec4(top.half, pixel_angle, map_ != nullptr ? 1.0F : 0.0F);
            const glm::vec3 normal =
                glm::normalize(glm::inverseTranspose(glm::mat3(matrix)) * glm::vec3(0.0F, 1.0F, 0.0F));
            block->plane_normal = glm::vec4(normal, material.roughness);
            normal_ = normal;
            const glm::vec3 middle(matrix * glm::vec4(top.centre, 1.0F));
            height_ = glm::dot(normal, middle);
            block->plane_ambient =
                glm::vec4(ambient_radiance(light.probe_at(middle), light.rec709_to_working, glm::dvec3(normal)), 0.0F);
            add_lights(light.lights, normal, *block);
            block->plane_colour = glm::vec4(
                map_ != nullptr ? material.base_colour : light.rec709_to_working * material.base_colour, 1.0F);
            set_uv(top, map.transform, *block);
        });
    if (block) block_.write_values(std::span<const ReflectionBlock>(&*block, 1));
    return block.has_value();
}

bool LocalReflection::covers(const scene::Bounds& box) const {
    const glm::vec3 middle = 0.5F * (box.minimum + box.maximum);
    const float highest = glm::dot(normal_, middle) + glm::dot(glm::abs(normal_), box.maximum - middle);
    return highest < height_ + 1e-4F;
}

void LocalReflection::bind() const {
    block_.bind_uniform(kReflectionBinding);
    if (map_ != nullptr) map_->bind(kPlaneMapUnit);
}

namespace {

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2.0F;

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

scene::Camera cube_face_camera(int face, const glm::vec3& centre) {
    const glm::vec3 forward(lighting::cube_direction(face, 0.0, 0.0));
    // Rows of a face and of a picture both begin at the bottom if the camera's up is toward larger rows.
    const glm::vec3 upward = glm::vec3(lighting::cube_direction(face, 0.0, 1.0)) - forward;
    return {.eye = centre,
            .target = centre + forward,
            .up = upward,
            .vertical_field_of_view = kQuarterTurn,
            .near_plane = 0.002F};
}

void ObjectReflection::store(ProgramCache& programs, const gpu::FullScreenTriangle& triangle,
                             const gpu::Framebuffer& picture, int face) {
    const scene::Camera seen_by = camera(face);
    const gpu::Program& program = programs.get(gpu::full_screen_pass("engine/render/shaders/surroundings.frag.glsl"));
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

namespace {

template <typename T>
void add_bytes(Hasher& hasher, const T& value) {
    hasher.bytes(std::as_bytes(std::span(&value, 1)));
}

void add_draw(Hasher& hasher, const Draw& draw) {
    add_bytes(hasher, draw.entity);
    add_bytes(hasher, draw.mesh);
    add_bytes(hasher, draw.first.program);
    for (const SurfaceMap& map : kSurfaceMaps) add_bytes(hasher, (draw.material->*map.texture).texture.get());
}

/// Each group that mirrors objects and its bounds, in an order that does not depend on the camera.
std::vector<std::pair<ecs::Entity, scene::Bounds>> reflecting_groups(const DrawList& list) {
    std::vector<std::pair<ecs::Entity, scene::Bounds>> groups;
    for (const Draw& draw : list.draws) {
        if ((draw.features & feature::kObjectReflections) == 0) continue;
        const auto known = std::ranges::find(groups, *draw.reflects, [](const auto& group) { return group.first; });
        if (known == groups.end())
            groups.emplace_back(*draw.reflects, draw.bounds);
        else
            known->second = *united(std::array{known->second, draw.bounds});
    }
    return groups;
}

}  // namespace

void Renderer::update_reflection(ecs::World& world, const Frame& frame) {
    if (effects_.local_reflections && frame.shading == Shading::Full) {
        if (!reflection_) reflection_.emplace();
        const float height = static_cast<float>(frame.size.y);
        const auto probe_at = [&](const glm::vec3& point) -> const LitProbe& {
            const LightMix mix = light_at(point, volumes_.boxes);
            return *frame_probes_[mix.second_part > 0.5F ? mix.second : mix.first];
        };
        const PlaneLight light{probe_at, lights_, glm::mat3(rec709_to_working_)};
        if (reflection_->update(world, light, frame.camera->vertical_field_of_view / height)) return;
    }
    reflection_.reset();
}

void Renderer::draw_object_reflections(ecs::World& world, Frame& frame) {
    const auto groups = reflecting_groups(frame.list);
    if (groups.empty()) return object_reflections_.reset();
    const gpu::PassTimes::Scope scope(times_, "reflections");
    if (!object_reflections_) object_reflections_.emplace();
    bool drawn = false;
    for (const auto& [group, box] : groups) {
        ObjectReflection& reflection = object_reflections_->of(group);
        reflection.centre = 0.5F * (box.minimum + box.maximum);
        Frame around = surroundings(world, frame, group);
        update_staleness(around, reflection);
        drawn = drawn || reflection.stale_faces > 0;
        if (reflection.stale_faces > 0) draw_surroundings(world, around, reflection);
        for (Draw& draw : frame.list.draws)
            if (draw.reflects == group) draw.reflection = &reflection;
    }
    if (drawn) bind_frame(frame);
}

/// The draws around a group: all opaque objects except its own and those below the plane that mirrors show. Of entities
/// that split the picture by PictureColumns, only the leftmost is drawn, whole.
Renderer::Frame Renderer::surroundings(ecs::World& world, const Frame& frame, ecs::Entity group) {
    Frame around = frame;
    around.size = object_reflections_->picture.size();
    around.aspect = 1.0F;
    around.into_halves = true;
    around.blended.clear();
    around.casters.clear();
    std::erase_if(around.list.draws, [&](const Draw& draw) {
        const bool right_part = draw.columns != nullptr && draw.columns->begin > 0.0F;
        return draw.reflects == group || (draw.features & feature::kAlphaBlend) != 0 || right_part ||
               (reflection_ && reflection_->covers(draw.bounds));
    });
    for (Draw& draw : around.list.draws) {
        draw.first.program = &program_of(world, draw, ProbeSlot::First);
        if (draw.light.has_second()) draw.second.program = &program_of(world, draw, ProbeSlot::Second);
        draw.columns = nullptr;
        draw.reflection = &object_reflections_->nothing;
    }
    return around;
}

/// Marks the faces to be drawn again: all in this frame if objects, light or centre are others than before, one per
/// frame if only their motion is. Shadows that change with the camera alone are not updated until then.
void Renderer::update_staleness(const Frame& around, ObjectReflection& reflection) const {
    Hasher scene;
    Hasher motion;
    add_bytes(scene, reflection.centre);
    for (const LitProbe* probe : frame_probes_) add_bytes(scene, probe->light.version);
    add_bytes(scene, lights_.block);
    for (const auto& type : types_) add_bytes(motion, type->version());
    for (const glm::mat4& joint : around.list.joints) add_bytes(motion, joint);
    const glm::mat3 to_working(rec709_to_working_);
    for (const Draw& draw : around.list.draws) {
        add_draw(scene, draw);
        add_bytes(motion, object_block(draw, to_working, 1.0F - draw.light.second_part));
        add_bytes(motion, std::pair(draw.light.first, draw.light.second));
    }
    const Hash128 new_scene = scene.digest();
    const Hash128 new_motion = motion.digest();
    if (reflection.scene == new_scene && reflection.motion == new_motion) return;
    reflection.stale_faces = ObjectReflection::kFaces;
    if (reflection.scene != new_scene) reflection.all_at_once = true;
    reflection.scene = new_scene;
    reflection.motion = new_motion;
}

void Renderer::draw_surroundings(ecs::World& world, Frame& around, ObjectReflection& reflection) {
    const gpu::Framebuffer& picture = object_reflections_->picture;
    std::swap(frame_data_, reflection.frame_data);
    const int faces = std::exchange(reflection.all_at_once, false) ? reflection.stale_faces : 1;
    for (int i = 0; i < faces; ++i) {
        const int face = std::exchange(reflection.next_face, (reflection.next_face + 1) % ObjectReflection::kFaces);
        --reflection.stale_faces;
        const scene::Camera camera = reflection.camera(face);
        around.camera = &camera;
        around.view_projection = camera.projection(1.0F) * camera.view();
        around.opaque.clear();
        const Frustum frustum(around.view_projection);
        for (Draw& draw : around.list.draws) {
            if (!frustum.may_see(draw.bounds)) continue;
            around.opaque.push_back(&draw);
        }
        report_.reflections_drawn += static_cast<int>(around.opaque.size());
        sort_opaque(around.opaque);
        upload(around);
        bind_frame(around);
        if (around.occlusion) object_reflections_->all_visible.bind(kVisibilityUnit);
        picture.bind();
        picture.clear(glm::vec4(0.0F));
        picture.clear_depth();
        draw_pass(world, around, around.opaque_batches);
        reflection.store(programs_, object_reflections_->triangle, picture, face);
    }
    std::swap(frame_data_, reflection.frame_data);
    reflection.finish();
}

}  // namespace rowland::render
