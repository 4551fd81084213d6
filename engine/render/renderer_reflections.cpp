// What mirrors show of the scene: the plane they stand on and the objects around them.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

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

void add_draw(Hasher& hasher, const Draw& draw) {
    add_bytes(hasher, draw.entity);
    add_bytes(hasher, draw.mesh);
    add_bytes(hasher, draw.program);
    for (const SurfaceMap& map : kSurfaceMaps) add_bytes(hasher, (draw.material->*map.texture).texture.get());
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

/// All faces are drawn again for another scene, light or centre, and one in a frame while objects turn. Shadows that
/// change by the camera alone wait for that.
void Renderer::update_staleness(const Frame& around, ObjectReflection& reflection) const {
    Hasher scene;
    Hasher motion;
    add_bytes(scene, reflection.centre);
    add_bytes(scene, light_.version);
    add_bytes(scene, lights_.block);
    for (const auto& type : types_) add_bytes(motion, type->version());
    for (const glm::mat4& joint : around.list.joints) add_bytes(motion, joint);
    const glm::mat3 to_working(rec709_to_working_);
    for (const Draw& draw : around.list.draws) {
        add_draw(scene, draw);
        add_bytes(motion, object_block(draw, to_working));
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
    std::swap(frame_data_, reflection.frame_data);
    reflection.finish();
}

}  // namespace rowland::render
