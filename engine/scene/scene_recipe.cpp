#include "engine/scene/scene_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <mutex>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/core/parallel.h"
#include "engine/image/png.h"

namespace rowland::scene {

namespace {

constexpr std::size_t kMostElements = 4096;      ///< of each array
constexpr std::size_t kMostVertices = 1U << 23;  ///< of all meshes
constexpr std::size_t kMostTexels = 1U << 24;    ///< of all textures
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr NumberRange kShare{.minimum = 0.0, .maximum = 1.0};
constexpr NumberRange kPlace{.minimum = -1e6, .maximum = 1e6};
constexpr NumberRange kDegrees{.minimum = -360.0, .maximum = 360.0};

glm::dvec3 vector_of(JsonReader& reader, const std::string& key, NumberRange range) {
    const std::vector<double> v = reader.numbers(key, 3, range);
    return {v[0], v[1], v[2]};
}

/// The place of what is called by the text under `key`.
template <typename Element>
std::size_t find_named(JsonReader& reader, const std::string& key, const std::vector<Element>& among) {
    const std::string name = reader.text(key);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < among.size(); ++i) {
        if (among[i].name == name) return i;
        names.push_back(among[i].name);
    }
    const auto near = nearest_word(name, names);
    reader.fail(key, fmt::format("\"{:.80}\"", name), "the name of one above",
                near ? fmt::format("is \"{}\" meant?", *near) : "");
}

template <typename Element>
std::optional<std::size_t> find_named_if_there(JsonReader& reader, const std::string& key,
                                               const std::vector<Element>& among) {
    if (!reader.has(key)) return std::nullopt;
    return find_named(reader, key, among);
}

template <typename Element>
std::string new_name(JsonReader& reader, const std::vector<Element>& among) {
    std::string name = reader.text("name");
    if (name.empty()) reader.fail("name", "\"\"", "a name");
    if (std::any_of(among.begin(), among.end(), [&](const Element& element) { return element.name == name; }))
        reader.fail("name", fmt::format("\"{:.80}\" again", name), "another name for each");
    return name;
}

/// Objects under `key`; none if it is not there.
std::vector<JsonReader> objects_if_there(JsonReader& reader, const std::string& key) {
    if (!reader.has(key)) return {};
    std::vector<JsonReader> objects = reader.objects(key);
    if (objects.size() > kMostElements)
        reader.fail(key, fmt::format("{} of them", objects.size()), fmt::format("at most {}", kMostElements));
    return objects;
}

class Parsing {
 public:
    Parsing(JsonReader reader, const std::string& file) : reader_(std::move(reader)) { recipe_.file = file; }

    SceneRecipe parse() {
        for (JsonReader& texture : objects_if_there(reader_, "textures")) add_texture(texture);
        for (JsonReader& material : objects_if_there(reader_, "materials")) add_material(material);
        for (JsonReader& mesh : objects_if_there(reader_, "meshes")) add_mesh(mesh);
        for (JsonReader& camera : objects_if_there(reader_, "cameras")) add_camera(camera);
        for (JsonReader& light : objects_if_there(reader_, "lights")) add_light(light);
        for (JsonReader& node : objects_if_there(reader_, "nodes")) add_node(node);
        reader_.finish();
        return std::move(recipe_);
    }

 private:
    void add_texture(JsonReader& reader) {
        std::string name = new_name(reader, recipe_.textures);
        TextureRecipe texture = parse_texture(reader);
        const auto clamps = [&](const char* key) {
            return reader.choice_or(key, "repeat", {"repeat", "clamp"}) == "clamp";
        };
        const bool clamp_x = clamps("wrap_x");
        const bool clamp_y = clamps("wrap_y");
        reader.finish();
        recipe_.textures.push_back({std::move(name), std::move(texture), clamp_x, clamp_y});
    }

    void add_material(JsonReader& reader) {
        GlbMaterial material;
        material.name = new_name(reader, recipe_.materials);
        if (reader.has("color")) material.colour = glm::dvec4(vector_of(reader, "color", kShare), 1.0);
        material.colour.a = reader.number_or("alpha", 1.0, kShare);
        material.metallic = reader.number_or("metallic", material.metallic, kShare);
        material.roughness = reader.number_or("roughness", material.roughness, kShare);
        if (reader.has("color_texture")) material.colour_texture = colour_texture(reader.object("color_texture"));
        material.blend = reader.boolean_or("blend", false);
        material.double_sided = reader.boolean_or("double_sided", false);
        if (reader.has("extensions")) {
            reader.object("extensions");
            material.extensions = reader.raw("extensions");
        }
        reader.finish();
        recipe_.materials.push_back(std::move(material));
    }

