#include "editor/inspector/preview.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <span>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/text.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/gpu/shader_library.h"
#include "engine/render/scene_lights.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/glare_pattern.h"
#include "modules/diffraction/runtime/vertex_light.h"
#include "modules/material_types.h"
#include "modules/thin_film/runtime/film_surface.h"

namespace rowland::inspector {

namespace {

constexpr float kStrokeCell = 16.0F;  ///< pixels between strokes
constexpr float kStrokeStep = 1e-4F;  ///< metres; small against an object of 0.1 m
constexpr bool kEvenMoments = true;   ///< grooves are undirected

}  // namespace

/// groove_overlay.vert.glsl and groove_overlay.frag.glsl.
std::span<const EmbeddedFile> overlay_shaders();

namespace {

gpu::Program overlay_program() {
    gpu::ShaderLibrary library;
    library.add_embedded(overlay_shaders());
    return {library,
            {.vertex = "editor/inspector/groove_overlay.vert.glsl",
             .fragment = "editor/inspector/groove_overlay.frag.glsl"}};
}

constexpr glm::vec3 kUp(0.0F, 1.0F, 0.0F);

/// The rotation about the x axis at which each shape shows its colours.
float tilt_deg(PreviewShape shape) {
    if (shape == PreviewShape::Disc) return 52.0F;
    return shape == PreviewShape::Card || shape == PreviewShape::Sheet ? -28.0F : 0.0F;
}

constexpr int kFramesToFill = 90;  ///< upper bound of the frames that maps take to fill

/// The probe keeps its axes; everything else is rotated in the opposite direction, which gives the same picture.
glm::mat4 stage_rotation(const Stage& stage) {
    return glm::rotate(glm::mat4(1.0F), -glm::radians(stage.rotation_deg), kUp);
}

/// The transform of the object's root.
scene::Transform root_transform(const PreviewInputs& inputs) {
    const glm::mat4 to_world = glm::rotate(glm::translate(stage_rotation(inputs.stage), kObjectPosition),
                                           glm::radians(tilt_deg(inputs.object->shape)), {1.0F, 0.0F, 0.0F});
    scene::Transform at{.translation = glm::vec3(to_world[3]), .rotation = glm::quat_cast(glm::mat3(to_world))};
    if (!inputs.object->scene) return at;
    const scene::Transform& fit = inputs.object->scene->fit;
    at.translation += at.rotation * fit.translation;
    at.scale = fit.scale;
    return at;
}

scene::Camera rotated_camera(const PreviewInputs& inputs) {
    const glm::mat4 rotation = stage_rotation(inputs.stage);
    scene::Camera camera = opening_camera();
    camera.eye = glm::vec3(rotation * glm::vec4(inputs.eye, 1.0F));
    camera.target = glm::vec3(rotation * glm::vec4(inputs.target, 1.0F));
    return camera;
}

}  // namespace

GrooveOverlay::GrooveOverlay() : program_(overlay_program()) {}

void GrooveOverlay::begin(glm::ivec2 size, const glm::mat4& world_to_clip) {
    if (!target_ || target_->size() != size)
        target_.emplace(
            gpu::FramebufferDesc{.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}, .depth = true});
    target_->bind();
    gpu::apply({.depth_test = gpu::DepthTest::Less, .depth_write = true, .cull = gpu::Cull::None});
    target_->clear(glm::vec4(0.0F));
    target_->clear_depth();
    program_.use();
    program_.set("world_to_clip", world_to_clip);
    program_.set("size", glm::vec2(size));
    program_.set("cell", kStrokeCell);
    program_.set("step_length", kStrokeStep);
}

void GrooveOverlay::draw(const render::GpuMesh& mesh, const glm::mat4& object_to_world, const CookedSurface* grating) {
    const glm::mat3 linear(object_to_world);
    const float determinant = glm::determinant(linear);
    if (determinant == 0.0F) return;
    program_.set("object_to_world", object_to_world);
    program_.set("normal_to_world", glm::transpose(glm::inverse(linear)));
    program_.set("mirroring", determinant < 0.0F ? -1.0F : 1.0F);
    const bool chosen = grating != nullptr && grating->material != nullptr;
    program_.set("chosen", chosen ? 1 : 0);
    if (chosen) {
        program_.set("groove_rotation", static_cast<float>(grating->groove_rotation));
        program_.set("mapped", grating->grooves ? 1 : 0);
        if (grating->grooves) {
            program_.set("uv_set", grating->grooves->uv_set());
            grating->grooves->bind(kEvenMoments, program_);
        }
    }
    mesh.draw();
}

