#include "engine/scene/gltf_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/json_schema.h"
#include "engine/scene/tinygltf.h"

namespace rowland::scene {

namespace {

using Json = nlohmann::json;

// KHR_mesh_quantization needs no code of its own: quantised attributes are read as any other accessor.
constexpr std::array<std::string_view, 9> kSupportedExtensions = {
    kDracoExtension,       kLightExtension,         "KHR_materials_clearcoat",  "KHR_materials_emissive_strength",
    "KHR_materials_unlit", "KHR_mesh_quantization", kTextureTransformExtension, kWearExtension,
    kProbeExtension};

/// A member of a glTF object, and what its value must be.
struct Member {
    enum class Kind { Text, Boolean, Integer, Code, Number, Numbers, Word, Index, Indices, Object, Objects, Map };

    const char* key = nullptr;
    Kind kind = Kind::Text;
    bool required = false;
    std::int64_t least = 0;  ///< Integer, Map
    std::int64_t most = 0;
    NumberRange range{};                        ///< Number, Numbers
    std::size_t count = 0;                      ///< Numbers: how many; Objects: bytes that each takes once parsed
    std::span<const std::int64_t> codes{};      ///< Code: the allowed integers
    std::span<const std::string_view> words{};  ///< Word: the allowed texts
    const char* target = nullptr;               ///< Index, Indices, Map: JSON pointer of the indexed array;
                                                ///< "samplers": a member of the object that encloses the owner
    std::span<const Member> members{};          ///< Object, Objects
    bool ours = false;                          ///< an Object of our own, which has no other members