    GlbMaterial::ColourTexture colour_texture(JsonReader reader) const {
        GlbMaterial::ColourTexture use;
        use.texture = find_named(reader, "name", recipe_.textures);
        if (reader.has("repeat")) {
            const std::vector<double> repeat = reader.numbers("repeat", 2, {.minimum = 1e-3, .maximum = 1e6});
            use.repeat = {repeat[0], repeat[1]};
        }
        reader.finish();
        return use;
    }

    void add_mesh(JsonReader& reader) {
        SceneRecipe::SceneMesh mesh;
        mesh.name = new_name(reader, recipe_.meshes);
        std::vector<JsonReader> parts = reader.objects("parts");
        if (parts.empty() || parts.size() > kMostElements)
            reader.fail("parts", fmt::format("{} parts", parts.size()), fmt::format("1 to {}", kMostElements));
        for (JsonReader& part : parts) {
            mesh.parts.push_back({parse_shape(part.object("shape")), find_named(part, "material", recipe_.materials)});
            part.finish();
        }
        reader.finish();
        recipe_.meshes.push_back(std::move(mesh));
    }

    void add_camera(JsonReader& reader) {
        GlbCamera camera;
        camera.name = new_name(reader, recipe_.cameras);
        camera.vertical_field_of_view =
            kRadians * reader.number("vertical_field_of_view_deg", {.minimum = 1.0, .maximum = 170.0});
        camera.near_plane = reader.number_or("near", camera.near_plane, {.minimum = 1e-4, .maximum = 1.0});
        camera.far_plane = reader.number_or("far", camera.far_plane, {.minimum = 2.0, .maximum = 1e6});
        reader.finish();
        recipe_.cameras.push_back(std::move(camera));
    }

    void add_light(JsonReader& reader) {
        GlbLight light;
        light.name = new_name(reader, recipe_.lights);
        const std::string type = reader.choice("type", {"directional", "point", "spot"});
        glm::dvec3 strength(reader.number("intensity", {.minimum = 0.0, .maximum = 1e6}));
        if (reader.has("color")) strength *= vector_of(reader, "color", kShare);
        if (type == "directional")
            light.light = DirectionalLight{.irradiance = glm::vec3(strength)};
        else
            light.light = punctual(reader, type == "spot", strength);
        reader.finish();
        recipe_.lights.push_back(std::move(light));
    }

    static PunctualLight punctual(JsonReader& reader, bool spot, const glm::dvec3& strength) {
        PunctualLight light;
        light.intensity = glm::vec3(strength);
        light.spot = spot;
        if (!spot) return light;
        const double outer = reader.number("outer_cone_deg", {.minimum = 1.0, .maximum = 89.0});
        light.outer_cone = static_cast<float>(kRadians * outer);
        light.inner_cone =
            static_cast<float>(kRadians * reader.number_or("inner_cone_deg", 0.0,
                                                           {.minimum = 0.0, .maximum = outer, .maximum_open = true}));
        return light;
    }

    void add_node(JsonReader& reader) {
        GlbNode node;
        node.name = new_name(reader, recipe_.nodes);
        node.parent = find_named_if_there(reader, "parent", recipe_.nodes);
        if (reader.has("translation")) node.local.translation = glm::vec3(vector_of(reader, "translation", kPlace));
        node.local.rotation = rotation(reader);
        node.local.scale =
            glm::vec3(static_cast<float>(reader.number_or("scale", 1.0, {.minimum = 1e-3, .maximum = 1e3})));
        node.mesh = find_named_if_there(reader, "mesh", recipe_.meshes);
        node.camera = find_named_if_there(reader, "camera", recipe_.cameras);
        node.light = find_named_if_there(reader, "light", recipe_.lights);
        if (reader.has("extras")) {
            reader.object("extras");
            node.extras = reader.raw("extras");
        }
        reader.finish();
        recipe_.nodes.push_back(std::move(node));
    }

    static glm::quat rotation(JsonReader& reader) {
        if (reader.has("look_at")) return looking_at(reader);
        if (!reader.has("yaw_pitch_roll_deg")) return {1.0F, 0.0F, 0.0F, 0.0F};
        const glm::dvec3 turns = kRadians * vector_of(reader, "yaw_pitch_roll_deg", kDegrees);
        return glm::quat(glm::angleAxis(turns.x, glm::dvec3(0.0, 1.0, 0.0)) *
                         glm::angleAxis(turns.y, glm::dvec3(1.0, 0.0, 0.0)) *
                         glm::angleAxis(turns.z, glm::dvec3(0.0, 0.0, 1.0)));
    }

