#include "engine/scene/cook.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/core/byte_stream.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/json_schema.h"
#include "engine/core/log.h"
#include "engine/core/text.h"
#include "engine/scene/glb_write.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/mesh_recipe.h"

namespace rowland::scene {

namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t kLayoutVersion = 2;
constexpr const char* kProbeAssetType = "probe";

/// Removes an object's "uri" if it names a file, and returns the bytes of that file; nullopt if it names none.
std::optional<Bytes> take_named_file(cook::Context& context, const GltfSource& source, nlohmann::json& object) {
    const auto uri = object.find("uri");
    if (uri == object.end() || uri->get_ref<const std::string&>().starts_with("data:")) return std::nullopt;
    Bytes bytes = context.read(file_of_uri(source, uri->get<std::string>(), ""), kMaximumHashedBytes);
    object.erase(uri);
    return bytes;
}

/// Where a buffer of the source is in the packed file.
struct PackedBuffer {
    std::size_t buffer;
    std::size_t offset;
};

/// Makes the binary chunk the first buffer and moves into it the files that buffers and images name; embedded base64
/// stays. Returns the chunk's data.
Bytes embed_files(cook::Context& context, GltfSource& source) {
    Bytes chunk;
    const auto append = [&](std::span<const std::byte> bytes) {
        chunk.resize(padded_chunk(chunk.size()));
        const std::size_t offset = chunk.size();
        chunk.insert(chunk.end(), bytes.begin(), bytes.end());
        return offset;
    };
    nlohmann::json buffers = nlohmann::json::array({nlohmann::json::object()});
    std::vector<PackedBuffer> packed;
    for (nlohmann::json& buffer : source.json["buffers"]) {
        if (const auto bytes = take_named_file(context, source, buffer)) {
            packed.push_back({0, append(*bytes)});
        } else if (packed.empty() && !buffer.contains("uri")) {
            packed.push_back({0, append(source.binary())});
        } else {
            packed.push_back({buffers.size(), 0});
            buffers.push_back(std::move(buffer));
        }
    }
    nlohmann::json views = nlohmann::json::array();
    for (nlohmann::json& view : source.json["bufferViews"]) {
        const PackedBuffer& at = packed.at(view.at("buffer").get<std::size_t>());
        view["buffer"] = at.buffer;
        view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + at.offset;
        views.push_back(std::move(view));
    }
    for (nlohmann::json& image : source.json["images"]) {
        const auto bytes = take_named_file(context, source, image);
        if (!bytes) continue;
        image["mimeType"] = image::is_jpeg(*bytes) ? "image/jpeg" : "image/png";
        image["bufferView"] = views.size();
        views.push_back({{"buffer", 0}, {"byteOffset", append(*bytes)}, {"byteLength", bytes->size()}});
    }
    if (chunk.empty() && buffers.size() > 1) chunk.resize(4);  // keeps buffer 0, so the others' indices hold
    buffers[0]["byteLength"] = chunk.size();
    source.json["buffers"] = std::move(buffers);
    source.json["bufferViews"] = std::move(views);
    for (const char* key : {"buffers", "bufferViews", "images"})  // glTF forbids empty arrays
        if (source.json[key].empty() || (std::string_view(key) == "buffers" && chunk.empty())) source.json.erase(key);
    return chunk;
}

/// The source as one GLB; unchanged if it is a GLB that names no files.
Bytes packed_glb(cook::Context& context, GltfSource source) {
    const auto names_file = [&](const char* key) {
        const nlohmann::json& array = source.json.value(key, nlohmann::json::array());
        return std::ranges::any_of(array, [](const nlohmann::json& element) {
            return element.contains("uri") && !element["uri"].get_ref<const std::string&>().starts_with("data:");
        });
    };
    if (source.is_glb() && !names_file("buffers") && !names_file("images")) return std::move(source.bytes);
    Bytes chunk = embed_files(context, source);
    Bytes glb =
        glb_beginning(source.json.dump(), chunk.empty() ? std::nullopt : std::optional(chunk.size()), 0, source.file);
    chunk.resize(padded_chunk(chunk.size()));
    glb.insert(glb.end(), chunk.begin(), chunk.end());
    return glb;
}

/// The tables of a scene's extensions, equal ones stored once.
struct SceneTables {
    struct Use {
        std::size_t material;
        std::string extension;
        std::size_t table;
    };
    std::vector<Bytes> tables;
    std::vector<Use> uses;
};

std::string pointer_of(std::size_t material, const std::string& extension) {
    return fmt::format("/materials/{}/extensions/{}", material, extension);
}

/// Calls visit(index of the material, extension, its JSON object) for each registered extension of each material.
template <typename Visit>
void for_each_extension(const ImportedScene& scene, std::span<const cook::GltfExtension> extensions,
                        const Visit& visit) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        for (const cook::GltfExtension& extension : extensions)
            if (const auto found = scene.materials[i].extensions.find(extension.name);
                found != scene.materials[i].extensions.end())
                visit(i, extension, found->second);
}

