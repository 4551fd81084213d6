#include "metal_surface.h"

#include <engine/core/error.h>
#include <engine/render/material.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <span>

namespace metal {

namespace {

using namespace rowland;

constexpr const char* kExtension = "EXAMPLE_materials_metal";
constexpr const char* kFragmentFile = "metal.frag.glsl";
constexpr const char* kFragmentText = R"(#version 450 core
#define MATERIAL_SPECULAR
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"

uniform vec3 n;
uniform vec3 k;

// Unpolarised reflectance of a conductor [Born & Wolf, Principles of Optics, 14.2].
vec3 conductor_reflectance(float cosine) {
    float c2 = cosine * cosine;
    float s2 = 1.0 - c2;
    vec3 difference = n * n - k * k - s2;
    vec3 sum = sqrt(difference * difference + 4.0 * n * n * k * k);  // a^2 + b^2
    vec3 twice_ac = 2.0 * cosine * sqrt(max(0.5 * (sum + difference), 0.0));
    vec3 across = (sum + c2 - twice_ac) / (sum + c2 + twice_ac);
    vec3 along = across * (c2 * sum + s2 * s2 - twice_ac * s2) / (c2 * sum + s2 * s2 + twice_ac * s2);
    return 0.5 * (across + along);
}

// `light` and the result are in the working space.
vec3 reflect_specular(vec3 light, vec3 f0, float cosine) {
    mat3 to_working = mat3(rec709_to_working);
    return to_working * (conductor_reflectance(cosine) * (inverse(to_working) * light));
}

#include "engine/render/shaders/shading.glsl"

// The metallic-roughness base alone: nothing covers it, nothing is added.
void main() {
    read_screen_visibility();
    write_surface(MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0)));
}
)";

glm::vec3 three_numbers(const nlohmann::json& extension, const char* key, const std::string& file,
                        const std::string& pointer) {
    const auto found = extension.find(key);
    const bool three = found != extension.end() && found->is_array() && found->size() == 3;
    glm::vec3 values(0.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        if (!three || !(*found)[i].is_number() || (*found)[i].get<float>() < 0.0F)
            refuse_input(file, pointer + "/" + key, three ? (*found)[i].dump() : "no list of three",
                         "three numbers from 0 up: red, green, blue");
        values[static_cast<int>(i)] = (*found)[i].get<float>();
    }
    return values;
}

MetalSurface metal_surface(const nlohmann::json& extension, const std::string& file, const std::string& pointer) {
    return {.n = three_numbers(extension, "n", file, pointer), .k = three_numbers(extension, "k", file, pointer)};
}

class MetalType final : public render::MaterialType {
 public:
    std::string name() const override { return "metal"; }
    std::string gltf_extension() const override { return kExtension; }
    void attach(ecs::World& world, ecs::Entity entity, const render::MaterialExtension& extension,
                render::SurfaceTextures& /*textures*/) override {
        world.add(entity, metal_surface(extension.object, extension.file, extension.pointer));
    }
    void add_shaders(gpu::ShaderLibrary& library) const override { library.add(kFragmentFile, kFragmentText); }
    bool owns(ecs::World& world, ecs::Entity entity) const override {
        return world.find<MetalSurface>(entity) != nullptr;
    }
    gpu::ProgramDesc program(ecs::World& /*world*/, ecs::Entity /*entity*/, render::ProbeSlot /*slot*/) const override {
        return {.vertex = "engine/render/shaders/plain.vert.glsl", .fragment = kFragmentFile};
    }
    void update(ecs::World& /*world*/, std::span<const render::FrameLight> /*lights*/,
                std::span<const render::LitEntity> /*seen*/) override {}  // nothing to prepare
    void bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot /*slot*/,
              const gpu::Program& program) const override {
        const MetalSurface& surface = world.get<MetalSurface>(entity);
        program.set("n", surface.n);
        program.set("k", surface.k);
    }
};

}  // namespace

void register_module(cook::Registry& registry) {
    registry.add_gltf_extension(
        {.name = kExtension,
         .describe = [](const nlohmann::json& extension, const std::string& file, const std::string& pointer) {
             metal_surface(extension, file, pointer);
             return std::string("a metal");
         }});
}

void register_module(render::Renderer& renderer) {
    renderer.add_material_type(std::make_unique<MetalType>());
}

}  // namespace metal