    static glm::quat looking_at(JsonReader& reader) {
        if (reader.has("yaw_pitch_roll_deg"))
            reader.fail("yaw_pitch_roll_deg", "beside look_at", "one of the two", "remove one");
        glm::dvec3 from(0.0);
        if (reader.has("translation")) from = vector_of(reader, "translation", kPlace);
        const glm::dvec3 way = vector_of(reader, "look_at", kPlace) - from;
        if (!(glm::length(way) > 1e-6)) reader.fail("look_at", "the node's own place", "another point");
        const glm::dvec3 ahead = glm::normalize(way);
        const bool upright = std::abs(ahead.y) > 1.0 - 1e-9;
        return glm::quat(glm::quatLookAt(ahead, upright ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0)));
    }

    JsonReader reader_;
    SceneRecipe recipe_;
};

void check_texels(const SceneRecipe& recipe) {
    std::size_t texels = 0;
    for (std::size_t i = 0; i < recipe.textures.size(); ++i) {
        const TextureRecipe& texture = recipe.textures[i].recipe;
        texels += static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
        if (texels > kMostTexels)
            refuse_input(recipe.file, fmt::format("/scene/textures/{}/size", i), fmt::format("{} texels", texels),
                         fmt::format("at most {} in all textures", kMostTexels));
    }
}

}  // namespace

bool is_scene_recipe(const nlohmann::json& document) {
    return document.is_object() && document.contains("scene");
}

SceneRecipe parse_scene_recipe(const nlohmann::json& document, const std::string& file) {
    JsonReader root(document, file);
    SceneRecipe recipe = Parsing(root.object("scene"), file).parse();
    root.finish();
    return recipe;
}

namespace {

/// What was painted last. A running program cooks a scene at every save, and its textures are most of the work but
/// seldom what was changed.
class PaintedBefore {
 public:
    std::optional<std::vector<std::byte>> find(const TextureRecipe& recipe) {
        const std::lock_guard lock(mutex_);
        const auto found = std::ranges::find(pictures_, recipe, &Picture::recipe);
        return found == pictures_.end() ? std::nullopt : std::optional(found->png);
    }
    void keep(const TextureRecipe& recipe, const std::vector<std::byte>& png) {
        constexpr std::size_t kMost = 16;
        constexpr std::size_t kLargest = 1U << 22;  // bytes
        if (png.size() > kLargest) return;
        const std::lock_guard lock(mutex_);
        pictures_.push_back({recipe, png});
        if (pictures_.size() > kMost) pictures_.pop_front();
    }

 private:
    struct Picture {
        TextureRecipe recipe;
        std::vector<std::byte> png;
    };
    std::mutex mutex_;
    std::deque<Picture> pictures_;
};

std::vector<std::byte> png_of(const TextureRecipe& recipe) {
    static PaintedBefore before;
    if (auto png = before.find(recipe)) return *std::move(png);
    const PaintedTexture painted = paint(recipe);
    std::vector<std::byte> png = image::encode_png(recipe.width, recipe.height, painted.channels, painted.texels);
    before.keep(recipe, png);
    return png;
}

}  // namespace

GlbScene build_scene(const SceneRecipe& recipe) {
    check_texels(recipe);
    GlbScene scene;
    scene.materials = recipe.materials;
    scene.cameras = recipe.cameras;
    scene.lights = recipe.lights;
    scene.nodes = recipe.nodes;
    scene.textures.resize(recipe.textures.size());
    parallel_for(recipe.textures.size(), [&](std::size_t i) {
        const SceneRecipe::Texture& texture = recipe.textures[i];
        scene.textures[i] = {texture.name, png_of(texture.recipe), texture.clamp_x, texture.clamp_y};
    });
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < recipe.meshes.size(); ++i) {
        GlbMesh& mesh = scene.meshes.emplace_back();
        mesh.name = recipe.meshes[i].name;
        for (const SceneRecipe::Part& part : recipe.meshes[i].parts) {
            mesh.primitives.push_back({build_mesh(part.shape), part.material});
            vertices += mesh.primitives.back().mesh.positions.size();
            if (vertices > kMostVertices)
                refuse_input(recipe.file, fmt::format("/scene/meshes/{}", i), fmt::format("{} vertices", vertices),
                             fmt::format("at most {} in all meshes", kMostVertices), "take fewer rings and segments");
        }
    }
    return scene;
}

}  // namespace rowland::scene