Bytes cook_table(cook::Context& context, const cook::GltfExtension& extension, const cook::SceneExtension& at) {
    if (!extension.part_key) return extension.cook(context, at);
    return cook::cook_part(context, fmt::format("{} {}\n{}", extension.name, extension.version, extension.part_key(at)),
                           [&](cook::Context& part) { return extension.cook(part, at); });
}

SceneTables cook_tables(cook::Context& context, const ImportedScene& scene,
                        std::span<const cook::GltfExtension> extensions) {
    std::size_t count = 0;
    for_each_extension(scene, extensions, [&](std::size_t, const auto&, const auto&) { ++count; });
    Progress progress("cooking " + context.source().filename().string(), count);
    SceneTables cooked;
    for_each_extension(scene, extensions,
                       [&](std::size_t material, const cook::GltfExtension& extension, const nlohmann::json& object) {
                           const std::string pointer = pointer_of(material, extension.name);
                           if (extension.cook) {
                               Bytes table = cook_table(context, extension, {object, pointer, scene, material});
                               const auto same = std::ranges::find(cooked.tables, table);
                               cooked.uses.push_back(
                                   {material, extension.name, static_cast<std::size_t>(same - cooked.tables.begin())});
                               if (same == cooked.tables.end()) cooked.tables.push_back(std::move(table));
                           }
                           progress.advance();
                       });
    return cooked;
}

/// The payloads of a scene's probes, that of each file stored once.
struct SceneProbes {
    struct Use {
        std::size_t probe;
        std::size_t payload;
    };
    std::vector<Bytes> payloads;
    std::vector<Use> uses;
};

void warn_of_missing(const std::vector<std::string>& files, const std::string& scene) {
    constexpr std::size_t kNamed = 3;
    if (files.empty()) return;
    std::string names = fmt::format("{}", fmt::join(std::span(files).first(std::min(files.size(), kNamed)), ", "));
    if (files.size() > kNamed) names += fmt::format(" and {} more", files.size() - kNamed);
    log_warning("{0}: no probe {1}: these boxes have the light around them; capture them: rowland-cook capture {0}",
                scene, names);
}

/// Skips missing files with a warning, so that a scene can be drawn to capture its probes.
SceneProbes read_probes(cook::Context& context, const ImportedScene& scene, const cook::AssetType* type) {
    SceneProbes read;
    std::map<std::filesystem::path, std::size_t> known;
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < scene.probes.size(); ++i) {
        const std::filesystem::path path = context.beside_source(scene.probes[i].file.string());
        auto found = known.find(path);
        if (found == known.end()) {
            context.depend_on(path);
            if (!std::filesystem::exists(path)) {
                missing.push_back(path.string());
                continue;
            }
            asset::CookedAsset cooked = asset::unpack(context.read(path, kMaximumHashedBytes), path.string());
            ROWLAND_CHECK(type != nullptr, "a scene with probes needs the asset type of probes");
            asset::check_type(cooked.header, kProbeAssetType, type->version, path.string());
            type->describe(cooked.payload, path.string());  // throws if the payload is damaged
            found = known.emplace(path, read.payloads.size()).first;
            read.payloads.push_back(std::move(cooked.payload));
        }
        read.uses.push_back({i, found->second});
    }
    warn_of_missing(missing, context.source().string());
    return read;
}

void write_arrays(ByteWriter& writer, const std::vector<Bytes>& arrays) {
    writer.value(static_cast<std::uint32_t>(arrays.size()));
    for (const Bytes& bytes : arrays) writer.array(std::span<const std::byte>(bytes));
}

