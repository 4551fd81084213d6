#include "tests/gpu/modules/diffraction/grating_picture.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

namespace rowland::diffraction {

namespace {

nlohmann::json material_json(const std::string& grating, const std::string& quality, const std::string& others = "") {
    return parse_json("{\"grating\":" + grating + ",\"quality\":" + quality + others + "}", "test");
}

void round_as_stored(std::vector<glm::vec3>& xyz, const lighting::LightSamples& light) {
    const auto is_negative = [](const std::vector<float>& flux) { return std::ranges::min(flux) < 0.0F; };
    if (is_negative(light.red) || is_negative(light.green) || is_negative(light.blue)) return;
    const float largest = largest_component(xyz);
    for (glm::vec3& value : xyz)
        value = largest * glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(glm::max(value, 0.0F) / largest));
}

}  // namespace

PlanarMap as_stored(PlanarMap map, const lighting::LightSamples& light) {
    round_as_stored(map.xyz, light);
    return map;
}

LobeMap as_stored(LobeMap map, const lighting::LightSamples& light) {
    round_as_stored(map.values, light);
    return map;
}

CookedMaterial cook(const std::string& grating, const std::string& quality, const std::string& others) {
    return cook_material(material_json(grating, quality, others), "test");
}

CookedMaterial cook_complete(const std::string& grating, const std::string& quality, const std::string& others) {
    nlohmann::json json = material_json(grating, quality, others);
    json["grating"]["profile"] = {{"type", "table"}, {"file", "t.csv"}};
    json["grating"]["orders"] = {-1, 1};
    return cook_material(json, "test", [](const std::string&) {
        return NamedText{.text = "wavelength_nm,R-1,R+0,R+1\n380,0.2,0.4,0.4\n780,0.3,0.4,0.3\n", .file = "t.csv"};
    });
}

CookedMaterial cook_planar(const std::string& grating, const std::string& settings) {
    const std::string quality = R"({"representation": "planar", )" + settings + "}";
    const Material material = parse_material(material_json(grating, quality), "test");
    auto planar = std::get<PlanarSettings>(*material.quality.pinned);
    if (planar.lobe_size) planar.stand_in.grid = view_grid(ViewMapping::Spherical, 4);
    CookedMaterial cooked = bake_kernel(material);
    cooked.tables = bake(material.grating, planar);
    return cooked;
}

