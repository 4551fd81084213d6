#include "engine/render/local_reflection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "engine/math/sh_basis.h"
#include "engine/render/bindings.h"
#include "engine/render/draw_list.h"
#include "engine/render/material.h"
#include "engine/render/shaders/reflection_block.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

glm::vec2 along_plane(const glm::vec3& position) {
    return {position.x, position.z};
}

glm::vec3 ambient_radiance(const PlaneLight& light, const glm::dvec3& normal) {
    std::array<double, 9> basis = {};
    math::evaluate_sh(normal, 3, basis);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * light.ambient.coefficients[i];
    for (const lighting::KeyLight& key : light.keys) sum += lighting::irradiance(key, normal) / std::numbers::pi;
    return glm::max(light.rec709_to_working * glm::vec3(sum), 0.0F);
}

void add_lights(const SceneLights& lights, const glm::vec3& normal, ReflectionBlock& block) {
    for (int i = 0; i < static_cast<int>(lights.block.light_counts.x); ++i) {
        const Light& light = lights.block.lights[i];
        const float cosine = std::max(glm::dot(glm::vec3(light.position), normal), 0.0F);
        const bool shadowed = i == 0 && lights.shadow_light;
        (shadowed ? block.plane_lamp : block.plane_ambient) += light.strength * cosine / std::numbers::pi_v<float>;
    }
}

/// Also the map's transform.
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
            height_ = glm::dot(normal, glm::vec3(matrix * glm::vec4(top.centre, 1.0F)));
            block->plane_ambient = glm::vec4(ambient_radiance(light, glm::dvec3(normal)), 0.0F);
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

}  // namespace rowland::render
