#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

struct AnimationSampler {
    std::size_t input = 0;  ///< accessors
    std::size_t output = 0;
    Interpolation interpolation = Interpolation::Linear;
};

std::optional<AnimatedProperty> property_of(const std::string& path) {
    if (path == "translation") return AnimatedProperty::Translation;
    if (path == "rotation") return AnimatedProperty::Rotation;
    if (path == "scale") return AnimatedProperty::Scale;
    return std::nullopt;
}

AnimationSampler read_animation_sampler(const GltfJson& json, JsonReader& sampler) {
    AnimationSampler to;
    to.input = json.index(sampler, "input", "accessors");
    to.output = json.index(sampler, "output", "accessors");
    if (sampler.has("interpolation"))
        to.interpolation =
            sampler.choice<Interpolation>("interpolation", {{"STEP", Interpolation::Step},
                                                            {"LINEAR", Interpolation::Linear},
                                                            {"CUBICSPLINE", Interpolation::CubicSpline}});
    return to;
}

struct ChannelImport {
    const GltfDocument& document;
    const AnimationSampler& sampler;
    const std::string& pointer;  ///< JSON pointer
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

    /// Rotations may be normalised integers, the rest is floats (glTF 2.0, 3.11).
    void check_type(AnimatedProperty property) const {
        const GltfAccessor& output = document.accessors[sampler.output];
        const bool is_rotation = property == AnimatedProperty::Rotation;
        const bool fits = output.columns == 1 && output.rows == (is_rotation ? 4 : 3) &&
                          (output.type == ComponentType::Float ||
                           (is_rotation && output.normalised && output.type != ComponentType::Uint32));
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
        AnimationChannel channel{node, property, sampler.interpolation, times(), values(property)};
        const std::size_t expected =
            channel.times_s.size() * (sampler.interpolation == Interpolation::CubicSpline ? 3 : 1);
        if (channel.values.size() != expected)
            fail(fmt::format("{} values for {} keys", channel.values.size(), channel.times_s.size()),
                 fmt::format("{}", expected));
        for (const glm::vec4& value : channel.values)
            for (int i = 0; i < 4; ++i)
                if (!std::isfinite(value[i])) fail("a value that is infinite or not a number", "finite values");
        return channel;
    }
};

/// The channel; nullopt if it moves no shown node.
std::optional<AnimationChannel> read_channel(const GltfJson& json, const GltfDocument& document, JsonReader& channel,
                                             const std::vector<AnimationSampler>& samplers,
                                             std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget) {
    if (samplers.empty()) channel.fail("sampler", "a sampler", "none: the animation has no samplers");
    const AnimationSampler& sampler = samplers[read_index(channel, "sampler", samplers.size(), "samplers")];
    JsonReader target = channel.object("target");
    // A channel without a node belongs to an extension.
    const std::optional<std::size_t> node = json.index_if_there(target, "node", "nodes");
    const std::string path = target.text("path");
    const std::optional<AnimatedProperty> property = property_of(path);
    if (!property) json.warn(fmt::format("animation of {:.40} is ignored", path));
    if (!node || !property || !shown[*node]) return std::nullopt;
    return ChannelImport{document, sampler, channel.pointer_to("sampler"), budget}.channel(*property, *shown[*node]);
}

}  // namespace

std::vector<Animation> import_animations(const GltfJson& json, const GltfDocument& document,
                                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget) {
    std::vector<Animation> animations;
    for (JsonReader& animation : json.objects("animations")) {
        Animation to;
        to.name = animation.text_or("name", "");
        std::vector<AnimationSampler> samplers;
        for (JsonReader& sampler : animation.objects("samplers"))
            samplers.push_back(read_animation_sampler(json, sampler));
        for (JsonReader& reader : animation.objects("channels")) {
            auto channel = read_channel(json, document, reader, samplers, shown, budget);
            if (!channel) continue;
            to.duration_s = std::max(to.duration_s, channel->times_s.back());
            to.channels.push_back(*std::move(channel));
        }
        if (!to.channels.empty()) animations.push_back(std::move(to));
    }
    return animations;
}

}  // namespace rowland::scene
