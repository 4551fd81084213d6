#include "editor/inspector/view.h"

#include <utility>
#include <vector>

#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::inspector {

View::View(const post::OcioConfig& config, bool still, OpenDocument& document, const LightChoice& light,
           Messages& messages)
    : document_(document), light_(light), messages_(messages), preview_(config, still) {
    choose_shape(PreviewShape::Disc);
}

void View::choose_shape(PreviewShape shape) {
    if (shape == PreviewShape::Scene) {
        if (!document_.object()) return;
        object_ = document_.object();
    } else {
        object_ = std::make_shared<const PreviewObject>(PreviewObject{
            shape, {.meshes = {render::make_mesh_instance(preview_mesh(shape))}, .materials = {}}, nullptr});
    }
    forget_point();
}

void View::forget_point() {
    picked_.reset();
    surface_.reset();
    point_ = nullptr;
    searched_ = false;
}

void View::update() {
    const std::size_t chosen = document_.document().chosen();
    const std::size_t replacements = document_.replacements();
    if (std::exchange(last_replacements_, replacements) != replacements) {
        if (document_.object())
            choose_shape(PreviewShape::Scene);
        else if (object_->scene)
            choose_shape(PreviewShape::Disc);
        forget_point();
    }
    if (std::exchange(last_chosen_, chosen) != chosen) forget_point();
}

void View::pick(const glm::vec2& at) {
    const auto surface = card ? std::nullopt : preview_.pick(at);
    if (!surface) return;
    if (object_->scene && surface->material) {
        document_.document().choose(*surface->material);
        last_chosen_ = *surface->material;
    }
    surface_ = surface;
    point_ = std::make_shared<const diffraction::ShadingPoint>(surface->frame);
    picked_ = PickedPixel{.position = at};
    pixel_inputs_ = {};
}

void View::draw(glm::ivec2 size, const scene::Camera& camera, bool with_saved, float seconds) {
    if (!ready() || size.x < 1 || size.y < 1) return;
    if (card) {
        messages_.attempt([&] { preview_.show(card_inputs(size, camera)); });
        return preview_.draw(seconds);
    }
    const std::size_t chosen = object_->scene ? document_.document().chosen() : 0;
    const auto surfaces = [&](bool as_saved) {
        return object_->scene ? document_.surfaces(as_saved) : CookedSurfaces{document_.surface(as_saved)};
    };
    messages_.attempt([&] {
        preview_.show({.size = size,
                       .eye = camera.eye,
                       .target = camera.target,
                       .stage = stage,
                       .object = object_,
                       .light = light_.current(),
                       .surfaces = surfaces(false),
                       .saved = with_saved && document_.surface(true) ? std::optional(surfaces(true)) : std::nullopt,
                       .grooves_of = shows_grooves ? std::optional(chosen) : std::nullopt,
                       .glare_of = looks_through ? std::optional(chosen) : std::nullopt});
    });
    preview_.draw(seconds);
    update_point();
    const PixelInputs inputs{document_.surface(false), light_.current(), point_, stage};
    if (picked_ && std::exchange(pixel_inputs_, inputs) != inputs) read_picked_pixel();
}

PreviewInputs View::card_inputs(glm::ivec2 size, const scene::Camera& camera) const {
    PreviewInputs inputs;
    inputs.size = size;
    inputs.eye = camera.eye;
    inputs.target = camera.target;
    inputs.stage = stage;
    inputs.light = light_.current();
    inputs.object = card->object;
    inputs.surfaces = card->surfaces;
    inputs.tilt = card->tilt;
    return inputs;
}

void View::read_picked_pixel() {
    const glm::ivec2 size = preview_.display().size();
    const glm::ivec2 pixel = glm::min(glm::ivec2(picked_->position * glm::vec2(size)), size - 1);
    const auto index =
        static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(pixel.x);
    picked_->working = glm::vec3(preview_.linear().read_rgba_float()[index]);
    const std::vector<std::uint8_t> display = preview_.display().read_rgba8();
    picked_->display = {display[4 * index], display[4 * index + 1], display[4 * index + 2]};
}

std::optional<PickedSurface> View::find_surface() {
    const std::size_t chosen = document_.document().chosen();
    std::vector<glm::vec2> points;
    if (object_->scene) points = preview_.middles_of(chosen);
    points.insert(points.end(), {glm::vec2(0.66F, 0.5F), glm::vec2(0.5F, 0.5F), glm::vec2(0.5F, 0.68F)});
    for (const glm::vec2 at : points)
        if (auto surface = preview_.pick(at); surface && (!object_->scene || surface->material == chosen))
            return surface;
    return std::nullopt;
}

View::ViewedPoint View::point_or_middle() {
    if (point_) return {*point_, surface_->layout};
    const auto surface = find_surface();
    return surface ? ViewedPoint{surface->frame, surface->layout} : ViewedPoint{};
}

std::set<diffraction::GrooveLayout> View::layouts(bool has_groove_texture) const {
    const std::size_t chosen = document_.document().chosen();
    std::set<diffraction::GrooveLayout> layouts;
    const auto add = [&](const scene::Mesh& mesh) {
        layouts.insert(diffraction::groove_layout(mesh, false, has_groove_texture));  // skins are posed at rest
    };
    if (!object_->scene) add(*object_->parts.meshes.front().mesh);
    if (object_->scene)
        for (const scene::ImportedInstance& instance : object_->scene->imported.instances)
            if (instance.material == chosen) add(*object_->scene->meshes[instance.mesh]);
    return layouts;
}

diffraction::SurfaceShape View::surface_shape() {
    const std::pair shaped{object_, document_.document().chosen()};
    if (std::exchange(shaped_, shaped) != shaped)
        shape_ = layouts(false).contains(diffraction::GrooveLayout::Curved) ? diffraction::SurfaceShape::Curved
                                                                            : diffraction::SurfaceShape::Flat;
    return shape_;
}

const DrawnAs* View::drawn_as() {
    const auto grating = document_.surface(false);
    if (!grating || !grating->material) return nullptr;
    const DrawnInputs inputs{object_, document_.document().chosen(), grating};
    if (std::exchange(drawn_inputs_, inputs) == inputs) return &drawn_as_;
    drawn_as_ = {};
    for (const diffraction::GrooveLayout layout : layouts(grating->grooves != nullptr)) {
        const diffraction::BakedTables tables = drawn_tables(grating->material->tables, layout);
        const std::string name = info(tables).name;
        std::string& all = drawn_as_.representation;
        if (all.empty()) drawn_as_.cost = shading_cost(tables);
        if (all.find(name) == std::string::npos) all += (all.empty() ? "" : " and ") + name;
    }
    return &drawn_as_;
}

/// Finds a surface of the chosen material of a scene, once, and follows the rotation of its grooves.
void View::update_point() {
    if (!object_->scene || !preview_.drawn()) return;
    if (!document_.document().has_grating()) {
        point_ = nullptr;
        return;
    }
    if (!surface_ && !std::exchange(searched_, true)) surface_ = find_surface();
    if (!surface_) return;
    const CookedSurfaces surfaces = document_.surfaces(false);
    const std::shared_ptr<const CookedSurface>& grating = surfaces.at(document_.document().chosen());
    if (!grating) return;
    const diffraction::ShadingPoint point =
        with_grating_rotated(surface_->point, grating->groove_rotation + surface_->map_rotation);
    if (point_ && point == *point_) return;
    surface_->frame = point;
    point_ = std::make_shared<const diffraction::ShadingPoint>(point);
}

}  // namespace rowland::inspector