    constexpr Member operator!() const {
        Member member = *this;
        member.required = true;
        return member;
    }
};

using Kind = Member::Kind;
constexpr Member text(const char* key) {
    return {.key = key};
}
constexpr Member boolean(const char* key) {
    return {.key = key, .kind = Kind::Boolean};
}
constexpr Member integer(const char* key, std::int64_t least, std::int64_t most) {
    return {.key = key, .kind = Kind::Integer, .least = least, .most = most};
}
constexpr Member code(const char* key, std::span<const std::int64_t> codes) {
    return {.key = key, .kind = Kind::Code, .codes = codes};
}
constexpr Member number(const char* key, NumberRange range) {
    return {.key = key, .kind = Kind::Number, .range = range};
}
constexpr Member numbers(const char* key, std::size_t count, NumberRange range) {
    return {.key = key, .kind = Kind::Numbers, .range = range, .count = count};
}
constexpr Member word(const char* key, std::span<const std::string_view> words) {
    return {.key = key, .kind = Kind::Word, .words = words};
}
constexpr Member index(const char* key, const char* target) {
    return {.key = key, .kind = Kind::Index, .target = target};
}
constexpr Member indices(const char* key, const char* target) {
    return {.key = key, .kind = Kind::Indices, .target = target};
}
constexpr Member object(const char* key, std::span<const Member> members) {
    return {.key = key, .kind = Kind::Object, .members = members};
}
constexpr Member our_extension(const char* key, std::span<const Member> members) {
    return {.key = key, .kind = Kind::Object, .members = members, .ours = true};
}
constexpr Member objects(const char* key, std::span<const Member> members, std::size_t bytes_each) {
    return {.key = key, .kind = Kind::Objects, .count = bytes_each, .members = members};
}
/// An object whose every member is an index, or, without a target, an integer of 31 bits.
constexpr Member map(const char* key, const char* target) {
    return {.key = key, .kind = Kind::Map, .most = std::numeric_limits<std::int32_t>::max(), .target = target};
}

constexpr std::int64_t kMaximumBytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kMaximumCount = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMaximumUvSet = 1 << 20;
// Exporters round, so factors may be a little over 1; the import clamps them.
constexpr NumberRange kFactor{.minimum = 0.0, .maximum = 1.001};
constexpr NumberRange kWearSize{.minimum = 0.005, .maximum = 2.0};
constexpr NumberRange kUnit{.minimum = -1.001, .maximum = 1.001};
// Far above any real light; the product of two stays finite.
constexpr NumberRange kEmission{.minimum = 0.0, .maximum = 1e6};
constexpr NumberRange kNotNegative{.minimum = 0.0, .maximum = std::numeric_limits<float>::max()};
// The sun has 1e5 lux; a light of more than ten million suns is a mistake.
constexpr NumberRange kIntensity{.minimum = 0.0, .maximum = 1e12};
constexpr NumberRange kLightRange{.minimum = 0.0, .maximum = 1e12, .exclusive_minimum = true};
// Of a probe's box, in metres.
constexpr NumberRange kInnerCone{.minimum = 0.0, .maximum = std::numbers::pi / 2.0, .exclusive_maximum = true};
// Exporters write π / 2 in digits that may round up.
constexpr NumberRange kOuterCone{.minimum = 0.0, .maximum = std::numbers::pi / 2.0 + 1e-6, .exclusive_minimum = true};
// Outside these ranges floats cannot resolve the projection.
constexpr NumberRange kFieldOfView{.minimum = 1e-4, .maximum = std::numbers::pi - 1e-4};
constexpr NumberRange kPlane{.minimum = 1e-9, .maximum = 1e12};

constexpr std::array<std::int64_t, 6> kComponents = {5120, 5121, 5122, 5123, 5125, 5126};
constexpr std::array<std::int64_t, 3> kIndexComponents = {5121, 5123, 5125};
constexpr std::array<std::int64_t, 3> kWraps = {10497, 33071, 33648};
constexpr std::array<std::int64_t, 2> kMagFilters = {9728, 9729};
constexpr std::array<std::int64_t, 6> kMinFilters = {9728, 9729, 9984, 9985, 9986, 9987};
constexpr std::array<std::string_view, 7> kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::array<std::string_view, 3> kAlphaModes = {"OPAQUE", "MASK", "BLEND"};
constexpr std::array<std::string_view, 3> kInterpolations = {"STEP", "LINEAR", "CUBICSPLINE"};
constexpr std::array<std::string_view, 3> kLightTypes = {"directional", "point", "spot"};
constexpr std::array<std::string_view, 2> kCameraTypes = {"perspective", "orthographic"};

constexpr std::array kBuffer = {!integer("byteLength", 1, kMaximumBytes), text("uri")};
constexpr std::array kView = {!index("buffer", "/buffers"), !integer("byteLength", 0, kMaximumBytes),
                              integer("byteOffset", 0, kMaximumBytes), integer("byteStride", 4, 252)};
constexpr std::array kSparseIndices = {!index("bufferView", "/bufferViews"), integer("byteOffset", 0, kMaximumBytes),
                                       !code("componentType", kIndexComponents)};
constexpr std::array kSparseValues = {!index("bufferView", "/bufferViews"), integer("byteOffset", 0, kMaximumBytes)};
constexpr std::array kSparse = {!integer("count", 1, kMaximumCount), !object("indices", kSparseIndices),
                                !object("values", kSparseValues)};
constexpr std::array kAccessor = {!word("type", kTypes),
                                  index("bufferView", "/bufferViews"),
                                  integer("byteOffset", 0, kMaximumBytes),
                                  !integer("count", 1, kMaximumCount),
                                  !code("componentType", kComponents),
                                  boolean("normalized"),
                                  object("sparse", kSparse)};

constexpr std::array kDraco = {!index("bufferView", "/bufferViews"), !map("attributes", nullptr)};
constexpr std::array kPrimitiveExtensions = {object(kDracoExtension, kDraco)};
constexpr std::array kPrimitive = {!map("attributes", "/accessors"), index("indices", "/accessors"),
                                   index("material", "/materials"), integer("mode", 0, TINYGLTF_MODE_TRIANGLE_FAN),
                                   object("extensions", kPrimitiveExtensions)};
constexpr std::array kMesh = {text("name"), !objects("primitives", kPrimitive, sizeof(gltf::Primitive))};

constexpr std::array kImage = {text("name"), text("mimeType"), index("bufferView", "/bufferViews"), text("uri")};
constexpr std::array kSampler = {code("wrapS", kWraps), code("wrapT", kWraps), code("magFilter", kMagFilters),
                                 code("minFilter", kMinFilters)};
constexpr std::array kTexture = {text("name"), index("source", "/images"), index("sampler", "/samplers")};

constexpr std::array kTransform = {numbers("offset", 2, kFiniteFloat), number("rotation", kFiniteFloat),
                                   numbers("scale", 2, kFiniteFloat), integer("texCoord", 0, kMaximumUvSet)};
constexpr std::array kUseExtensions = {object(kTextureTransformExtension, kTransform)};
constexpr std::array kUse = {!index("index", "/textures"), integer("texCoord", 0, kMaximumUvSet),
                             object("extensions", kUseExtensions)};
constexpr std::array kNormal = {kUse[0], kUse[1], kUse[2], number("scale", kFiniteFloat)};
constexpr std::array kOcclusion = {kUse[0], kUse[1], kUse[2], number("strength", kFactor)};
constexpr std::array kPbr = {numbers("baseColorFactor", 4, kFactor), number("metallicFactor", kFactor),
                             number("roughnessFactor", kFactor), object("baseColorTexture", kUse),
                             object("metallicRoughnessTexture", kUse)};
constexpr std::array kCoat = {number("clearcoatFactor", kFactor), number("clearcoatRoughnessFactor", kFactor)};
constexpr std::array kWear = {number("scratches", kFactor),
                              number("fingerprints", kFactor),
                              number("dust", kFactor),
                              number("size_m", kWearSize),
                              integer("seed", 0, std::numeric_limits<std::int32_t>::max()),
                              integer("texCoord", 0, 1),
                              object("maskTexture", kUse)};
constexpr std::array kStrength = {number("emissiveStrength", kEmission)};
constexpr std::array kMaterialExtensions = {
    object("KHR_materials_unlit", {}), object("KHR_materials_emissive_strength", kStrength),
    object("KHR_materials_clearcoat", kCoat), our_extension(kWearExtension, kWear)};
constexpr std::array kMaterial = {text("name"),
                                  object("pbrMetallicRoughness", kPbr),
                                  object("normalTexture", kNormal),
                                  object("occlusionTexture", kOcclusion),
                                  object("emissiveTexture", kUse),
                                  numbers("emissiveFactor", 3, kEmission),
                                  word("alphaMode", kAlphaModes),
                                  number("alphaCutoff", kNotNegative),
                                  boolean("doubleSided"),
                                  object("extensions", kMaterialExtensions)};

constexpr std::array kSkin = {text("name"), !indices("joints", "/nodes"), index("inverseBindMatrices", "/accessors"),
                              index("skeleton", "/nodes")};

constexpr std::array kPerspective = {!number("yfov", kFieldOfView), !number("znear", kPlane), number("zfar", kPlane)};
constexpr std::array kCamera = {text("name"), !word("type", kCameraTypes), object("perspective", kPerspective)};

constexpr std::array kSpot = {number("innerConeAngle", kInnerCone), number("outerConeAngle", kOuterCone)};
constexpr std::array kLight = {text("name"),
                               !word("type", kLightTypes),
                               numbers("color", 3, kEmission),
                               number("intensity", kIntensity),
                               number("range", kLightRange),
                               object("spot", kSpot)};
constexpr std::array kLights = {!objects("lights", kLight, sizeof(gltf::Light))};

constexpr std::array kNodeLight = {!index("light", "/extensions/KHR_lights_punctual/lights")};
constexpr std::array kNodeProbe = {!numbers("size_m", 3, kProbeBoxSide), number("fade_m", kProbeFade), !text("probe")};
constexpr std::array kNodeExtensions = {object(kLightExtension, kNodeLight),
                                        our_extension(kProbeExtension, kNodeProbe)};
constexpr std::array kNode = {text("name"),
                              index("mesh", "/meshes"),
                              index("skin", "/skins"),
                              index("camera", "/cameras"),
                              indices("children", "/nodes"),
                              numbers("translation", 3, kFiniteFloat),
                              numbers("rotation", 4, kUnit),
                              numbers("scale", 3, kFiniteFloat),
                              numbers("matrix", 16, kFiniteFloat),
                              object("extensions", kNodeExtensions)};
constexpr std::array kScene = {text("name"), indices("nodes", "/nodes")};

constexpr std::array kTarget = {index("node", "/nodes"), !text("path")};
constexpr std::array kChannel = {!index("sampler", "samplers"), !object("target", kTarget)};
constexpr std::array kAnimationSampler = {!index("input", "/accessors"), !index("output", "/accessors"),
                                          word("interpolation", kInterpolations)};
constexpr std::array kAnimation = {text("name"),
                                   !objects("samplers", kAnimationSampler, sizeof(gltf::AnimationSampler)),
                                   !objects("channels", kChannel, sizeof(gltf::AnimationChannel))};

constexpr std::array kAsset = {!text("version")};
constexpr std::array kRootExtensions = {object(kLightExtension, kLights)};
constexpr std::array kRoot = {!object("asset", kAsset),
                              objects("buffers", kBuffer, sizeof(gltf::Buffer)),
                              objects("bufferViews", kView, sizeof(gltf::BufferView)),
                              objects("accessors", kAccessor, sizeof(gltf::Accessor)),
                              objects("meshes", kMesh, sizeof(gltf::Mesh)),
                              objects("images", kImage, sizeof(gltf::Image)),
                              objects("samplers", kSampler, sizeof(gltf::Sampler)),
                              objects("textures", kTexture, sizeof(gltf::Texture)),
                              objects("materials", kMaterial, sizeof(gltf::Material)),
                              objects("skins", kSkin, sizeof(gltf::Skin)),
                              objects("cameras", kCamera, sizeof(gltf::Camera)),
                              object("extensions", kRootExtensions),
                              objects("nodes", kNode, sizeof(gltf::Node)),
                              objects("scenes", kScene, sizeof(gltf::Scene)),
                              index("scene", "/scenes"),
                              objects("animations", kAnimation, sizeof(gltf::Animation))};

/// Checks objects against lists of members and copies those members only.
class Check {
 public:
    Check(const Json& root, MemoryBudget& budget) : root_(root), budget_(budget) {}

