// What mirrors show of the scene: the plane they stand on and the objects around them.
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <span>

#include "engine/render/bindings.h"
#include "engine/render/renderer.h"
#include "engine/render/renderer_frame.h"
#include "engine/render/world_bounds.h"

namespace rowland::render {

namespace {

template <typename T>
void add_bytes(Hasher& hasher, const T& value) {
    hasher.bytes(std::as_bytes(std::span(&value, 1)));
}

void add_draw(Hasher& hasher, const Draw& draw, const glm::mat3& to_working) {
    add_bytes(hasher, draw.entity);
    add_bytes(hasher, draw.mesh);
    add_bytes(hasher, draw.program);
    for (const SurfaceMap& map : kSurfaceMaps) add_bytes(hasher, (draw.material->*map.texture).texture.get());
    add_bytes(hasher, object_block(draw, to_working));
}

/// The bounds of all that is in the picture, by group; in an order that does not depend on the camera.
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
        const PlaneLight light{ambient_, light_.key_lights(), lights_, glm::mat3(rec709_to_working_)};
        if (reflection_->update(world, light, frame.camera->vertical_field_of_view / height)) return;
    }
    reflection_.reset();
}

void Renderer::draw_object_reflections(ecs::World& world, Frame& frame) {
    const auto groups = reflecting_groups(frame.list);
    if (groups.empty()) return object_reflections_.reset();
    const gpu::PassTimes::Scope scope(times_, "reflections");
    if (!object_reflections_) object_reflections_.emplace();
    for (const auto& [group, box] : groups) {
        ObjectReflection& reflection = object_reflections_->of(group);
        reflection.centre = 0.5F * (box.minimum + box.maximum);
        Frame around = surroundings(world, frame, group);
        const Hash128 content = content_of(around, reflection.centre);
        if (reflection.content != content) draw_surroundings(world, around, reflection);
        reflection.content = content;
        for (Draw& draw : frame.list.draws)
            if (draw.reflects == group) draw.reflection = &reflection;
    }
    if (report_.reflections_drawn == 0) return;
    upload(frame);
    bind_frame(frame);
}

/// What is drawn around a group: all opaque objects but its own and those below the plane that mirrors show.
Renderer::Frame Renderer::surroundings(ecs::World& world, const Frame& frame, ecs::Entity group) {
    Frame around = frame;
    around.size = object_reflections_->picture.size();
    around.aspect = 1.0F;
    around.into_halves = true;
    around.blended.clear();
    std::erase_if(around.list.draws, [&](const Draw& draw) {
        const bool right_part = draw.columns != nullptr && draw.columns->begin > 0.0F;
        return draw.reflects == group || (draw.features & feature::kAlphaBlend) != 0 || right_part ||
               (reflection_ && reflection_->covers(draw.bounds));
    });
    for (Draw& draw : around.list.draws) {
        draw.program = &program_of(world, draw);
        draw.columns = nullptr;
        draw.reflection = &object_reflections_->nothing;
    }
    return around;
}

/// Shadows are left out: they are those of the camera's last view that changed anything else.
Hash128 Renderer::content_of(const Frame& around, const glm::vec3& centre) const {
    Hasher hasher;
    add_bytes(hasher, centre);
    add_bytes(hasher, light_.version);
    add_bytes(hasher, lights_.block);
    for (const auto& type : types_) add_bytes(hasher, type->version());
    for (const glm::mat4& joint : around.list.joints) add_bytes(hasher, joint);
    const glm::mat3 to_working(rec709_to_working_);
    for (const Draw& draw : around.list.draws) add_draw(hasher, draw, to_working);
    return hasher.digest();
}

void Renderer::draw_surroundings(ecs::World& world, Frame& around, ObjectReflection& reflection) {
    const gpu::Framebuffer& picture = object_reflections_->picture;
    for (int face = 0; face < ObjectReflection::kFaces; ++face) {
        const scene::Camera camera = reflection.camera(face);
        around.camera = &camera;
        around.view_projection = camera.projection(1.0F) * camera.view();
        around.used.clear();
        around.opaque.clear();
        const Frustum frustum(around.view_projection);
        for (Draw& draw : around.list.draws) {
            if (!frustum.may_see(draw.bounds)) continue;
            around.used.push_back(&draw);
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
        draw_pass(world, around.opaque, around.size);
        reflection.store(programs_, object_reflections_->triangle, picture, face);
    }
    reflection.finish();
}

}  // namespace rowland::render