std::vector<std::shared_ptr<const Bytes>> read_arrays(ByteReader& reader) {
    std::vector<std::shared_ptr<const Bytes>> arrays;
    const auto count = reader.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i)
        arrays.push_back(std::make_shared<const Bytes>(reader.array<std::byte>()));
    return arrays;
}

Bytes write_payload(const Bytes& glb, const SceneTables& cooked, const SceneProbes& probes) {
    ByteWriter writer;
    writer.array(std::span<const std::byte>(glb));
    write_arrays(writer, cooked.tables);
    writer.value(static_cast<std::uint32_t>(cooked.uses.size()));
    for (const SceneTables::Use& use : cooked.uses) {
        writer.value(static_cast<std::uint32_t>(use.material));
        writer.text(use.extension);
        writer.value(static_cast<std::uint32_t>(use.table));
    }
    write_arrays(writer, probes.payloads);
    writer.value(static_cast<std::uint32_t>(probes.uses.size()));
    for (const SceneProbes::Use& use : probes.uses) {
        writer.value(static_cast<std::uint32_t>(use.probe));
        writer.value(static_cast<std::uint32_t>(use.payload));
    }
    return writer.take();
}

GltfSource read_source(cook::Context& context) {
    return split_gltf(context.read(context.source(), MemoryBudget::scene_limit(), MemoryBudget::kRemedy),
                      context.source().string(), context.source().parent_path());
}

/// The scene as the engine loads it. Refuses an extension that its module refuses.
ImportedScene import_source(cook::Context& context, const GltfSource& source,
                            std::span<const cook::GltfExtension> extensions, std::span<const std::string> names) {
    std::vector<std::filesystem::path> files;
    ImportedScene scene = import_gltf(source, names, &files);
    for (const std::filesystem::path& file : files) context.depend_on(file);
    for_each_extension(scene, extensions,
                       [&](std::size_t material, const cook::GltfExtension& extension, const nlohmann::json& object) {
                           extension.describe(object, context.source().string(), pointer_of(material, extension.name));
                       });
    return scene;
}

std::string describe_triangles(const Mesh& mesh) {
    const Bounds box = bounds(mesh);
    return fmt::format("vertices: {}\ntriangles: {}\nminimum: {} {} {}\nmaximum: {} {} {}\n", mesh.positions.size(),
                       mesh.indices.size() / 3, box.minimum.x, box.minimum.y, box.minimum.z, box.maximum.x,
                       box.maximum.y, box.maximum.z);
}

std::string describe_scene(const ImportedScene& scene, const std::string& file,
                           std::span<const cook::GltfExtension> extensions) {
    std::string text = fmt::format(
        "format: glTF 2.0\n{}nodes: {}\nmeshes: {}\nmaterials: {}\ntextures: {}\nskins: {}\nanimations: {}\n"
        "lights: {}\nprobes: {}\n",
        describe_triangles(merge_instances(scene)), scene.nodes.size(), scene.meshes.size(), scene.materials.size(),
        scene.textures.size(), scene.skins.size(), scene.animations.size(), scene.lights.size(), scene.probes.size());
    for (const ImportedProbe& probe : scene.probes)
        text += fmt::format("\nprobe: \"{}\"\nfile: {}\nsize: {} {} {}\nfade: {}\nbytes: {}\n",
                            scene.nodes[probe.node].name, probe.file.string(), probe.size_m.x, probe.size_m.y,
                            probe.size_m.z, probe.fade_m, probe.cooked ? probe.cooked->size() : 0);
    for_each_extension(
        scene, extensions, [&](std::size_t i, const cook::GltfExtension& extension, const nlohmann::json& object) {
            const std::string pointer = pointer_of(i, extension.name);
            text += fmt::format("\nmaterial: {} \"{}\"\nextension: {}\n", i, scene.materials[i].name, extension.name);
            const auto tables = scene.materials[i].tables.find(extension.name);
            // With tables the object is not described: files that it names may be beside the source only.
            if (tables == scene.materials[i].tables.end())
                text += fmt::format("object: {}\n", extension.describe(object, file, pointer));
            else
                text += fmt::format("bytes: {}\n{}", tables->second->size(),
                                    extension.describe_tables(*tables->second, file + ": " + pointer));
        });
    return text;
}

// The type "mesh".

Mesh build_source(cook::Context& context) {
    const nlohmann::json document = context.read_json(context.source());
    return build_mesh(parse_mesh_recipe(document, context.source().string()));
}