    /// `around` is the object that holds `value`, in an array or directly.
    Json object(JsonReader& reader, const Json& value, std::span<const Member> members, const Json& around) {
        Json copy = Json::object();
        for (const Member& member : members)
            if (member.required || reader.has(member.key)) copy[member.key] = read(reader, value, member, around);
        return copy;
    }

    /// What any object of a glTF may have is allowed beside the members that were read.
    static void finish(JsonReader& reader) {
        reader.ignore("extensions");
        reader.ignore("extras");
        reader.finish();
    }

 private:
    Json read(JsonReader& reader, const Json& owner, const Member& member, const Json& around) {
        const std::string key = member.key;
        switch (member.kind) {
            case Kind::Text:
                return reader.text(key);
            case Kind::Boolean:
                return reader.boolean_or(key, false);
            case Kind::Integer:
                return reader.integer(key, member.least, member.most);
            case Kind::Code:
                return read_code(reader, member);
            case Kind::Number:
                return reader.number(key, member.range);
            case Kind::Numbers:
                return reader.numbers(key, member.count, member.range);
            case Kind::Word:
                return reader.choice(key, {member.words.begin(), member.words.end()});
            case Kind::Index:
                return read_index(reader, key, member.target, around);
            case Kind::Indices:
                return read_indices(reader, member);
            case Kind::Object: {
                JsonReader inner = reader.object(key);
                const Json& value = reader.is_recording_schema() ? owner : owner.at(key);
                Json copy = object(inner, value, member.members, owner);
                if (member.ours) finish(inner);
                return copy;
            }
            case Kind::Objects:
                return read_objects(reader, owner, member);
            case Kind::Map:
                return read_map(reader, owner, member, around);
        }
        return {};
    }

