// Nodes of a glTF file, with their lights, cameras, skins and animations.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <ranges>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_parts.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

namespace {

/// Upper bound of the memory of a parsed JSON value, bytes per character of its text; {"a":0} takes a map node.
constexpr std::size_t kJsonBytesPerCharacter = 20;

template <typename Vector>
Vector vector_or(const std::vector<double>& numbers, const Vector& fallback) {
    if (numbers.empty()) return fallback;
    Vector vector;
    for (int i = 0; i < Vector::length(); ++i) vector[i] = numbers[static_cast<std::size_t>(i)];
    return vector;
}

/// A node's matrix, and the translation, rotation and scale that it has without its shear.
struct LocalTransform {
    glm::dmat4 matrix{1.0};
    Transform parts;
};

LocalTransform local_transform(const gltf::Node& node, std::vector<std::string>& warnings) {
    LocalTransform local;
    if (!node.matrix.empty()) {
        std::ranges::copy(node.matrix, &local.matrix[0][0]);
        // glTF allows affine matrices only; the bottom row of any other is dropped.
        for (int column = 0; column < 4; ++column) local.matrix[column][3] = column == 3 ? 1.0 : 0.0;
        const Decomposition parts = decompose(local.matrix);
        local.parts = parts.transform;
        if (parts.sheared)
            warn_once(warnings, "a node's matrix holds shear, which is lost where something animates it");
        return local;
    }
    const auto translation = vector_or(node.translation, glm::dvec3(0.0));
    const auto v = vector_or(node.rotation, glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const double length = glm::length(v);
    const glm::dquat rotation(v.w / length, v.x / length, v.y / length, v.z / length);
    const auto scale = vector_or(node.scale, glm::dvec3(1.0));
    local.matrix = glm::mat4_cast(rotation);
    for (int column = 0; column < 3; ++column) local.matrix[column] *= scale[column];
    local.matrix[3] = glm::dvec4(translation, 1.0);
    local.parts = {glm::vec3(translation), glm::quat(rotation), glm::vec3(scale)};
    return local;
}

bool fits_floats(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(m[column][row]) <= static_cast<double>(std::numeric_limits<float>::max()))) return false;
    return true;
}

/// The root nodes of the scene to show: the default scene, else the first one. A file without scenes shows the nodes
/// without a parent.
std::vector<int> root_nodes(const gltf::Model& model) {
    if (!model.scenes.empty()) return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const gltf::Node& node : model.nodes)
        for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

/// A light's size, which glTF lacks: a number in its node's extras.
float size_of(const nlohmann::json& extras, const GltfDocument& document, const std::string& pointer, const char* key,
              double fallback, double largest) {
    if (!extras.is_object()) return static_cast<float>(fallback);
    JsonReader reader(extras, document.file, pointer + "/extras");
    return static_cast<float>(reader.number_or(key, fallback, {.minimum = 0.0, .maximum = largest}));
}

std::variant<DirectionalLight, PunctualLight> light_of(const gltf::Light& from, const nlohmann::json& extras,
                                                       const GltfDocument& document, const std::string& pointer) {
    const glm::vec3 strength(vector_or(from.color, glm::dvec3(1.0)) * from.intensity);
    // The light shines along the node's −Z, so +Z is the direction toward it.
    if (from.type == "directional") {
        const float diameter_deg =
            size_of(extras, document, pointer, "light_angle", glm::degrees(2.0 * kSunAngularRadius), 90.0);
        return DirectionalLight{.direction = {0.0F, 0.0F, 1.0F},
                                .irradiance = strength,
                                .angular_radius = 0.5F * glm::radians(diameter_deg),
                                .casts_shadow = is_marked(extras, "casts_shadow")};
    }
    PunctualLight light{.intensity = strength,
                        .radius_m = size_of(extras, document, pointer, "light_radius", kBulbRadius_m, 1000.0),
                        .range_m = static_cast<float>(from.range),
                        .spot = from.type == "spot"};
    if (!light.spot) return light;
    light.inner_cone = static_cast<float>(from.spot.innerConeAngle);
    light.outer_cone = static_cast<float>(from.spot.outerConeAngle);
    return light;
}

ImportedCamera camera_of(const gltf::Camera& from, std::size_t node) {
    const gltf::PerspectiveCamera& lens = from.perspective;
    ImportedCamera camera{.name = from.name,
                          .node = node,
                          .vertical_field_of_view = static_cast<float>(lens.yfov),
                          .near_plane = static_cast<float>(lens.znear),
                          .far_plane = {}};
    if (lens.zfar > 0.0) camera.far_plane = static_cast<float>(lens.zfar);
    return camera;
}

ImportedProbe probe_of(const gltf::Value& from, std::size_t node, const std::string& file, const std::string& pointer) {
    ImportedProbe probe{.node = node,
                        .fade_m = static_cast<float>(number_or(from, "fade_m", ImportedProbe{}.fade_m)),
                        .file = relative_path_of_uri(file, from.Get("probe").Get<std::string>(), pointer + "/probe")};
    for (int i = 0; i < 3; ++i) probe.size_m[i] = static_cast<float>(from.Get("size_m").Get(i).GetNumberAsDouble());
    return probe;
}

