#include "engine/render/draw_list.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <tuple>
#include <utility>

#include "engine/core/check.h"
#include "engine/render/scene_lights.h"
#include "engine/scene/animation.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

/// Appends the entity's joint matrices and sets its posed bounds, if it has a skin and its mesh has joints.
void add_pose(ecs::World& world, Draw& draw, std::vector<glm::mat4>& joints) {
    const scene::Skin* skin = draw.mesh->is_skinned() ? world.find<scene::Skin>(draw.entity) : nullptr;
    if (skin == nullptr) return;
    const std::vector<glm::mat4> pose = scene::joint_matrices(world, *skin);
    ROWLAND_CHECK_OP(pose.size(), >=, draw.mesh->joint_count());
    draw.skinned = true;
    draw.first_joint = joints.size();
    draw.bounds = transformed(posed_bounds(draw.mesh->bounds(), pose), draw.matrix);
    joints.insert(joints.end(), pose.begin(), pose.end());
}

}  // namespace

DrawList gather_draws(ecs::World& world, std::span<const std::unique_ptr<MaterialType>> types, SurfaceFeatures lights) {
    DrawList list;
    world.view<MeshInstance, StandardMaterial, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const MeshInstance& mesh, const StandardMaterial& material,
            const scene::WorldMatrix& world_matrix) {
            Draw draw{.entity = entity,
                      .mesh = mesh.gpu.get(),
                      .material = &material,
                      .type = owner_of(world, entity, types, "scene"),
                      .matrix = world_matrix.matrix,
                      .bounds = transformed(mesh.gpu->bounds(), world_matrix.matrix),
                      .mirrored = glm::determinant(glm::mat3(world_matrix.matrix)) < 0.0F};
            draw.columns = world.find<PictureColumns>(entity);
            add_pose(world, draw, list.joints);
            draw.features = features_of(material, *mesh.gpu, draw.skinned, lights);
            if (draw.type == nullptr) draw.features &= ~feature::kPassesLight;
            if (const auto* reflects = world.find<ReflectsObjects>(entity))
                draw.reflects = reflects->group;
            else
                draw.features &= ~feature::kObjectReflections;
            list.draws.push_back(draw);
        });
    return list;
}

UvTransform uv_transform(const scene::TextureTransform& transform) {
    const float c = std::cos(transform.rotation);
    const float s = std::sin(transform.rotation);
    return {.linear = {c * transform.scale.x, -s * transform.scale.x, s * transform.scale.y, c * transform.scale.y},
            .offset = transform.offset};
}

ObjectBlock object_block(const Draw& draw, const glm::mat3& rec709_to_working, float part) {
    const StandardMaterial& material = *draw.material;
    // Textures and vertex colours multiply in Rec.709; what they do not touch is converted here, once.
    const bool varied = (draw.features & (feature::kBaseColourMap | feature::kColours)) != 0;
    const bool emission_varied = (draw.features & feature::kEmissiveMap) != 0;
    ObjectBlock block = {};
    block.object_to_world = draw.matrix;
    block.normal_to_world = glm::mat4(glm::inverseTranspose(glm::mat3(draw.matrix)));
    block.base_colour =
        glm::vec4(varied ? material.base_colour : rec709_to_working * material.base_colour, material.alpha);
    block.metallic_roughness =
        glm::vec4(material.metallic, material.roughness, material.alpha_cutoff, material.clear_coat);
    block.emissive = glm::vec4(emission_varied ? material.emissive : rec709_to_working * material.emissive,
                               material.clear_coat_roughness);
    block.map_strength = glm::vec4(material.normal_scale, material.occlusion_strength, draw.mirrored ? -1.0F : 1.0F,
                                   static_cast<float>(draw.first_joint));
    block.light_part = glm::vec4(part, 0.0F, 0.0F, 0.0F);
    if ((draw.features & feature::kTextureTransformExtension) == 0) return block;
    for (std::size_t i = 0; i < kSurfaceMaps.size(); ++i) {
        const UvTransform uv = uv_transform((material.*kSurfaceMaps[i].texture).transform);
        block.uv_linear[i] = uv.linear;
        block.uv_offset[i] = glm::vec4(uv.offset, 0.0F, 0.0F);
    }
    return block;
}

void sort_opaque(std::vector<const Draw*>& draws) {
    std::ranges::stable_sort(draws, {}, [](const Draw* draw) {
        return std::tuple(draw->first.program, draw->first.kind, draw->light.first, draw->first.key, draw->distance2);
    });
}

namespace {

gpu::Scissor columns_of(const PictureColumns& columns, glm::ivec2 size) {
    const auto edge = [&](float fraction) {
        return static_cast<int>(std::lround(std::clamp(fraction, 0.0F, 1.0F) * static_cast<float>(size.x)));
    };
    const int begin = edge(columns.begin);
    return {.x = begin, .y = 0, .width = std::max(edge(columns.end) - begin, 0), .height = size.y};
}

gpu::Blend blend_of(SurfaceFeatures features) {
    if ((features & feature::kPassesLight) != 0) return gpu::Blend::Filter;
    return (features & feature::kAlphaBlend) != 0 ? gpu::Blend::Over : gpu::Blend::Off;
}

}  // namespace

std::optional<gpu::PipelineState> state_of(const Draw& draw, glm::ivec2 size) {
    const gpu::Blend blend = blend_of(draw.features);
    gpu::PipelineState state{.depth_write = blend == gpu::Blend::Off,
                             .cull = draw.material->double_sided ? gpu::Cull::None : gpu::Cull::Back,
                             .blend = blend,
                             .front = draw.mirrored ? gpu::FrontFace::Clockwise : gpu::FrontFace::CounterClockwise};
    if (draw.columns != nullptr) {
        state.scissor = columns_of(*draw.columns, size);
        if (state.scissor->width == 0) return std::nullopt;
    }
    return state;
}

gpu::PipelineState adding(const gpu::PipelineState& first) {
    gpu::PipelineState state = first;
    state.depth_test = gpu::DepthTest::LessEqual;
    state.depth_write = false;
    state.blend = first.blend == gpu::Blend::Over ? gpu::Blend::AddOver : gpu::Blend::Add;
    return state;
}

}  // namespace rowland::render