    static Json read_code(JsonReader& reader, const Member& member) {
        const std::int64_t found = reader.integer(member.key, 0, 65535);
        if (std::ranges::find(member.codes, found) == member.codes.end())
            reader.fail(member.key, fmt::format("{}", found), fmt::format("one of {}", fmt::join(member.codes, ", ")));
        return found;
    }

    std::size_t size_of(const char* target, const Json& around) {
        if (*target != '/') {
            const auto found = around.find(target);
            return found == around.end() ? 0 : found->size();
        }
        const auto [size, is_new] = sizes_.try_emplace(target, 0);
        if (is_new && root_.contains(Json::json_pointer(target)))
            size->second = root_.at(Json::json_pointer(target)).size();
        return size->second;
    }
    static std::string name_of(const std::string& target) { return target.substr(target.rfind('/') + 1); }

    Json read_index(JsonReader& reader, const std::string& key, const char* target, const Json& around) {
        if (reader.is_recording_schema()) return reader.integer(key, 0, kMaximumCount - 1);
        const std::size_t count = size_of(target, around);
        if (count == 0 && reader.has(key))
            reader.fail(
                key, "an index",
                fmt::format("no index: {} has no {}", *target == '/' ? "the file" : "the animation", name_of(target)),
                "the file is incomplete");
        return reader.integer(key, 0, static_cast<std::int64_t>(count) - 1);
    }