std::vector<std::byte> cook_mesh(cook::Context& context) {
    const Mesh mesh = build_source(context);
    return write_glb(mesh, context.source().stem().string());
}

std::string describe_mesh(std::span<const std::byte> payload, const std::string& file) {
    return "format: glTF 2.0 binary, Draco\n" + describe_triangles(merge_instances(load_glb(payload, file)));
}

cook::AssetType mesh_type() {
    cook::AssetType type;
    type.name = "mesh";
    type.version = 5;
    type.extension = ".glb";
    type.in_container = false;
    type.schema = [] { return json_schema("Rowland mesh recipe", [](JsonReader& json) { parse_mesh_recipe(json); }); };
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && is_mesh_recipe(*json);
    };
    type.cook = cook_mesh;
    type.check = [](cook::Context& context) { build_source(context); };
    type.describe = describe_mesh;
    return type;
}

}  // namespace

ImportedScene read_cooked_scene(std::span<const std::byte> payload, const std::string& file,
                                std::span<const std::string> handled_extensions) {
    ByteReader reader(payload, file);
    const auto glb_size = reader.value<std::uint64_t>();
    ImportedScene scene = load_glb(reader.take(glb_size), file, handled_extensions);
    const std::vector<std::shared_ptr<const Bytes>> tables = read_arrays(reader);
    const auto uses = reader.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < uses; ++i) {
        const auto material = reader.value<std::uint32_t>();
        const std::string extension = reader.text();
        const auto table = reader.value<std::uint32_t>();
        if (material >= scene.materials.size() || table >= tables.size())
            reader.fail(fmt::format("table {} of material {}", table, material),
                        fmt::format("{} tables and {} materials", tables.size(), scene.materials.size()));
        scene.materials[material].tables[extension] = tables[table];
    }
    const std::vector<std::shared_ptr<const Bytes>> payloads = read_arrays(reader);
    const auto probes = reader.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < probes; ++i) {
        const auto probe = reader.value<std::uint32_t>();
        const auto which = reader.value<std::uint32_t>();
        if (probe >= scene.probes.size() || which >= payloads.size())
            reader.fail(fmt::format("payload {} of probe {}", which, probe),
                        fmt::format("{} payloads and {} probes", payloads.size(), scene.probes.size()));
        scene.probes[probe].cooked = payloads[which];
    }
    if (reader.remaining() != 0) reader.fail(fmt::format("{} bytes too many", reader.remaining()), "the end");
    return scene;
}

void register_scene_type(cook::Registry& registry) {
    const std::vector<cook::GltfExtension> extensions = registry.gltf_extensions();
    const std::vector<std::string> names = registry.gltf_extension_names();
    cook::AssetType type;
    type.name = kSceneAssetType;
    type.version = kLayoutVersion;
    // Raising the version of any part raises that of the whole.
    for (const cook::GltfExtension& extension : extensions) type.version += extension.version;
    type.extension = ".scene";
    type.recognises = [](const std::filesystem::path& source, const nlohmann::json*) {
        const std::string extension = lower_case(source.extension().string());
        return extension == ".gltf" || extension == ".glb";
    };
    std::optional<cook::AssetType> probe;
    if (const cook::AssetType* known = registry.find(kProbeAssetType)) {
        probe = *known;
        type.version += known->version;
    }
    type.cook = [extensions, names, probe](cook::Context& context) {
        GltfSource source = read_source(context);
        const ImportedScene scene = import_source(context, source, extensions, names);
        const SceneProbes probes = read_probes(context, scene, probe ? &*probe : nullptr);
        const Bytes glb = packed_glb(context, std::move(source));
        return write_payload(glb, cook_tables(context, scene, extensions), probes);
    };
    type.check = [extensions, names](cook::Context& context) {
        merge_instances(import_source(context, read_source(context), extensions, names));
    };
    type.describe = [extensions, names](std::span<const std::byte> payload, const std::string& file) {
        return describe_scene(read_cooked_scene(payload, file, names), file, extensions);
    };
    type.describe_source = [extensions, names](cook::Context& context) {
        return describe_scene(import_source(context, read_source(context), extensions, names),
                              context.source().string(), extensions);
    };
    registry.add(std::move(type));
}

void register_cook_types(cook::Registry& registry) {
    registry.add(mesh_type());
    register_scene_type(registry);
}

}  // namespace rowland::scene
