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
#include <span>

#include "engine/core/error.h"
#include "engine/core/json_vector.h"
#include "engine/core/parallel.h"
#include "engine/image/png.h"
#include "engine/image/png_decode.h"

namespace rowland::scene {

namespace {

constexpr std::size_t kMostElements = 4096;          ///< of each array
constexpr std::size_t kMostVertices = 1U << 23;      ///< of all meshes
constexpr std::size_t kMostTexels = 1U << 24;        ///< of all textures
constexpr std::uint64_t kLargestPicture = 1U << 26;  ///< bytes
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr NumberRange kPosition{.minimum = -1e6, .maximum = 1e6};
constexpr NumberRange kDegrees{.minimum = -360.0, .maximum = 360.0};

/// The index of the element whose name is the text under `key`.
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

std::vector<JsonReader> read_elements_of(JsonReader& reader, const std::string& key) {
    std::vector<JsonReader> objects = reader.objects_if_there(key);
    if (objects.size() > kMostElements)
        reader.fail(key, fmt::format("{} of them", objects.size()), fmt::format("at most {}", kMostElements));
    return objects;
}

class Parsing {
 public:
    Parsing(JsonReader reader, const std::string& file) : reader_(std::move(reader)) { recipe_.file = file; }

    SceneRecipe parse() {
        for (JsonReader& texture : read_elements_of(reader_, "textures")) add_texture(texture);
        for (JsonReader& material : read_elements_of(reader_, "materials")) add_material(material);
        for (JsonReader& mesh : read_elements_of(reader_, "meshes")) add_mesh(mesh);
        for (JsonReader& camera : read_elements_of(reader_, "cameras")) add_camera(camera);
        for (JsonReader& light : read_elements_of(reader_, "lights")) add_light(light);
        for (JsonReader& node : read_elements_of(reader_, "nodes")) add_node(node);
        reader_.finish();
        return std::move(recipe_);
    }

 private:
    void add_texture(JsonReader& reader) {
        GlbTexture texture;
        texture.name = new_name(reader, scene_.textures);
        recipe_.textures.push_back(parse_texture(reader));
        texture.clamp_x = reader.choice_or("wrap_x", "repeat", {"repeat", "clamp"}) == "clamp";
        texture.clamp_y = reader.choice_or("wrap_y", "repeat", {"repeat", "clamp"}) == "clamp";
        reader.finish();
        scene_.textures.push_back(std::move(texture));
    }

    void add_material(JsonReader& reader) {
        GlbMaterial material;
        material.name = new_name(reader, scene_.materials);
        const auto colour = read_vector_or(reader, "color", glm::dvec3(material.colour), kFraction);
        material.colour = glm::dvec4(colour, reader.number_or("alpha", 1.0, kFraction));
        material.metallic = reader.number_or("metallic", material.metallic, kFraction);
        material.roughness = reader.number_or("roughness", material.roughness, kFraction);
        material.emission = read_vector_or(reader, "emission", material.emission, kFraction);
        if (reader.has("color_texture")) material.colour_texture = colour_texture(reader.object("color_texture"));
        material.blend = reader.boolean_or("blend", false);
        material.double_sided = reader.boolean_or("double_sided", false);
        if (reader.has("extensions")) {
            reader.object("extensions");
            material.extensions = reader.raw("extensions");
        }
        reader.finish();
        scene_.materials.push_back(std::move(material));
    }

    GlbMaterial::ColourTexture colour_texture(JsonReader reader) const {
        GlbMaterial::ColourTexture use;
        use.texture = find_named(reader, "name", scene_.textures);
        use.repeat = read_vector_or(reader, "repeat", use.repeat, {.minimum = 1e-3, .maximum = 1e6});
        reader.finish();
        return use;
    }

    void add_mesh(JsonReader& reader) {
        scene_.meshes.push_back({.name = new_name(reader, scene_.meshes), .primitives = {}});
        std::vector<JsonReader> parts = reader.objects("parts");
        if (parts.empty() || parts.size() > kMostElements)
            reader.fail("parts", fmt::format("{} parts", parts.size()), fmt::format("1 to {}", kMostElements));
        std::vector<SceneRecipe::Part>& mesh = recipe_.meshes.emplace_back();
        for (JsonReader& part : parts) {
            mesh.push_back({parse_shape(part.object("shape")), find_named(part, "material", scene_.materials)});
            part.finish();
        }
        reader.finish();
    }

    void add_camera(JsonReader& reader) {
        GlbCamera camera;
        camera.name = new_name(reader, scene_.cameras);
        camera.vertical_field_of_view =
            kRadians * reader.number("vertical_field_of_view_deg", {.minimum = 1.0, .maximum = 170.0});
        camera.near_plane = reader.number_or("near", camera.near_plane, {.minimum = 1e-4, .maximum = 1.0});
        camera.far_plane = reader.number_or("far", camera.far_plane, {.minimum = 2.0, .maximum = 1e6});
        reader.finish();
        scene_.cameras.push_back(std::move(camera));
    }