/// A node to show, and the node of the scene that is its parent.
struct PendingNode {
    int node = 0;
    std::optional<std::size_t> parent;
    glm::dmat4 above{1.0};  ///< the parent's world matrix
};

class NodeImport {
 public:
    NodeImport(const GltfDocument& document, MemoryBudget& budget, ImportedScene& scene)
        : document_(document), budget_(budget), scene_(scene), shown_(document.model.nodes.size()) {}

    ShownNodes run() {
        // Not recursive: a chain of nodes may be deeper than the thread's stack.
        std::vector<PendingNode> pending;
        for (const int root : root_nodes(document_.model) | std::views::reverse) pending.push_back({root, {}});
        while (!pending.empty()) {
            const PendingNode current = pending.back();
            pending.pop_back();
            const glm::dmat4 world = add(current);
            const gltf::Node& node = document_.model.nodes[static_cast<std::size_t>(current.node)];
            for (const int child : node.children | std::views::reverse)
                pending.push_back({child, scene_.nodes.size() - 1, world});
        }
        return std::move(shown_);
    }

 private:
    glm::dmat4 add(const PendingNode& pending) {
        const auto index = static_cast<std::size_t>(pending.node);
        const gltf::Node& node = document_.model.nodes[index];
        const std::string pointer = fmt::format("/nodes/{}", index);
        if (shown_[index])
            refuse_input(document_.file, pointer, "a node with two parents, or its own descendant", "a tree");
        const std::size_t at = scene_.nodes.size();
        shown_[index] = at;
        const LocalTransform local = local_transform(node, scene_.warnings);
        const glm::dmat4 world = pending.above * local.matrix;
        if (!fits_floats(world)) refuse_input(document_.file, pointer, "a transform that overflows", "finite numbers");
        budget_.spend(1, sizeof(ImportedNode) + node.name.size(), pointer);
        scene_.nodes.push_back({node.name, pending.parent, local.parts, glm::mat4(world), extras_of(index, pointer)});
        if (const auto light = node.extensions.find(kLightExtension); light != node.extensions.end()) {
            const int which = light->second.Get("light").GetNumberAsInt();
            scene_.lights.push_back({at, light_of(document_.model.lights[static_cast<std::size_t>(which)],
                                                  scene_.nodes.back().extras, document_, pointer)});
        }
        if (const auto probe = node.extensions.find(kProbeExtension); probe != node.extensions.end()) {
            scene_.probes.push_back(
                probe_of(probe->second, at, document_.file, pointer + "/extensions/" + kProbeExtension));
            scene_.probes.back().gltf_node = index;
            if (glm::determinant(glm::mat3(scene_.nodes.back().world)) == 0.0F)
                scene_.warnings.push_back(fmt::format("{}: the box has no volume and lights nothing", pointer));
        }
        if (node.camera >= 0)
            if (const gltf::Camera& camera = document_.model.cameras[static_cast<std::size_t>(node.camera)];
                camera.type == "perspective")
                scene_.cameras.push_back(camera_of(camera, at));
        return world;
    }

    nlohmann::json extras_of(std::size_t index, const std::string& pointer) {
        const nlohmann::json& extras = document_.extras("nodes", index);
        if (extras.is_null()) return extras;
        const std::size_t bytes = extras.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).size();
        if (bytes > kMostExtrasBytes) {
            warn_once(scene_.warnings, "extras of more than 64 KiB are ignored");
            return nullptr;
        }
        budget_.spend(bytes, kJsonBytesPerCharacter, pointer + "/extras");
        return extras;
    }

    const GltfDocument& document_;
    MemoryBudget& budget_;
    ImportedScene& scene_;
    ShownNodes shown_;
};

/// `matrix` with the bottom row of an affine matrix. Throws if another element is not finite.
glm::mat4 checked_bind(glm::mat4 matrix, const std::string& file, const std::string& pointer) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(matrix[column][row]))
                refuse_input(file, pointer, "an inverse bind matrix that is infinite or not a number",
                             "finite numbers");
        matrix[column][3] = column == 3 ? 1.0F : 0.0F;
    }
    return matrix;
}

std::optional<AnimatedProperty> property_of(const std::string& path) {
    if (path == "translation") return AnimatedProperty::Translation;
    if (path == "rotation") return AnimatedProperty::Rotation;
    if (path == "scale") return AnimatedProperty::Scale;
    return std::nullopt;
}

struct ChannelImport {
    const GltfDocument& document;
    const gltf::AnimationSampler& sampler;
    const std::string& pointer;  ///< JSON pointer of the sampler
    MemoryBudget& budget;

    [[noreturn]] void fail(std::string found, std::string expected) const {
        refuse_input(document.file, pointer, std::move(found), std::move(expected));
    }