scene::Camera opening_camera() {
    scene::Camera camera;
    camera.eye = {0.0F, 0.14F, 0.38F};
    camera.target = {0.0F, 0.047F, 0.0F};
    camera.vertical_field_of_view = 0.36F;
    return camera;
}

Preview::Side::Side(const post::OcioConfig& config, bool still) : picture(config, {}, {1, 1}) {
    diffraction::DiffractionSettings settings;
    if (still) settings.map_pace = diffraction::MapPace::Whole;
    modules::register_material_types(picture.renderer(), {.diffraction = settings});
    root = world.create();
    world.add(root, scene::Transform{});
}

void Preview::Side::show(const PreviewInputs& inputs, const CookedSurfaces& wanted) {
    if (std::exchange(light, inputs.light) != inputs.light) picture.set_probe(light->probe);
    if (std::exchange(object, inputs.object) != inputs.object) {
        for (const ecs::Entity entity : all) world.destroy(entity);
        all.clear();
        tops.clear();
        drawn.clear();
        surfaces.clear();
        if (object->scene)
            add_scene();
        else
            add_shape();
    }
    surfaces.resize(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (std::exchange(surfaces[i], wanted[i]) != wanted[i]) show_surface(i);
    std::erase_if(uploaded, [&](const auto& entry) {
        return std::ranges::none_of(
            surfaces, [&](const auto& surface) { return surface && surface->material.get() == entry.first; });
    });
    set_glare(inputs.glare_of && *inputs.glare_of < wanted.size() ? wanted[*inputs.glare_of] : nullptr);
}

ecs::Entity Preview::Side::add(ecs::Entity parent, const scene::Transform& local) {
    const ecs::Entity entity = all.emplace_back(world.create());
    world.add(entity, scene::Transform(local));
    world.add(entity, scene::Parent{parent});
    return entity;
}

void Preview::Side::add_shape() {
    const ecs::Entity entity = add(root, {});
    world.add(entity, render::MeshInstance(object->parts.meshes.front()));
    drawn.push_back({entity, 0, 0, {}});
    set_own_material(drawn.back());
}

void Preview::Side::add_scene() {
    const scene::ImportedScene& imported = object->scene->imported;
    std::vector<ecs::Entity> nodes;
    for (const scene::ImportedNode& node : imported.nodes) {
        nodes.push_back(add(node.parent ? nodes[*node.parent] : root, node.local));
        if (!node.parent) tops.emplace_back(nodes.back(), node.local);
    }
    for (const scene::ImportedInstance& instance : imported.instances) {
        const ecs::Entity entity = add(nodes[instance.node], {});
        world.add(entity, render::MeshInstance(object->parts.meshes[instance.mesh]));
        drawn.push_back({entity, instance.mesh, instance.material, instance.name});
        set_own_material(drawn.back());
    }
}

void Preview::Side::set_own_material(const Drawn& part) {
    static const scene::ImportedScene empty;
    render::SurfaceTextures none(empty);
    world.add(part.entity, part.material && object->scene
                               ? render::StandardMaterial(object->parts.materials[*part.material])
                               : render::make_material(nullptr, none));
}

void Preview::Side::show_surface(std::size_t material) {
    std::vector<ecs::Entity> parts;
    for (const Drawn& part : drawn) {
        if (part.material != material) continue;
        set_own_material(part);
        world.remove<diffraction::DiffractionSurface>(part.entity);
        world.remove<thin_film::FilmSurface>(part.entity);
        parts.push_back(part.entity);
    }
    if (surfaces[material]) add_surface(*surfaces[material], parts);
}

void Preview::Side::add_surface(const CookedSurface& surface, const std::vector<ecs::Entity>& parts) {
    if (surface.material) {
        auto& material = uploaded[surface.material.get()];
        if (!material) material = diffraction::make_gpu_material(surface.material, picture.xyz_to_working());
        for (const ecs::Entity part : parts)
            diffraction::add_surface(world, part,
                                     {.material = material,
                                      .groove_rotation = static_cast<float>(surface.groove_rotation),
                                      .grooves = surface.grooves},
                                     surface.has_base);
    } else if (surface.film->in_scene && surface.film->cooked) {
        const thin_film::CookedFilm& cooked = *surface.film->cooked;
        const auto film = std::make_shared<const thin_film::GpuFilm>(cooked.table, picture.xyz_to_working(),
                                                                     cooked.material.illuminant.name);
        render::SurfaceTextures textures(*surface.film->textures);
        for (const ecs::Entity part : parts)
            thin_film::add_film(world, part, *surface.film->in_scene, film, textures, object->scene->file.string(),
                                thin_film::kIridescenceExtension);
    } else if (surface.film->cooked) {
        for (const ecs::Entity part : parts)
            thin_film::add_film(world, part, *surface.film->cooked, picture.xyz_to_working());
    }
    if (!object->scene)
        for (const ecs::Entity part : parts) world.get<render::StandardMaterial>(part).double_sided = true;
}

void Preview::Side::set_glare(const std::shared_ptr<const CookedSurface>& surface) {
    if (std::exchange(sheet, surface) == surface) return;
    auto& glare = picture.post_settings().glare;
    glare.reset();
    if (surface && surface->material)
        glare = post::GlareSettings{.pattern = std::make_shared<post::GlarePattern>(diffraction::glare_pattern(
                                        surface->material->material.grating, picture.xyz_to_working())),
                                    .angle = static_cast<float>(surface->groove_rotation)};
}

void Preview::Side::draw(const PreviewInputs& inputs, float seconds) {
    const Stage& stage = inputs.stage;
    world.get<scene::Transform>(root) = root_transform(inputs);
    for (const auto& [entity, rest] : tops)
        if (object->tilts) world.get<scene::Transform>(entity).rotation = inputs.tilt * rest.rotation;
    if (stage.lamp) {
        if (!world.alive(lamp)) lamp = world.create();
        world.add(lamp, scene::DirectionalLight{
                            .direction = glm::normalize(glm::mat3(stage_rotation(stage)) * lamp_direction(stage)),
                            .irradiance = glm::vec3(stage.lamp_irradiance),
                            .angular_radius = scene::kSunAngularRadius,
                            .casts_shadow = false});
    } else if (world.alive(lamp)) {
        world.destroy(lamp);
    }
    scene::update_world_matrices(world);
    picture.post_settings().exposure_stops = stage.exposure_stops;
    picture.resize(inputs.size);
    picture.draw(world, rotated_camera(inputs), seconds);
}

void Preview::show(const PreviewInputs& inputs) {
    ROWLAND_CHECK(inputs.object && inputs.light, "a preview needs an object and light");
    if (inputs == inputs_) return;
    inputs_ = inputs;
    unchanged_ = 0;
    if (inputs.saved && !saved_) saved_.emplace(config_, still_);
    now_.show(inputs, inputs.surfaces);
    if (inputs.saved) saved_->show(inputs, *inputs.saved);
}

bool Preview::changes() const {
    return drawn_ && unchanged_ <= kFramesToFill;
}

void Preview::draw(float seconds) {
    if (unchanged_ > kFramesToFill) return;
    ++unchanged_;
    drawn_ = true;
    now_.draw(inputs_, seconds);
    if (inputs_.saved) saved_->draw(inputs_, seconds);
    if (inputs_.grooves_of && unchanged_ == 1) draw_grooves();
    // Maps begin to fill in the second frame in which nothing moves.
    constexpr int kFramesToBegin = 3;
    const bool filling =
        diffraction::maps_are_filling(now_.world) || (inputs_.saved && diffraction::maps_are_filling(saved_->world));
    if (unchanged_ >= kFramesToBegin && !filling) unchanged_ = kFramesToFill + 1;
}

float Preview::aspect() const {
    return static_cast<float>(inputs_.size.x) / static_cast<float>(inputs_.size.y);
}

Ray Preview::ray(const glm::vec2& at) const {
    const glm::vec2 size(inputs_.size);
    return scene::ray_through(rotated_camera(inputs_), at * size, size);
}

glm::vec2 Preview::project(const glm::vec3& position) const {
    return in_picture(rotated_camera(inputs_), aspect(), position);
}

glm::mat4 Preview::scene_to_world() const {
    return root_transform(inputs_).matrix();
}

void Preview::draw_grooves() {
    if (!overlay_) overlay_.emplace();
    const scene::Camera camera = rotated_camera(inputs_);
    overlay_->begin(inputs_.size, camera.projection(aspect()) * camera.view());
    const CookedSurfaces& surfaces = now_.surfaces;
    for (const Drawn& part : now_.drawn) {
        const bool chosen = part.material && part.material == inputs_.grooves_of && *part.material < surfaces.size();
        overlay_->draw(*now_.world.get<render::MeshInstance>(part.entity).gpu,
                       now_.world.get<scene::WorldMatrix>(part.entity).matrix,
                       chosen ? surfaces[*part.material].get() : nullptr);
    }
}

PickedSurface Preview::under_current_rotation(const PickedSurface& surface) const {
    PickedSurface now = surface;
    const float angle = glm::radians(surface.stage_rotation_deg - inputs_.stage.rotation_deg);
    const glm::mat3 rotation(glm::rotate(glm::mat4(1.0F), angle, kUp));
    now.point.position = rotation * now.point.position;
    for (glm::dvec3* vector : {&now.point.frame.normal, &now.point.frame.grating, &now.point.bitangent,
                               &now.frame.normal, &now.frame.grating})
        *vector = glm::dmat3(rotation) * *vector;
    return now;
}

std::optional<PickedSurface> Preview::pick(const glm::vec2& at) {
    if (!drawn_) return std::nullopt;
    const Ray through = ray(at);
    std::optional<PickedSurface> nearest;
    for (const Drawn& part : now_.drawn) {
        const render::MeshInstance& instance = now_.world.get<render::MeshInstance>(part.entity);
        const glm::mat4& to_world = now_.world.get<scene::WorldMatrix>(part.entity).matrix;
        if (!scene::meets(through, render::transformed(instance.gpu->bounds(), to_world))) continue;
        const auto point = pick_point(*instance.mesh, to_world, through);
        if (!point || (nearest && point->distance >= nearest->point.distance)) continue;
        nearest = PickedSurface{.point = *point,
                                .frame = {},
                                .material = part.material,
                                .layout = layout_of(part),
                                .map_rotation = 0.0,
                                .stage_rotation_deg = inputs_.stage.rotation_deg,
                                .mesh = part.name};
    }
    if (nearest) set_grating_vector(*nearest);
    return nearest;
}

diffraction::GrooveLayout Preview::layout_of(const Drawn& part) {
    const CookedSurfaces& surfaces = now_.surfaces;
    const bool grooves = part.material && *part.material < surfaces.size() && surfaces[*part.material] &&
                         surfaces[*part.material]->grooves;
    return diffraction::groove_layout(*now_.world.get<render::MeshInstance>(part.entity).mesh, false, grooves);
}

void Preview::set_grating_vector(PickedSurface& surface) const {
    double rotation = 0.0;
    if (surface.material && *surface.material < now_.surfaces.size() && now_.surfaces[*surface.material]) {
        const CookedSurface& grating = *now_.surfaces[*surface.material];
        if (grating.grooves)
            surface.map_rotation =
                grating.grooves->rotation(grating.grooves->uv_set() == 1 ? surface.point.uv1 : surface.point.uv);
        rotation = grating.groove_rotation + surface.map_rotation;
    }
    surface.frame = with_grating_rotated(surface.point, rotation);
}

std::optional<glm::vec4> Preview::sphere_of(std::size_t material) {
    if (!drawn_) return std::nullopt;
    std::vector<scene::Bounds> boxes;
    const glm::mat4 to_user = glm::inverse(stage_rotation(inputs_.stage));
    for (const Drawn& part : now_.drawn)
        if (part.material == material)
            boxes.push_back(render::transformed(now_.world.get<render::MeshInstance>(part.entity).gpu->bounds(),
                                                to_user * now_.world.get<scene::WorldMatrix>(part.entity).matrix));
    const auto box = render::united(boxes);
    if (!box) return std::nullopt;
    return glm::vec4(0.5F * (box->minimum + box->maximum), 0.5F * glm::length(box->maximum - box->minimum));
}

std::vector<glm::vec2> Preview::middles_of(std::size_t material) {
    constexpr std::size_t kMost = 8;
    std::vector<glm::vec2> result;
    for (const Drawn& part : now_.drawn) {
        if (part.material != material || result.size() == kMost) continue;
        const scene::Bounds& box = now_.world.get<render::MeshInstance>(part.entity).gpu->bounds();
        const glm::mat4& to_world = now_.world.get<scene::WorldMatrix>(part.entity).matrix;
        result.push_back(project(glm::vec3(to_world * glm::vec4(0.5F * (box.minimum + box.maximum), 1.0F))));
    }
    return result;
}

}  // namespace rowland::inspector
