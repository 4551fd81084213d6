#include "engine/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/lighting/key_lights.h"
#include "engine/render/shader_interface.h"

namespace rowland::render {

namespace {

constexpr const char* kPlainShader = "plain";
constexpr const char* kShadowShader = "shadow";
// For surfaces whose slope changes within a texel: SHADOW_LIFT in surface.glsl is not enough for them.
constexpr float kShadowSlopeBias = 1.0F;

gpu::ProgramDesc shader_pair(const std::string& name) {
    gpu::ProgramDesc desc;
    desc.vertex = "engine/render/shaders/" + name + ".vert.glsl";
    desc.fragment = "engine/render/shaders/" + name + ".frag.glsl";
    return desc;
}

/// Appends values at the next offset at which a buffer may be bound. Returns that offset, bytes.
template <typename T>
std::size_t append(std::vector<std::byte>& bytes, const T* values, std::size_t count = 1) {
    const std::size_t offset = gpu::aligned(bytes.size());
    bytes.resize(offset + count * sizeof(T));
    std::memcpy(&bytes[offset], values, count * sizeof(T));
    return offset;
}

glm::vec3 centre_of(const scene::Bounds& box) {
    return 0.5F * (box.minimum + box.maximum);
}

}  // namespace

Renderer::Renderer(const glm::dmat3& xyz_to_working)
    : xyz_to_working_(xyz_to_working),
      rec709_to_working_(xyz_to_working * colour::rec709_to_xyz()),
      brdf_table_(brdf_texture()),
      lobe_nodes_(lobe_nodes_texture()) {
    programs_.library().add_embedded(shader_files());
    // Filtering across cube faces is off by default in OpenGL and shows as seams.
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void Renderer::add_material_type(std::unique_ptr<MaterialType> type) {
    type->add_shaders(programs_.library());
    types_.push_back(std::move(type));
}

std::vector<std::string> Renderer::gltf_extensions() const {
    std::vector<std::string> names;
    for (const auto& type : types_) {
        if (std::string name = type->gltf_extension(); !name.empty()) names.push_back(std::move(name));
        for (std::string& name : type->gltf_extensions_beside()) names.push_back(std::move(name));
    }
    return names;
}

void Renderer::set_probe(lighting::LightProbe probe) {
    probe_.emplace();
    probe_->light.probe = std::make_shared<const lighting::LightProbe>(std::move(probe));
    put_on_gpu(*probe_, rec709_to_working_);
}

void Renderer::use_key_lights(bool use) {
    analytic_key_lights_ = use;
}

void Renderer::set_shadow_map_size(int size) {
    ROWLAND_CHECK_OP(size, >=, 32);
    if (size != shadow_map_size_) shadow_map_.reset();
    shadow_map_size_ = size;
}

void Renderer::set_effects(const Effects& effects) {
    // Soft shadows sample the map's depth; others sample it with depth comparison.
    if (effects.soft_shadows.has_value() != effects_.soft_shadows.has_value()) shadow_map_.reset();
    object_reflections_.reset();
    effects_ = effects;
}

void Renderer::reload_shaders(const std::filesystem::path& source_tree) {
    programs_.reload(source_tree);
    surface_programs_.clear();
    type_programs_.clear();
    object_reflections_.reset();
}

void Renderer::render(ecs::World& world, const scene::Camera& camera, const gpu::Framebuffer& target, Shading shading) {
    ROWLAND_CHECK(probe_.has_value(), "render() before set_probe()");
    const glm::ivec2 size = target.size();
    Frame frame;
    frame.camera = &camera;
    frame.aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    frame.into_halves = target.holds_halves();
    frame.shading = shading;
    frame.occlusion = effects_.ambient_occlusion && shading == Shading::Full;
    if (!frame.occlusion) occlusion_.reset();
    frame.size = size;
    frame.view_projection = camera.projection(frame.aspect) * camera.view();
    report_ = {};

    take_metered(world);
    update_light(world);
    update_reflection(world, frame);
    frame.list = gather_draws(world, types_, light_features(frame));
    choose_probes(frame);
    update_materials(world, frame);
    select_draws(world, frame);
    select_casters(frame);
    upload(frame);
    bind_frame(frame);
    draw_shadow_map(frame);
    draw_object_reflections(world, frame);
    draw_occlusion(frame);
    {
        const gpu::PassTimes::Scope scope(times_, "opaque");
        target.bind();
        target.clear_depth();
        draw_pass(world, frame, frame.opaque_batches, meter_ ? &*meter_ : nullptr);
    }
    draw_sky(frame);
    if (!frame.blended.empty()) {
        const gpu::PassTimes::Scope scope(times_, "blend");
        target.bind();
        draw_pass(world, frame, frame.blended_batches, meter_ ? &*meter_ : nullptr);
    }
    report_.programs = static_cast<int>(programs_.size());
    if (times_ != nullptr) report_.passes = times_->latest();
}

void Renderer::update_light(ecs::World& world) {
    lights_ = gather_lights(world, rec709_to_working_);
    if (lights_.dropped > 0 && !warned_dropped_lights_) {
        log_warning("the scene has {} lights; only the first {} shine", lights_.dropped + ROWLAND_MAXIMUM_LIGHTS,
                    ROWLAND_MAXIMUM_LIGHTS);
        warned_dropped_lights_ = true;
    }
    update_volumes(world);
}

SurfaceFeatures Renderer::light_features(const Frame& frame) const {
    SurfaceFeatures features = lights_.features();
    const auto has_keys = [](const LitProbe* probe) { return !probe->light.key_lights().empty(); };
    if (std::ranges::any_of(frame_probes_, has_keys)) features |= feature::kKeyLights;
    if (frame.occlusion) features |= feature::kAmbientOcclusion;
    if (lights_.shadow_light && effects_.soft_shadows) features |= feature::kSoftShadows;
    if (reflection_) features |= feature::kLocalReflections;
    if (effects_.object_reflections) features |= feature::kObjectReflections;
    if (effects_.rough_reflections) features |= feature::kRoughReflections;
    return features;
}

void Renderer::update_materials(ecs::World& world, Frame& frame) {
    const Frustum frustum(frame.view_projection);
    bool mirrors = false;
    std::vector<LitEntity> seen;
    std::vector<LitEntity> others;
    for (Draw& draw : frame.list.draws) {
        draw.in_picture = frustum.may_see(draw.bounds);
        (draw.in_picture ? seen : others).push_back({draw.entity, draw.light});
        mirrors = mirrors || (draw.features & feature::kObjectReflections) != 0;
    }
    if (frame.shading == Shading::Unlit) return;
    if (mirrors) seen.insert(seen.end(), others.begin(), others.end());
    for (const auto& type : types_) type->update(world, frame_lights_, seen);
    for (Draw& draw : frame.list.draws) {
        if (draw.type == nullptr || draw.type->draw_control() == nullptr) continue;
        draw.features |= feature::kLightPart;
        if (draw.light.has_second()) continue;
        const std::optional<float> part = draw.type->draw_control()->second_part(world, draw.entity);
        if (part) draw.light = {.first = draw.light.first, .second = draw.light.first, .second_part = *part};
    }
}

/// Hands finished measurements to the types that have a DrawControl.
void Renderer::take_metered(ecs::World& world) {
    const auto is_controlled = [](const auto& type) { return type->draw_control() != nullptr; };
    if (std::ranges::none_of(types_, is_controlled)) return meter_.reset();
    if (!meter_) meter_.emplace();
    meter_->begin_frame();
    const std::optional<std::vector<gpu::MeteredRun>> runs = meter_->take_finished();
    if (!runs) return;
    for (const auto& type : types_)
        if (DrawControl* control = type->draw_control()) control->take(world, *runs);
}

void Renderer::select_draws(ecs::World& world, Frame& frame) {
    const glm::vec3 forward = glm::normalize(frame.camera->target - frame.camera->eye);
    for (Draw& draw : frame.list.draws) {
        if (frame.shading == Shading::Unlit) {
            draw.type = nullptr;
            draw.features = without_light(draw.features);
            draw.light = {};
        }
        const DrawControl* control = draw.type != nullptr ? draw.type->draw_control() : nullptr;
        if (control != nullptr) draw.repeated = 0;  // each is measured by itself
        const auto for_each_slot = [&](const auto& use) {
            use(ProbeSlot::First, draw.first);
            if (draw.light.has_second()) use(ProbeSlot::Second, draw.second);
        };
        bool instance = draw.repeated != 0;
        if (instance && draw.type != nullptr)
            for_each_slot([&](ProbeSlot slot, Draw::Lit& lit) {
                lit.binding = draw.type->binding_key(world, draw.entity, slot);
                instance = instance && lit.binding != 0;
            });
        if (instance) draw.features |= feature::kInstanced;
        // Also for entities that are not in the picture yet, so that no later frame waits for the compiler.
        for_each_slot([&](ProbeSlot slot, Draw::Lit& lit) {
            if (draw.type != nullptr) lit.key = draw.type->program_key(world, draw.entity, slot);
            lit.program = &program_of(world, draw, slot);
            lit.overlay_program = overlay_program_of(world, draw, slot);
            if (control != nullptr) lit.kind = control->kind(world, draw.entity, slot);
            compile_later_programs(world, draw, slot);
        });
        if (frame.occlusion && (draw.features & feature::kAlphaBlend) == 0)
            draw.depth_program = &surface_program(kShadowShader, of_shadow(draw.features) | feature::kFromEye);
        if (!draw.in_picture) {
            draw.first.program = nullptr;
            ++report_.culled;
            continue;
        }
        ++report_.drawn;
        const glm::vec3 from_eye = centre_of(draw.bounds) - frame.camera->eye;
        draw.distance2 = glm::dot(from_eye, from_eye);
        const glm::vec3 half = 0.5F * (draw.bounds.maximum - draw.bounds.minimum);
        frame.farthest = std::max(frame.farthest, glm::dot(from_eye, forward) + glm::dot(half, glm::abs(forward)));
        const bool blends = (draw.features & feature::kAlphaBlend) != 0;
        (blends ? frame.blended : frame.opaque).push_back(&draw);
    }
    sort_opaque(frame.opaque);
    std::ranges::stable_sort(frame.blended, std::greater<>(), &Draw::distance2);  // from back to front
}

void Renderer::select_casters(Frame& frame) {
    if (!lights_.shadow_light || frame.shading == Shading::Unlit) return;
    std::vector<scene::Bounds> boxes;
    for (const Draw& draw : frame.list.draws)
        if ((draw.features & feature::kAlphaBlend) == 0) boxes.push_back(draw.bounds);
    if (boxes.empty()) return;
    const Sphere seen = around_view(*frame.camera, frame.aspect, frame.farthest);
    frame.shadow = fit_shadow(*lights_.shadow_light, boxes, seen, shadow_map_size_);
    for (Draw& draw : frame.list.draws) {
        if ((draw.features & feature::kAlphaBlend) != 0) continue;
        draw.shadow_program = &surface_program(kShadowShader, of_shadow(draw.features));
        if (!frame.shadow.may_see(draw.bounds)) continue;
        frame.casters.push_back(&draw);
    }
}

FrameBlock Renderer::frame_block(const Frame& frame, std::size_t index) const {
    const LitProbe& probe = *frame_probes_[index];
    const scene::Camera& camera = *frame.camera;
    FrameBlock block = {};
    block.view_projection = frame.view_projection;
    block.clip_to_world = glm::inverse(camera.projection(frame.aspect) * glm::mat4(glm::mat3(camera.view())));
    block.world_to_shadow = frame.shadow.world_to_clip;
    block.xyz_to_working = glm::mat4(glm::mat3(xyz_to_working_));
    block.rec709_to_working = glm::mat4(glm::mat3(rec709_to_working_));
    block.eye = glm::vec4(camera.eye, 1.0F);
    for (std::size_t i = 0; i < 9; ++i)
        block.ambient[i] = glm::vec4(glm::vec3(rec709_to_working_ * probe.ambient.coefficients[i]), 0.0F);
    block.environment = glm::vec4(static_cast<float>(probe.environment->map.levels() - 1), probe.environment->scale,
                                  probe.key_irradiance ? probe.key_irradiance->scale : 0.0F, 0.0F);
    constexpr float kFar_m = 1e6F;  // half of the box about the renderer's own probe
    block.box_to_world = index > 0 ? volumes_.boxes[index - 1].box_to_world : glm::mat4(glm::mat3(kFar_m));
    block.world_to_box = index > 0 ? volumes_.boxes[index - 1].world_to_box : glm::mat4(glm::mat3(1.0F / kFar_m));
    block.shadow = glm::vec4(frame.shadow.texel_m, 1.0F / static_cast<float>(shadow_map_size_),
                             frame.into_halves ? 1.0F : 0.0F, 0.0F);
    if (effects_.soft_shadows)
        block.shadow.w = penumbra_over_depth(frame.shadow, shadow_map_size_, effects_.soft_shadows->angular_radius);
    const glm::vec2 pixel = 1.0F / glm::vec2(frame.size);
    block.dome = glm::vec4(0.0F, 0.0F, pixel);
    if (const auto& dome = probe.light.probe->dome) block.dome = glm::vec4(dome->height_m, dome->radius_m, pixel);
    return block;
}

/// Appends what the shaders read of each batch.
void Renderer::stage(std::vector<Batch>& batches) {
    const glm::mat3 to_working(rec709_to_working_);
    std::vector<Placement> placements;
    for (Batch& batch : batches) {
        const Draw& draw = batch.front();
        const ObjectBlock block = object_block(draw, to_working, 1.0F - draw.light.second_part);
        batch.first_block = append(staging_, &block);
        if (draw.light.has_second()) {
            const ObjectBlock second = object_block(draw, to_working, draw.light.second_part);
            batch.second_block = append(staging_, &second);
        }
        if (!draw.is_instance()) continue;
        batch.placements = placements.size() * sizeof(Placement);
        for (const Draw* instance : batch.draws) placements.push_back(placement(*instance));
    }
    if (placements.empty()) return;
    const std::size_t begin = append(staging_, placements.data(), placements.size());
    for (Batch& batch : batches) batch.placements += begin;
}

void Renderer::upload(Frame& frame) {
    staging_.clear();
    frame.frame_offsets.assign(frame_probes_.size(), 0);
    for (std::size_t i = 0; i < frame_probes_.size(); ++i) {
        if (!frame.lit[i]) continue;
        const FrameBlock block = frame_block(frame, i);
        frame.frame_offsets[i] = append(staging_, &block);
    }
    frame.light_offset = append(staging_, &lights_.block);
    frame.opaque_batches = lit_batches(frame.opaque);
    frame.blended_batches = lit_batches(frame.blended);
    frame.caster_batches = shadow_batches(frame.casters);
    for (auto* batches : {&frame.opaque_batches, &frame.blended_batches, &frame.caster_batches}) stage(*batches);
    if (!frame.list.joints.empty()) {
        gpu::require_vertex_storage({.what = "skinned meshes",
                                     .bytes = frame.list.joints.size() * sizeof(glm::mat4),
                                     .remedy = "draw fewer of them, or none"},
                                    limits_);
        frame.joints_offset = append(staging_, frame.list.joints.data(), frame.list.joints.size());
    }
    frame_data_.write(staging_);
}

void Renderer::bind_frame(const Frame& frame) const {
    frame_data_.bind_uniform(kLightBinding, frame.light_offset, sizeof(LightBlock));
    if (!frame.list.joints.empty())
        frame_data_.bind_storage(kJointBinding, frame.joints_offset, frame.list.joints.size() * sizeof(glm::mat4));
    if (reflection_) reflection_->bind();
    bind_probe(frame, 0);
    brdf_table_.bind(kBrdfUnit);
    lobe_nodes_.bind(kLobeNodesUnit);
}

void Renderer::draw_shadow_map(Frame& frame) {
    if (!lights_.shadow_light || frame.shading == Shading::Unlit) return;
    const gpu::PassTimes::Scope scope(times_, "shadow");
    if (!shadow_map_)
        shadow_map_.emplace(gpu::FramebufferDesc{.width = shadow_map_size_,
                                                 .height = shadow_map_size_,
                                                 .colours = {},
                                                 .depth = true,
                                                 .depth_sampling = {.compare_depth = !effects_.soft_shadows}});
    shadow_map_->bind();
    shadow_map_->clear_depth();
    gpu::apply({.cull = gpu::Cull::None, .slope_bias = kShadowSlopeBias});
    for (const Batch& batch : frame.caster_batches) draw_outline(batch, *batch.front().shadow_program);
    report_.shadow_drawn = static_cast<int>(frame.casters.size());
    shadow_map_->depth().bind(kShadowUnit);
}

void Renderer::draw_outline(const Batch& batch, const gpu::Program& program) const {
    const Draw& draw = batch.front();
    frame_data_.bind_uniform(kObjectBinding, batch.first_block, sizeof(ObjectBlock));
    program.use();
    if ((of_shadow(draw.features) & feature::kBaseColourMap) != 0)
        draw.material->base_colour_texture.texture->bind(kFirstMapUnit);
    draw_mesh(batch);
}

void Renderer::draw_mesh(const Batch& batch) const {
    const GpuMesh& mesh = *batch.front().mesh;
    if (batch.front().is_instance())
        mesh.draw_instances(frame_data_, batch.placements, static_cast<int>(batch.draws.size()));
    else
        mesh.draw();
}

void Renderer::draw_occlusion(const Frame& frame) {
    if (!frame.occlusion) return;
    const gpu::PassTimes::Scope scope(times_, "occlusion");
    if (!occlusion_) occlusion_.emplace();
    const glm::ivec2 depth_size = occlusion_->begin(frame.size).size();
    for (const Batch& batch : frame.opaque_batches) {
        const auto state = state_of(batch.front(), depth_size);
        if (!state) continue;
        gpu::apply(*state);
        draw_outline(batch, *batch.front().depth_program);
    }
    occlusion_->draw(programs_, *frame.camera, frame.aspect, lights_.shadow_light, *effects_.ambient_occlusion);
    occlusion_->visibility().bind(kVisibilityUnit);
}

void Renderer::bind_surface(const Draw& draw) const {
    for (const SurfaceMap& map : kSurfaceMaps)
        if ((draw.features & map.bit) != 0) (draw.material->*map.texture).texture->bind(map.unit);
}

void Renderer::draw_pass(ecs::World& world, const Frame& frame, const std::vector<Batch>& batches,
                         gpu::DrawMeter* meter) {
    for (const Batch& batch : batches) {
        const auto state = state_of(batch.front(), frame.size);
        if (!state) continue;
        gpu::apply(*state);
        draw_lit(world, frame, batch, ProbeSlot::First, meter);
        if (!batch.front().light.has_second()) continue;
        gpu::apply(adding(*state));
        draw_lit(world, frame, batch, ProbeSlot::Second, meter);
    }
    if (meter != nullptr) meter->end_run();
}

void Renderer::draw_lit(ecs::World& world, const Frame& frame, const Batch& batch, ProbeSlot slot,
                        gpu::DrawMeter* meter) const {
    const Draw& draw = batch.front();
    const bool second = slot == ProbeSlot::Second;
    const Draw::Lit& lit = second ? draw.second : draw.first;
    if (meter != nullptr && lit.kind == 0) meter->end_run();
    const gpu::DrawMeter::Scope scope(lit.kind != 0 ? meter : nullptr, lit.kind, object_number(draw.entity));
    bind_probe(frame, second ? draw.light.second : draw.light.first);
    frame_data_.bind_uniform(kObjectBinding, second ? batch.second_block : batch.first_block, sizeof(ObjectBlock));
    lit.program->use();
    bind_surface(draw);
    if (draw.type != nullptr) draw.type->bind(world, draw.entity, slot, *lit.program);
    if ((draw.features & feature::kObjectReflections) != 0) draw.reflection->bind(*lit.program);
    draw_mesh(batch);
    if (lit.overlay_program == nullptr) return;
    lit.overlay_program->use();
    draw.type->bind_overlay(world, draw.entity, slot, *lit.overlay_program);
    draw.mesh->draw();
}

void Renderer::draw_sky(const Frame& frame) {
    const gpu::PassTimes::Scope scope(times_, "sky");
    gpu::apply({.depth_test = gpu::DepthTest::LessEqual, .depth_write = false, .cull = gpu::Cull::None});
    bind_probe(frame, 0);
    programs_.get(shader_pair("sky")).use();
    no_vertices_.draw(3);
}

const gpu::Program& Renderer::program_of(ecs::World& world, const Draw& draw, ProbeSlot slot) {
    if (draw.type == nullptr) return surface_program(kPlainShader, draw.features);
    const std::uint64_t key = (slot == ProbeSlot::First ? draw.first : draw.second).key;
    const auto found = key == 0 ? type_programs_.end() : type_programs_.find({draw.type, key, draw.features});
    if (found != type_programs_.end()) return *found->second;
    gpu::ProgramDesc desc = draw.type->program(world, draw.entity, slot);
    add_defines(draw.features, desc);
    const gpu::Program& program = programs_.get(desc);
    if (key != 0) type_programs_.emplace(std::tuple(draw.type, key, draw.features), &program);
    return program;
}

const gpu::Program* Renderer::overlay_program_of(ecs::World& world, const Draw& draw, ProbeSlot slot) {
    if (draw.type == nullptr || (draw.features & feature::kPassesLight) == 0) return nullptr;
    std::optional<gpu::ProgramDesc> desc = draw.type->overlay_program(world, draw.entity, slot);
    if (!desc) return nullptr;
    add_defines(draw.features, *desc);
    return &programs_.get(*desc);
}

void Renderer::compile_later_programs(ecs::World& world, const Draw& draw, ProbeSlot slot) {
    if (draw.type == nullptr) return;
    const SurfaceFeatures features = draw.features & ~feature::kInstanced;
    for (LaterProgram& later : draw.type->later_programs(world, draw.entity, slot)) {
        add_defines(features | (later.draws_instances && draw.repeated != 0 ? feature::kInstanced : 0), later.desc);
        programs_.get(later.desc);
    }
}

const gpu::Program& Renderer::surface_program(const char* shader, SurfaceFeatures features) {
    const gpu::Program*& known = surface_programs_[{shader, features}];
    if (known == nullptr) {
        gpu::ProgramDesc desc = shader_pair(shader);
        desc.defines = defines_of(features);
        known = &programs_.get(desc);
    }
    return *known;
}

}  // namespace rowland::render
