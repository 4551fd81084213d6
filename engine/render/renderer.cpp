#include "engine/render/renderer.h"

#include <glm/gtc/matrix_inverse.hpp>

#include "engine/colour/working_space.h"
#include "engine/core/check.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/math/sh_basis.h"
#include "engine/render/brdf_table.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/shader_files.h"
#include "engine/render/shaders/frame_block.h"
#include "engine/render/shaders/object_block.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

constexpr int kBrdfTableSize = 64;
constexpr unsigned kFrameBinding = 0;
constexpr unsigned kObjectBinding = 1;
constexpr unsigned kEnvironmentUnit = 0;
constexpr unsigned kBrdfUnit = 1;

gpu::Texture make_brdf_texture() {
    gpu::Texture texture({.format = gpu::Format::RG16F, .width = kBrdfTableSize, .height = kBrdfTableSize});
    const std::vector<glm::vec2> table = bake_brdf_table(kBrdfTableSize);
    texture.upload(std::span<const float>(&table[0].x, 2 * table.size()));
    return texture;
}

gpu::ProgramDesc plain_program(Shading shading) {
    gpu::ProgramDesc desc;
    desc.vertex = "engine/render/shaders/plain.vert.glsl";
    desc.fragment =
        shading == Shading::Full ? "engine/render/shaders/plain.frag.glsl" : "engine/render/shaders/unlit.frag.glsl";
    return desc;
}

gpu::ProgramDesc sky_program() {
    gpu::ProgramDesc desc;
    desc.vertex = "engine/render/shaders/sky.vert.glsl";
    desc.fragment = "engine/render/shaders/sky.frag.glsl";
    return desc;
}

std::string key_of(const gpu::ProgramDesc& desc) {
    std::string key = desc.vertex + '\n' + desc.fragment;
    for (const auto& [name, value] : desc.defines) key.append("\n").append(name).append("=").append(value);
    return key;
}

/// Adds a distant light of irradiance E: L(s) = E δ(s − d), so l_i += E Y_i(d).
void add_directional(const scene::DirectionalLight& light, lighting::ShLight& sh) {
    std::vector<double> basis(sh.coefficients.size());
    math::evaluate_sh(glm::normalize(glm::dvec3(light.direction)), sh.bands, basis);
    for (std::size_t i = 0; i < basis.size(); ++i) sh.coefficients[i] += basis[i] * glm::dvec3(light.irradiance);
}

}  // namespace