lighting::ProbeImage smooth_probe() {
    image::Image picture;
    picture.width = 64;
    picture.height = 32;
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const double theta = std::numbers::pi * (row + 0.5) / picture.height;
            const double phi = 2.0 * std::numbers::pi * ((column + 0.5) / picture.width - 0.5);
            const glm::dvec3 s(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            picture.texels.emplace_back(glm::vec3(1.0 + 0.6 * s.y + 0.3 * s.x * s.z, 0.8 + 0.5 * s.x * s.y - 0.2 * s.z,
                                                  0.7 + 0.4 * s.z + 0.3 * s.y * s.y));
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

std::vector<lighting::KeyLight> three_keys() {
    return {{.direction = glm::normalize(glm::dvec3(0.5, 0.3, 0.8)), .flux = {1.0, 0.8, 0.5}, .concentration = 300.0},
            {.direction = glm::normalize(glm::dvec3(-0.8, 0.5, 0.2)), .flux = {0.2, 0.5, 1.0}, .concentration = 60.0},
            {.direction = glm::normalize(glm::dvec3(0.1, -0.9, 0.15)), .flux = {0.9, 0.2, 0.1}, .concentration = 1e4}};
}

GratingLight light_of(const lighting::ProbeImage& image, std::vector<lighting::KeyLight> keys, std::uint64_t version) {
    constexpr int kBands = 10;
    constexpr int kLightFace = 32;
    GratingLight light{.key_lights = std::move(keys), .residual = lighting::project(image, kBands), .version = version};
    light.sh = light.residual;
    lighting::LightProbe probe;
    if (!light.key_lights.empty()) {
        const lighting::ShLight lobes = lighting::project(light.key_lights, kBands);
        for (std::size_t i = 0; i < light.sh.coefficients.size(); ++i)
            light.sh.coefficients[i] += lobes.coefficients[i];
        light.residual = lighting::residual(light.sh, light.key_lights, kBands);
    }
    std::vector<lighting::KeyLight> removed = light.key_lights;  // removing negative light adds it
    for (lighting::KeyLight& key : removed) key.flux = -key.flux;
    probe.sh = light.sh;
    probe.key_lights = light.key_lights;
    probe.light = lighting::pack(lighting::light_samples(image, removed, 0.1), kLightFace);
    light.probe_texels = std::make_shared<const lighting::LightSamples>(lighting::unpack(probe.light));
    light.texels = std::make_shared<const lighting::LightSamples>(lighting::unpack(probe.light, light.key_lights));
    light.probe = std::make_shared<const lighting::LightProbe>(std::move(probe));
    return light;
}

GratingLight black_light() {
    lighting::LightProbe probe;
    probe.sh = {.bands = 10, .coefficients = std::vector<glm::dvec3>(100, glm::dvec3(0.0))};
    GratingLight light{.sh = probe.sh, .residual = probe.sh, .version = 1};
    light.probe = std::make_shared<const lighting::LightProbe>(std::move(probe));
    return light;
}

namespace {

/// A DiffractionSurfaceType under light that the test sets, whatever the renderer's is.
class UnderLight final : public render::MaterialType {
 public:
    UnderLight(const glm::dmat3& xyz_to_working, const DiffractionSettings& settings, const GratingLight& light)
        : inner_(xyz_to_working, settings), light_(&light) {}

    std::string name() const override { return "diffraction"; }
    void add_shaders(gpu::ShaderLibrary& library) const override { inner_.add_shaders(library); }
    bool owns(ecs::World& world, ecs::Entity entity) const override { return inner_.owns(world, entity); }
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override {
        return inner_.program(world, entity, slot);
    }
    std::vector<render::LaterProgram> later_programs(ecs::World& world, ecs::Entity entity,
                                                     render::ProbeSlot slot) const override {
        return inner_.later_programs(world, entity, slot);
    }
    void update(ecs::World& world, std::span<const render::FrameLight> frame,
                std::span<const render::LitEntity> seen) override {
        render::FrameLight light = light_->frame();
        light.light_strengths = frame[0].light_strengths;  // of the world's own lights
        inner_.update(world, std::span(&light, 1), seen);
    }
    void bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
              const gpu::Program& program) const override {
        inner_.bind(world, entity, slot, program);
    }
    std::optional<gpu::ProgramDesc> overlay_program(ecs::World& world, ecs::Entity entity,
                                                    render::ProbeSlot slot) const override {
        return inner_.overlay_program(world, entity, slot);
    }
    void bind_overlay(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
                      const gpu::Program& program) const override {
        inner_.bind_overlay(world, entity, slot, program);
    }

 private:
    DiffractionSurfaceType inner_;
    const GratingLight* light_;
};

}  // namespace

lighting::LightProbe GratingPicture::with_even_environment(lighting::LightProbe probe, float radiance) {
    if (probe.sh.bands == 0) probe.sh = {.bands = 3, .coefficients = std::vector<glm::dvec3>(9, glm::dvec3(0.0))};
    probe.environment.layout = {.face_size = 4, .levels = 1};
    probe.environment.scale = radiance;
    probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0x3C00);  // 1
    return probe;
}

void GratingPicture::show(const CookedMaterial& cooked, double groove_rotation, MapPace pace,
                          std::chrono::milliseconds map_wait) {
    rotation_ = groove_rotation;
    if (world_.alive(entity_)) return use(cooked);
    renderer_.emplace(xyz_to_working_);
    const DiffractionSettings settings{.window = math::SphericalWindow::None, .map_pace = pace, .map_wait = map_wait};
    renderer_->add_material_type(std::make_unique<UnderLight>(xyz_to_working_, settings, light_));
    renderer_->set_probe(with_even_environment({}, 0.0F));
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
    SCOPED_TRACE(at_vertices ? "lights at the vertices" : "lights at the pixels");
    expect_drawn(expected, error);
    EXPECT_GT(largest_difference(draw(), map_xyz), 0.1);
}

void GratingPicture::expect_drawn(const AtPoint& expected, const AtPoint& allowed, double tolerance) {
    EXPECT_LT(largest_difference(draw(), expected, allowed), tolerance);
    EXPECT_GT(compared_, 5);
    EXPECT_GT(brightest_, 0.01);
}

float GratingPicture::brightest(const std::vector<glm::vec4>& pixels) {
    float largest = 0.0F;
    for (const glm::vec4& pixel : pixels) largest = std::max({largest, pixel.x, pixel.y, pixel.z});
    return largest;
}

double GratingPicture::largest_difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    float difference = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int o = 0; o < 3; ++o) {
            const float change = std::abs(a[i][o] - b[i][o]);
            difference = std::isfinite(change) ? std::max(difference, change) : 1e30F;  // a NaN is no agreement
        }
    return static_cast<double>(difference / brightest(a));
}

void GratingPicture::look_along_the_surface() {
    transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    camera_.eye = {0.5F, -2.5F, 0.02F};
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
