#include "tests/gpu/modules/diffraction/grating_picture.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "engine/lighting/light_probe.h"
#include "engine/render/gpu_mesh.h"
#include "modules/diffraction/bake/arc_moments.h"

namespace rowland::diffraction {

namespace {

/// A DiffractionSurfaceType under light that the test sets, whatever the renderer's is.
class UnderLight final : public render::MaterialType {
 public:
    UnderLight(const glm::dmat3& xyz_to_working, const DiffractionSettings& settings, const GratingLight& light)
        : inner_(xyz_to_working, settings), light_(&light) {}

    std::string name() const override { return "diffraction"; }
    void add_shaders(gpu::ShaderLibrary& library) const override { inner_.add_shaders(library); }
    bool owns(ecs::World& world, ecs::Entity entity) const override { return inner_.owns(world, entity); }
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const override {
        return inner_.program(world, entity);
    }
    std::vector<gpu::ProgramDesc> later_programs(ecs::World& world, ecs::Entity entity) const override {
        return inner_.later_programs(world, entity);
    }
    void update(ecs::World& world, const render::FrameLight& frame, std::span<const ecs::Entity> seen) override {
        render::FrameLight light = light_->frame();
        light.light_strengths = frame.light_strengths;  // of the world's own lights
        inner_.update(world, light, seen);
    }
    void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override {
        inner_.bind(world, entity, program);
    }
    std::optional<gpu::ProgramDesc> overlay_program(ecs::World& world, ecs::Entity entity) const override {
        return inner_.overlay_program(world, entity);
    }
    void bind_overlay(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override {
        inner_.bind_overlay(world, entity, program);
    }

 private:
    DiffractionSurfaceType inner_;
    const GratingLight* light_;
};

}  // namespace

void GratingPicture::show(const CookedMaterial& cooked, double groove_rotation, MapPace pace,
                          std::chrono::milliseconds map_wait) {
    renderer_.emplace(xyz_to_working_);
    const DiffractionSettings settings{.window = math::SphericalWindow::None, .map_pace = pace, .map_wait = map_wait};
    renderer_->add_material_type(std::make_unique<UnderLight>(xyz_to_working_, settings, light_));
    lighting::LightProbe dark;
    dark.sh = {.bands = 3, .coefficients = std::vector<glm::dvec3>(9, glm::dvec3(0.0))};
    dark.environment.layout = {.face_size = 4, .levels = 1};
    dark.environment.halves.assign(3 * dark.environment.layout.offset(1), 0);
    renderer_->set_probe(dark);
    rotation_ = groove_rotation;
    entity_ = world_.create();
    world_.add(entity_, scene::Transform(transform_));
    world_.add(entity_, render::make_mesh_instance(scene::Mesh(mesh_)));
    use(cooked);
}

void GratingPicture::use(const CookedMaterial& cooked) {
    material_ = make_gpu_material(cooked, xyz_to_working_);
    world_.add(entity_, render::StandardMaterial(material_->base()));
    world_.add(entity_, DiffractionSurface{material_, static_cast<float>(rotation_)});
}

std::vector<glm::vec4> GratingPicture::draw() {
    world_.get<scene::Transform>(entity_) = transform_;
    scene::update_world_matrices(world_);
    renderer_->render(world_, camera_, target_);
    return target_.read_rgba_float();
}

GratingPicture::AtPoint GratingPicture::arc_xyz(const CookedMaterial& cooked, const lighting::ShLight& light) {
    const auto& table = std::get<ArcTable>(cooked.tables);
    std::vector<std::vector<glm::dvec3>> products;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        const lighting::ShLight rotated = vertex_light(vertex, light, table.bands);
        products.push_back(table.terms == LightTerms::ArcMoments
                               ? light_products(table, ArcMoments(table.bands)(rotated))
                               : light_products(table, rotated.coefficients));
    }
    return [products, &table](const Point& point) {
        std::vector<glm::dvec3> mixed;
        for (std::size_t r = 0; r < products[0].size(); ++r)
            mixed.push_back(mix(point, {products[0][r], products[1][r], products[2][r]}));
        return shade(table, mixed, point.view);
    };
}

void GratingPicture::expect_map_at_vertices(const CookedMaterial& cooked, const AtPoint& map_xyz,
                                            const AtPoint& map_error) {
    const AtPoint lights_xyz = key_lights(cooked);
    const AtPoint lights_error = key_lights_error(cooked);
    std::vector<glm::dvec3> maps;
    std::vector<glm::dvec3> lights;
    std::vector<glm::dvec3> map_errors;
    std::vector<glm::dvec3> light_errors;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        Point point;
        point.to_tangent = vertex_frame(vertex);
        point.view = vertex_view(vertex);
        maps.push_back(map_xyz(point));
        lights.push_back(lights_xyz(point));
        map_errors.push_back(map_error(point));
        light_errors.push_back(lights_error(point));
    }
    const bool at_vertices = cooked.material.quality.lights_at_vertices;
    const auto expected = [&](const Point& point) {
        return mix(point, maps) + (at_vertices ? mix(point, lights) : lights_xyz(point));
    };
    const auto error = [&](const Point& point) {
        return mix(point, map_errors) + (at_vertices ? mix(point, light_errors) : lights_error(point));
    };
    EXPECT_LT(largest_difference(draw(), expected, error), kPictureTolerance) << at_vertices;
    EXPECT_GT(largest_difference(draw(), map_xyz), 0.1);
}

double GratingPicture::largest_difference(const std::vector<glm::vec4>& pixels, const AtPoint& expected,
                                          const AtPoint& allowed) {
    double difference = 0.0;
    brightest_ = 0.0;
    compared_ = 0;
    for (int row = 0; row < kSize; ++row)
        // As on a chessboard: two of each two by two pixels, within which shaders take differences.
        for (int column = row % 2; column < kSize; column += 2) {
            const Point point = point_at(column, row);
            if (std::min({point.weights.x, point.weights.y, point.weights.z}) < 0.02) continue;
            const glm::dvec3 wanted = expected(point);
            const glm::dvec3 error = allowed ? allowed(point) : glm::dvec3(0.0);
            const glm::dvec3 drawn = glm::vec3(pixels[static_cast<std::size_t>(row * kSize + column)]);
            for (int o = 0; o < 3; ++o) {
                // A NaN is no agreement.
                difference =
                    std::isfinite(drawn[o]) ? std::max(difference, std::abs(drawn[o] - wanted[o]) - error[o]) : 1e30;
                brightest_ = std::max(brightest_, std::abs(wanted[o]));
            }
            ++compared_;
        }
    RecordProperty("largest_difference", std::to_string(difference / brightest_));
    return difference / brightest_;
}

}  // namespace rowland::diffraction