    Json read_indices(JsonReader& reader, const Member& member) {
        const Json& values = reader.raw(member.key);
        const std::size_t count = size_of(member.target, root_);
        if (!values.is_array())
            reader.fail(member.key, values.type_name(),
                        fmt::format("an array of indices of {}", name_of(member.target)));
        for (const Json& value : values)
            if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
                reader.fail(member.key, value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40),
                            fmt::format("an index below {}, the number of {}", count, name_of(member.target)));
        return values;
    }

    Json read_objects(JsonReader& reader, const Json& owner, const Member& member) {
        std::vector<JsonReader> readers = reader.objects(member.key);
        budget_.spend(readers.size(), member.count, reader.pointer_to(member.key));
        Json copies = Json::array();
        for (std::size_t i = 0; i < readers.size(); ++i)
            copies.push_back(object(readers[i], owner.at(member.key)[i], member.members, owner));
        return copies;
    }

    Json read_map(JsonReader& reader, const Json& owner, const Member& member, const Json& around) {
        JsonReader inner = reader.object(member.key);
        Json copy = Json::object();
        for (const auto& [name, ignored] : owner.at(member.key).items())
            copy[name] = member.target != nullptr ? read_index(inner, name, member.target, around)
                                                  : Json(inner.integer(name, member.least, member.most));
        return copy;
    }

