#include "engine/render/draw_list.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <tuple>
#include <unordered_map>
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

/// What a number of Draw::repeated stands for.
struct Alike {
    const GpuMesh* mesh;
    const MaterialType* type;
    SurfaceFeatures features;
    const StandardMaterial* material;

    friend bool operator==(const Alike& a, const Alike& b) {
        return std::tie(a.mesh, a.type, a.features) == std::tie(b.mesh, b.type, b.features) &&
               *a.material == *b.material;
    }
};

struct HashOfAlike {
    std::size_t operator()(const Alike& alike) const {
        const StandardMaterial& material = *alike.material;
        std::size_t hash = std::hash<const void*>()(alike.mesh);
        for (const float value : {material.base_colour.x, material.base_colour.y, material.base_colour.z,
                                  material.metallic, material.roughness})
            hash = 31 * hash + std::hash<float>()(value);
        return 31 * hash + std::hash<const void*>()(material.base_colour_texture.texture.get());
    }
};

void find_repeated(std::vector<Draw>& draws) {
    struct Found {
        std::size_t number;
        int count = 0;
    };
    std::unordered_map<Alike, Found, HashOfAlike> found;
    constexpr SurfaceFeatures kNever = feature::kSkinned | feature::kAlphaBlend;
    for (Draw& draw : draws) {
        if ((draw.features & kNever) != 0 || draw.columns != nullptr) continue;
        Found& alike = found.try_emplace({draw.mesh, draw.type, draw.features, draw.material}, Found{found.size() + 1})
                           .first->second;
        ++alike.count;
        draw.repeated = alike.number;
    }
    std::vector<bool> many(found.size() + 1, false);
    for (const auto& [alike, of] : found) many[of.number] = of.count >= kLeastInstances;
    for (Draw& draw : draws)
        if (!many[draw.repeated]) draw.repeated = 0;
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
    find_repeated(list.draws);
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
        const auto alike = draw->is_instance()
                               ? std::tuple(draw->first.binding, draw->repeated, draw->mirrored, draw->light.second,
                                            draw->light.second_part)
                               : std::tuple(std::uint64_t{0}, std::size_t{0}, false, std::size_t{0}, 0.0F);
        return std::tuple(draw->first.program, draw->first.kind, draw->light.first, draw->first.key, alike,
                          draw->distance2);
    });
}

namespace {

bool lit_alike(const Draw& a, const Draw& b) {
    const auto seen = [](const Draw& draw) {
        return std::tie(draw.repeated, draw.light, draw.mirrored, draw.reflects, draw.features);
    };
    const auto bound = [](const Draw::Lit& lit) { return std::tie(lit.program, lit.key, lit.binding); };
    return seen(a) == seen(b) && bound(a.first) == bound(b.first) && bound(a.second) == bound(b.second);
}

bool same_shadow(const Draw& a, const Draw& b) {
    return a.repeated == b.repeated && a.shadow_program == b.shadow_program;
}

std::vector<Batch> batches(std::span<const Draw* const> draws, bool (*alike)(const Draw&, const Draw&)) {
    std::vector<Batch> result;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Draw& first = *draws[begin];
        if (i > begin && first.is_instance() && draws[i]->is_instance() && alike(first, *draws[i])) {
            result.back().draws = draws.subspan(begin, i - begin + 1);
        } else {
            begin = i;
            result.push_back({.draws = draws.subspan(i, 1)});
        }
    }
    return result;
}

}  // namespace

std::vector<Batch> lit_batches(std::span<const Draw* const> draws) {
    return batches(draws, lit_alike);
}

std::vector<Batch> shadow_batches(std::vector<const Draw*>& draws) {
    std::ranges::stable_sort(draws, {}, [](const Draw* draw) {
        return std::pair(draw->shadow_program, draw->is_instance() ? draw->repeated : 0);
    });
    return batches(draws, same_shadow);
}

Placement placement(const Draw& draw) {
    return {.object_to_world = glm::mat4x3(draw.matrix),
            .normal_to_world = glm::inverseTranspose(glm::mat3(draw.matrix))};
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
