#include "engine/scene/gltf_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_index.h"

namespace rowland::scene {

namespace {

std::optional<AnimatedProperty> property_of(const std::string& path) {
    if (path == "translation") return AnimatedProperty::Translation;
    if (path == "rotation") return AnimatedProperty::Rotation;
    if (path == "scale") return AnimatedProperty::Scale;
    return std::nullopt;
}

GltfAnimationSampler read_sampler(const nlohmann::json& json, JsonReader& sampler) {
    GltfAnimationSampler to;
    to.input = index_into(json, sampler, "input", "accessors");
    to.output = index_into(json, sampler, "output", "accessors");
    const std::string name = sampler.choice_or("interpolation", "LINEAR", {"STEP", "LINEAR", "CUBICSPLINE"});
    to.interpolation = name == "STEP"     ? Interpolation::Step
                       : name == "LINEAR" ? Interpolation::Linear
                                          : Interpolation::CubicSpline;
    return to;
}

/// The channel if it moves a node.
std::optional<GltfAnimationChannel> read_channel(const nlohmann::json& json, JsonReader& channel,
                                                 std::size_t sampler_count, std::vector<std::string>& warnings) {
    if (sampler_count == 0) channel.fail("sampler", "a sampler", "none: the animation has no samplers");
    const std::int64_t sampler = channel.integer("sampler", 0, static_cast<std::int64_t>(sampler_count) - 1);
    JsonReader target = channel.object("target");
    const std::optional<std::size_t> node = index_if_there(json, target, "node", "nodes");
    const std::string path = target.text("path");
    const std::optional<AnimatedProperty> property = property_of(path);
    if (!property) warn_once(warnings, fmt::format("animation of {:.40} is ignored", path));
    // Without a node it is an extension's.
    if (!node || !property) return std::nullopt;
    return GltfAnimationChannel{static_cast<std::size_t>(sampler), *node, *property, channel.pointer_to("sampler")};
}

/// Where one channel is imported, for every step of it.
struct ChannelImport {
    const GltfDocument& document;
    const GltfAnimationSampler& sampler;
    const std::string& place;
    MemoryBudget& budget;

    [[noreturn]] void fail(std::string found, std::string expected) const {
        refuse_input(document.file, place, std::move(found), std::move(expected));
    }

    std::vector<float> times() const {
        require_data(document, sampler.input, place, "the times");
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
        require_data(document, sampler.output, place, "the values");
        check_type(property);
        if (property == AnimatedProperty::Rotation) return read_vectors<glm::vec4>(document, sampler.output, budget);
        const std::vector<glm::vec3> read = read_vectors<glm::vec3>(document, sampler.output, budget);
        budget.spend(read.size(), sizeof(glm::vec4), place);
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

}  // namespace

std::vector<GltfAnimation> read_animations(const nlohmann::json& json, const std::string& file,
                                           std::vector<std::string>& warnings) {
    std::vector<GltfAnimation> animations;
    for (JsonReader& animation : root_objects(json, file, "animations")) {
        GltfAnimation& added = animations.emplace_back();
        added.name = text_if_there(animation, "name");
        for (JsonReader& sampler : animation.objects("samplers")) added.samplers.push_back(read_sampler(json, sampler));
        for (JsonReader& channel : animation.objects("channels"))
            if (auto read = read_channel(json, channel, added.samplers.size(), warnings))
                added.channels.push_back(std::move(*read));
    }
    return animations;
}

std::vector<Animation> import_animations(const GltfDocument& document,
                                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget) {
    std::vector<Animation> animations;
    for (const GltfAnimation& from : document.animations) {
        Animation to;
        to.name = from.name;
        for (const GltfAnimationChannel& channel : from.channels) {
            if (!shown[channel.node]) continue;
            const ChannelImport import{document, from.samplers[channel.sampler], channel.place, budget};
            to.channels.push_back(import.channel(channel.property, *shown[channel.node]));
            to.duration_s = std::max(to.duration_s, to.channels.back().times_s.back());
        }
        if (!to.channels.empty()) animations.push_back(std::move(to));
    }
    return animations;
}

}  // namespace rowland::scene