Renderer::Renderer(const glm::dmat3& xyz_to_working)
    : xyz_to_working_(xyz_to_working),
      rec709_to_working_(xyz_to_working * colour::rec709_to_xyz()),
      frame_buffer_(sizeof(FrameBlock)),
      object_buffer_(sizeof(ObjectBlock)),
      brdf_table_(make_brdf_texture()) {
    library_.add_embedded(shader_files());
    // Filtering across cube faces is off by default in OpenGL and shows as seams.
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void Renderer::add_material_type(std::unique_ptr<MaterialType> type) {
    type->add_shaders(library_);
    types_.push_back(std::move(type));
}

void Renderer::set_probe(const lighting::LightProbe& probe) {
    environment_.emplace(probe, rec709_to_working_);
    probe_sh_ = probe.sh;
}

void Renderer::reload_shaders(const std::filesystem::path& source_tree) {
    gpu::ShaderLibrary library = library_;
    library.set_source_folder(source_tree);
    std::map<std::string, CompiledProgram> programs;
    for (const auto& [key, compiled] : programs_)
        programs.emplace(key, CompiledProgram{compiled.desc, gpu::Program(library, compiled.desc)});
    library_ = std::move(library);
    programs_ = std::move(programs);
}

void Renderer::render(ecs::World& world, const scene::Camera& camera, const gpu::Framebuffer& target, Shading shading) {
    ROWLAND_CHECK(environment_.has_value(), "render() before set_probe()");
    update_light(world);
    if (shading == Shading::Full)
        for (const auto& type : types_) type->update(world, light_);

    target.bind();
    target.clear_depth();
    const glm::ivec2 size = target.size();
    upload_frame(camera, static_cast<float>(size.x) / static_cast<float>(size.y));
    draw_entities(world, shading);
    draw_sky();
}

void Renderer::update_light(ecs::World& world) {
    lighting::ShLight sh = probe_sh_;
    key_irradiance_ = glm::vec3(0.0F);
    int lights = 0;
    world.view<scene::DirectionalLight>().each([&](const scene::DirectionalLight& light) {
        ROWLAND_CHECK_OP(++lights, <=, 1);  // the forward shader has one
        add_directional(light, sh);
        key_direction_ = glm::normalize(light.direction);
        key_irradiance_ = glm::vec3(rec709_to_working_ * glm::dvec3(light.irradiance));
    });
    if (light_.version != 0 && sh.coefficients == light_.sh.coefficients) return;
    light_.sh = std::move(sh);
    ++light_.version;
}

void Renderer::upload_frame(const scene::Camera& camera, float aspect) {
    const glm::mat4 projection = camera.projection(aspect);
    FrameBlock block = {};
    block.view_projection = projection * camera.view();
    block.clip_to_world = glm::inverse(projection * glm::mat4(glm::mat3(camera.view())));
    block.eye = glm::vec4(camera.eye, 1.0F);
    for (std::size_t i = 0; i < 9; ++i) block.ambient[i] = environment_->ambient()[i];
    block.key_direction = glm::vec4(key_direction_, 0.0F);
    block.key_irradiance = glm::vec4(key_irradiance_, 0.0F);
    block.environment =
        glm::vec4(static_cast<float>(environment_->map().levels() - 1), environment_->radiance_scale(), 0.0F, 0.0F);
    block.xyz_to_working = glm::mat4(glm::mat3(xyz_to_working_));
    frame_buffer_.update_value(block);
    frame_buffer_.bind_uniform(kFrameBinding);
    object_buffer_.bind_uniform(kObjectBinding);
    environment_->map().bind(kEnvironmentUnit);
    brdf_table_.bind(kBrdfUnit);
}

void Renderer::draw_entities(ecs::World& world, Shading shading) {
    gpu::apply({});
    world.view<MeshInstance, StandardMaterial, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const MeshInstance& mesh, const StandardMaterial& material,
            const scene::WorldMatrix& world_matrix) {
            ObjectBlock block = {};
            block.object_to_world = world_matrix.matrix;
            block.normal_to_world = glm::mat4(glm::inverseTranspose(glm::mat3(world_matrix.matrix)));
            block.base_colour = glm::vec4(glm::vec3(rec709_to_working_ * glm::dvec3(material.base_colour)), 1.0F);
            block.metallic_roughness = glm::vec4(material.metallic, material.roughness, 0.0F, 0.0F);
            object_buffer_.update_value(block);

            const MaterialType* type = shading == Shading::Full ? type_of(world, entity) : nullptr;
            const gpu::Program& program = program_for(type ? type->program(world, entity) : plain_program(shading));
            program.use();
            if (type) type->bind(world, entity, program);
            mesh.gpu->draw();
        });
}

void Renderer::draw_sky() {
    gpu::apply({.depth_test = gpu::DepthTest::LessEqual, .depth_write = false, .cull = gpu::Cull::None});
    program_for(sky_program()).use();
    no_vertices_.draw(3);
}

const MaterialType* Renderer::type_of(ecs::World& world, ecs::Entity entity) const {
    for (const auto& type : types_)
        if (type->owns(world, entity)) return type.get();
    return nullptr;
}

const gpu::Program& Renderer::program_for(const gpu::ProgramDesc& desc) {
    const std::string key = key_of(desc);
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second.program;
    return programs_.emplace(key, CompiledProgram{desc, gpu::Program(library_, desc)}).first->second.program;
}

}  // namespace rowland::render