    void add_light(JsonReader& reader) {
        GlbLight light;
        light.name = new_name(reader, scene_.lights);
        const std::string type = reader.choice("type", {"directional", "point", "spot"});
        glm::dvec3 strength(reader.number("intensity", {.minimum = 0.0, .maximum = 1e6}));
        strength *= read_vector_or(reader, "color", glm::dvec3(1.0), kFraction);
        if (type == "directional")
            light.light = DirectionalLight{.irradiance = glm::vec3(strength)};
        else
            light.light = punctual(reader, type == "spot", strength);
        reader.finish();
        scene_.lights.push_back(std::move(light));
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
        node.name = new_name(reader, scene_.nodes);
        node.parent = find_named_if_there(reader, "parent", scene_.nodes);
        node.local.translation = read_vector_or(reader, "translation", glm::vec3(0.0F), kPosition);
        node.local.rotation = rotation(reader);
        node.local.scale =
            glm::vec3(static_cast<float>(reader.number_or("scale", 1.0, {.minimum = 1e-3, .maximum = 1e3})));
        node.mesh = find_named_if_there(reader, "mesh", scene_.meshes);
        node.camera = find_named_if_there(reader, "camera", scene_.cameras);
        node.light = find_named_if_there(reader, "light", scene_.lights);
        if (reader.has("extras")) {
            reader.object("extras");
            node.extras = reader.raw("extras");
        }
        reader.finish();
        scene_.nodes.push_back(std::move(node));
    }

    static glm::quat rotation(JsonReader& reader) {
        if (reader.has("look_at")) return looking_at(reader);
        const glm::dvec3 turns = kRadians * read_vector_or(reader, "yaw_pitch_roll_deg", glm::dvec3(0.0), kDegrees);
        return glm::quat(glm::angleAxis(turns.x, glm::dvec3(0.0, 1.0, 0.0)) *
                         glm::angleAxis(turns.y, glm::dvec3(1.0, 0.0, 0.0)) *
                         glm::angleAxis(turns.z, glm::dvec3(0.0, 0.0, 1.0)));
    }

    static glm::quat looking_at(JsonReader& reader) {
        if (reader.has("yaw_pitch_roll_deg"))
            reader.fail("yaw_pitch_roll_deg", "beside look_at", "one of the two", "remove one");
        const auto from = read_vector_or(reader, "translation", glm::dvec3(0.0), kPosition);
        const glm::dvec3 way = read_vector<glm::dvec3>(reader, "look_at", kPosition) - from;
        if (!(glm::length(way) > 1e-6)) reader.fail("look_at", "the node's own position", "another point");
        const glm::dvec3 ahead = glm::normalize(way);
        const bool upright = std::abs(ahead.y) > 1.0 - 1e-9;
        return glm::quat(glm::quatLookAt(ahead, upright ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0)));
    }

    JsonReader reader_;
    SceneRecipe recipe_;
    GlbScene& scene_ = recipe_.scene;
};

/// Of a PNG that can be decoded.
image::ByteImageSize size_of_picture(std::span<const std::byte> png, const std::string& name) {
    if (!image::is_png(png)) refuse_input(name, "", "no PNG", "a PNG file", "convert it");
    const image::ByteImage picture = image::decode_png(png, name);
    return {picture.width, picture.height};
}

/// Reads the textures that are pictures.
void add_pictures(const SceneRecipe& recipe, const ReadFile& read, GlbScene& scene) {
    std::size_t texels = 0;
    for (std::size_t i = 0; i < recipe.textures.size(); ++i) {
        const TextureRecipe& texture = recipe.textures[i];
        image::ByteImageSize size{texture.width, texture.height};
        if (!texture.picture.empty()) {
            const std::filesystem::path file = std::filesystem::path(recipe.file).parent_path() / texture.picture;
            scene.textures[i].png = read(file, kLargestPicture);
            size = size_of_picture(scene.textures[i].png, file.string());
        }
        texels += static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
        if (texels > kMostTexels)
            refuse_input(recipe.file,
                         fmt::format("/scene/textures/{}/{}", i, texture.picture.empty() ? "size" : "picture"),
                         fmt::format("{} texels", texels), fmt::format("at most {} in all textures", kMostTexels));
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

/// The textures painted last. A running program cooks a scene at every save; its textures are most of the work and
/// rarely change.
class TextureCache {
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
    static TextureCache cache;
    if (auto png = cache.find(recipe)) return *std::move(png);
    const PaintedTexture painted = paint(recipe);
    std::vector<std::byte> png = image::encode_png(recipe.width, recipe.height, painted.channels, painted.texels);
    cache.keep(recipe, png);
    return png;
}

}  // namespace

GlbScene build_scene(const SceneRecipe& recipe, const ReadFile& read) {
    GlbScene scene = recipe.scene;
    add_pictures(recipe, read, scene);
    parallel_for(recipe.textures.size(), [&](std::size_t i) {
        if (recipe.textures[i].picture.empty()) scene.textures[i].png = png_of(recipe.textures[i]);
    });
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < recipe.meshes.size(); ++i) {
        for (const SceneRecipe::Part& part : recipe.meshes[i]) {
            scene.meshes[i].primitives.push_back({build_mesh(part.shape), part.material});
            vertices += scene.meshes[i].primitives.back().mesh.positions.size();
            if (vertices > kMostVertices)
                refuse_input(recipe.file, fmt::format("/scene/meshes/{}", i), fmt::format("{} vertices", vertices),
                             fmt::format("at most {} in all meshes", kMostVertices), "take fewer rings and segments");
        }
    }
    return scene;
}

}  // namespace rowland::scene