    std::vector<float> times() const {
        std::vector<float> times = read_floats(document, sampler.input, budget);
        for (std::size_t i = 0; i < times.size(); ++i)
            if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
                fail(fmt::format("time {} of key {}", times[i], i), "finite times, each later than the one before");
        return times;
    }

    /// Rotations may be normalised integers; the other properties are floats (glTF 2.0, 3.11).
    void check_type(AnimatedProperty property) const {
        const gltf::Accessor& output = document.model.accessors[static_cast<std::size_t>(sampler.output)];
        const bool is_rotation = property == AnimatedProperty::Rotation;
        const bool fits =
            output.type == (is_rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3) &&
            (output.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
             (is_rotation && output.normalized && output.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT));
        if (!fits)
            fail("values of another type",
                 is_rotation ? "vectors of 4 floats or normalised integers" : "vectors of 3 floats");
    }

    std::vector<glm::vec4> values(AnimatedProperty property) const {
        check_type(property);
        if (property == AnimatedProperty::Rotation) return read_vectors<glm::vec4>(document, sampler.output, budget);
        const std::vector<glm::vec3> read = read_vectors<glm::vec3>(document, sampler.output, budget);
        budget.spend(read.size(), sizeof(glm::vec4), pointer);
        std::vector<glm::vec4> values;
        values.reserve(read.size());
        for (const glm::vec3& value : read) values.emplace_back(value, 0.0F);
        return values;
    }

    AnimationChannel channel(AnimatedProperty property, std::size_t node) const {
        const Interpolation interpolation = sampler.interpolation == "STEP"     ? Interpolation::Step
                                            : sampler.interpolation == "LINEAR" ? Interpolation::Linear
                                                                                : Interpolation::CubicSpline;
        AnimationChannel channel{node, property, interpolation, times(), values(property)};
        const std::size_t expected = channel.times_s.size() * (interpolation == Interpolation::CubicSpline ? 3 : 1);
        if (channel.values.size() != expected)
            fail(fmt::format("{} values for {} keys", channel.values.size(), channel.times_s.size()),
                 fmt::format("{}", expected));
        for (const glm::vec4& value : channel.values)
            for (int i = 0; i < 4; ++i)
                if (!std::isfinite(value[i])) fail("a value that is infinite or not a number", "finite values");
        return channel;
    }
};

}  // namespace

ShownNodes import_nodes(const GltfDocument& document, MemoryBudget& budget, ImportedScene& scene) {
    return NodeImport(document, budget, scene).run();
}

ImportedSkin import_skin(const GltfDocument& document, std::size_t skin, const ShownNodes& shown,
                         MemoryBudget& budget) {
    const gltf::Skin& from = document.model.skins.at(skin);
    const std::string pointer = fmt::format("/skins/{}", skin);
    budget.spend(from.joints.size(), sizeof(std::size_t) + sizeof(glm::mat4), pointer);
    ImportedSkin to;
    for (const int joint : from.joints) {
        const std::optional<std::size_t> node = shown[static_cast<std::size_t>(joint)];
        if (!node)
            refuse_input(document.file, pointer + "/joints", fmt::format("joint {} outside the scene", joint),
                         "joints in the scene of the skinned mesh", "put the skeleton into the scene");
        to.joints.push_back(*node);
    }
    to.inverse_bind.assign(from.joints.size(), glm::mat4(1.0F));
    if (from.inverseBindMatrices < 0) return to;
    const std::vector<glm::mat4> given = read_matrices(document, from.inverseBindMatrices, budget);
    if (given.size() < from.joints.size())
        refuse_input(document.file, pointer, fmt::format("{} inverse bind matrices", given.size()),
                     fmt::format("one for each of the {} joints", from.joints.size()));
    for (std::size_t i = 0; i < to.inverse_bind.size(); ++i)
        to.inverse_bind[i] = checked_bind(given[i], document.file, pointer);
    return to;
}

std::vector<Animation> import_animations(const GltfDocument& document, const ShownNodes& shown, MemoryBudget& budget) {
    std::vector<Animation> animations;
    for (std::size_t i = 0; i < document.model.animations.size(); ++i) {
        const gltf::Animation& from = document.model.animations[i];
        Animation to;
        to.name = from.name;
        for (const gltf::AnimationChannel& channel : from.channels) {
            const std::optional<AnimatedProperty> property = property_of(channel.target_path);
            const std::optional<std::size_t> node = shown[static_cast<std::size_t>(channel.target_node)];
            if (!property || !node) continue;
            const std::string pointer = fmt::format("/animations/{}/samplers/{}", i, channel.sampler);
            const gltf::AnimationSampler& sampler = from.samplers[static_cast<std::size_t>(channel.sampler)];
            to.channels.push_back(ChannelImport{document, sampler, pointer, budget}.channel(*property, *node));
            to.duration_s = std::max(to.duration_s, to.channels.back().times_s.back());
        }
        if (!to.channels.empty()) animations.push_back(std::move(to));
    }
    return animations;
}

}  // namespace rowland::scene