    const Json& root_;
    MemoryBudget& budget_;
    std::map<std::string_view, std::size_t> sizes_;  ///< of the arrays that indices refer to, by JSON pointer
};

std::vector<std::string> read_names(JsonReader& root, const std::string& key) {
    std::vector<std::string> names;
    if (!root.has(key)) return names;
    const Json& values = root.raw(key);
    if (!values.is_array()) root.fail(key, values.type_name(), "an array of names");
    for (const Json& value : values) {
        if (!value.is_string()) root.fail(key, value.type_name(), "a name");
        names.push_back(value.get<std::string>());
    }
    return names;
}

void check_extensions(JsonReader& root, std::span<const std::string> handled, std::vector<std::string>& warnings) {
    const auto supports = [&](const std::string& name) {
        return std::ranges::find(kSupportedExtensions, name) != kSupportedExtensions.end() ||
               std::ranges::find(handled, name) != handled.end();
    };
    for (const std::string& name : read_names(root, "extensionsRequired"))
        if (!supports(name))
            root.fail("extensionsRequired", fmt::format("\"{:.80}\"", name),
                      fmt::format("no required extension but {}", fmt::join(kSupportedExtensions, ", ")),
                      "export the file without it");
    for (const std::string& name : read_names(root, "extensionsUsed"))
        if (!supports(name)) warn_once(warnings, fmt::format("the extension {:.80} is ignored", name));
}

/// Checks members that depend on each other.
void check_relations(const Json& checked, const std::string& file, std::vector<std::string>& warnings) {
    const auto each = [&](const char* array, const auto& check) {
        const Json::json_pointer at(array);
        if (!checked.contains(at)) return;
        for (std::size_t i = 0; i < checked.at(at).size(); ++i)
            check(checked.at(at)[i], fmt::format("{}/{}", array, i));
    };
    each("/bufferViews", [&](const Json& view, const std::string& pointer) {
        const std::int64_t stride = view.value("byteStride", std::int64_t{4});
        if (stride % 4 != 0) refuse_input(file, pointer + "/byteStride", fmt::format("{}", stride), "a multiple of 4");
    });
    each("/nodes", [&](const Json& node, const std::string& pointer) {
        if (!node.contains("rotation")) return;
        double square = 0.0;
        for (const Json& x : node["rotation"]) square += x.get<double>() * x.get<double>();
        if (!(square > 1e-6)) refuse_input(file, pointer + "/rotation", "a zero quaternion", "a unit quaternion");
    });
    each("/skins", [&](const Json& skin, const std::string& pointer) {
        // Vertices name joints with 16 bits.
        constexpr std::size_t kMaximumJoints = std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;
        if (const std::size_t count = skin["joints"].size(); count == 0 || count > kMaximumJoints)
            refuse_input(file, pointer + "/joints", fmt::format("{} joints", count),
                         fmt::format("1 to {}", kMaximumJoints));
    });
    each("/cameras", [&](const Json& camera, const std::string& pointer) {
        if (camera["type"] != "perspective") return warn_once(warnings, "orthographic cameras are ignored");
        if (!camera.contains("perspective")) refuse_input(file, pointer + "/perspective", "nothing", "an object");
        const Json& lens = camera["perspective"];
        // Compared as floats, since the import rounds both.
        const auto near = lens["znear"].get<float>();
        if (lens.contains("zfar") && !(lens["zfar"].get<float>() > near))
            refuse_input(file, pointer + "/perspective/zfar", fmt::format("{}", lens["zfar"].get<double>()),
                         fmt::format("more than znear, {}", near));
    });
    each("/extensions/KHR_lights_punctual/lights", [&](const Json& light, const std::string& pointer) {
        if (light["type"] != "spot") return;
        if (!light.contains("spot")) refuse_input(file, pointer + "/spot", "nothing", "an object");
        const Json& cones = light["spot"];
        const auto inner = static_cast<float>(cones.value("innerConeAngle", 0.0));
        const auto outer = static_cast<float>(cones.value("outerConeAngle", std::numbers::pi / 4.0));
        if (!(outer > inner))
            refuse_input(file, pointer + "/spot/outerConeAngle", fmt::format("{}", outer),
                         fmt::format("more than the inner angle, {}", inner));
    });
    each("/animations", [&](const Json& animation, const std::string&) {
        for (const Json& channel : animation["channels"])
            if (const auto path = channel["target"]["path"].get<std::string>();
                path != "translation" && path != "rotation" && path != "scale")
                warn_once(warnings, fmt::format("animation of {:.40} is ignored", path));
    });
}

}  // namespace

std::map<std::string, std::function<nlohmann::ordered_json()>> own_extension_schemas() {
    const auto schema = [](const char* name, std::span<const Member> members) {
        return json_schema(name, [members, name](JsonReader& reader) {
            const Json nothing = Json::object();
            MemoryBudget budget(name);
            Check(nothing, budget).object(reader, nothing, members, nothing);
            Check::finish(reader);
        });
    };
    return {{kProbeExtension, [schema] { return schema(kProbeExtension, kNodeProbe); }},
            {kWearExtension, [schema] { return schema(kWearExtension, kWear); }}};
}

void warn_once(std::vector<std::string>& warnings, std::string text) {
    if (std::ranges::find(warnings, text) == warnings.end()) warnings.push_back(std::move(text));
}

nlohmann::json check_gltf(const nlohmann::json& root, const std::string& file,
                          std::span<const std::string> handled_extensions, MemoryBudget& budget,
                          std::vector<std::string>& warnings) {
    JsonReader reader(root, file);
    check_gltf_version(reader.object("asset"));
    check_extensions(reader, handled_extensions, warnings);
    Json checked = Check(root, budget).object(reader, root, kRoot, root);
    check_relations(checked, file, warnings);
    return checked;
}

}  // namespace rowland::scene
