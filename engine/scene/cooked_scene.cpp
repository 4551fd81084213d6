#include "engine/scene/cooked_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/scene/gltf_import.h"

namespace rowland::scene {

namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t kLayoutVersion = 1;
constexpr std::uint64_t kMaximumFileBytes = std::uint64_t{1} << 30;
constexpr std::uint32_t kGlbMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// A glTF file of which load_gltf() has accepted all but the extensions' contents.
struct GltfParts {
    nlohmann::json json;
    Bytes binary;
    bool is_glb = false;
};

GltfParts split(std::span<const std::byte> bytes, const std::string& file) {
    GltfParts parts;
    ByteReader reader(bytes, file);
    std::span<const std::byte> text = bytes;
    if (bytes.size() >= sizeof kGlbMagic && std::memcmp(bytes.data(), &kGlbMagic, sizeof kGlbMagic) == 0) {
        parts.is_glb = true;
        reader.take(3 * sizeof(std::uint32_t));
        const auto chunk = [&] {
            const auto size = reader.value<std::uint32_t>();
            const auto type = reader.value<std::uint32_t>();
            return std::pair(type, reader.take(size));
        };
        text = chunk().second;
        if (reader.remaining() >= 2 * sizeof(std::uint32_t))
            if (const auto [type, data] = chunk(); type == kBinaryChunk) parts.binary.assign(data.begin(), data.end());
    }
    parts.json = parse_json({reinterpret_cast<const char*>(text.data()), text.size()}, file);
    return parts;
}

std::string percent_decoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const char* const digits = uri.data() + i + 1;
        const bool escaped =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        text += escaped ? static_cast<char>(code) : uri[i];
        if (escaped) i += 2;
    }
    return text;
}

/// The bytes of the file that an object's "uri" names, and removes that member; nullopt: it names none.
std::optional<Bytes> take_named_file(cook::Context& context, nlohmann::json& object) {
    const auto uri = object.find("uri");
    if (uri == object.end() || uri->get_ref<const std::string&>().starts_with("data:")) return std::nullopt;
    Bytes bytes = context.read(context.source().parent_path() /
                                   std::filesystem::path(percent_decoded(uri->get<std::string>())).lexically_normal(),
                               kMaximumFileBytes);
    object.erase(uri);
    return bytes;
}

void pad(Bytes& bytes, std::byte with) {
    while (bytes.size() % 4 != 0) bytes.push_back(with);
}

/// Where a buffer of the source is in the packed file.
struct PackedBuffer {
    std::size_t buffer;
    std::size_t offset;
};

/// Makes the binary chunk the first buffer and moves into it what buffers and images name. Embedded base64 stays.
void embed_files(cook::Context& context, GltfParts& parts) {
    Bytes chunk;
    const auto append = [&](const Bytes& bytes) {
        pad(chunk, std::byte{0});
        const std::size_t offset = chunk.size();
        chunk.insert(chunk.end(), bytes.begin(), bytes.end());
        return offset;
    };
    nlohmann::json buffers = nlohmann::json::array({nlohmann::json::object()});
    std::vector<PackedBuffer> packed;
    for (nlohmann::json& buffer : parts.json["buffers"]) {
        if (const auto bytes = take_named_file(context, buffer)) {
            packed.push_back({0, append(*bytes)});
        } else if (packed.empty() && !buffer.contains("uri")) {
            packed.push_back({0, append(parts.binary)});
        } else {
            packed.push_back({buffers.size(), 0});
            buffers.push_back(std::move(buffer));
        }
    }
    nlohmann::json views = nlohmann::json::array();
    for (nlohmann::json& view : parts.json["bufferViews"]) {
        const PackedBuffer& at = packed.at(view.at("buffer").get<std::size_t>());
        view["buffer"] = at.buffer;
        view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + at.offset;
        views.push_back(std::move(view));
    }
    for (nlohmann::json& image : parts.json["images"]) {
        const auto bytes = take_named_file(context, image);
        if (!bytes) continue;
        const bool png = !bytes->empty() && bytes->front() == std::byte{0x89};
        image["mimeType"] = png ? "image/png" : "image/jpeg";
        image["bufferView"] = views.size();
        views.push_back({{"buffer", 0}, {"byteOffset", append(*bytes)}, {"byteLength", bytes->size()}});
    }
    if (chunk.empty() && buffers.size() > 1) chunk.resize(4);  // the others keep their numbers
    buffers[0]["byteLength"] = chunk.size();
    parts.binary = std::move(chunk);
    parts.json["buffers"] = std::move(buffers);
    parts.json["bufferViews"] = std::move(views);
    for (const char* key : {"buffers", "bufferViews", "images"})  // glTF has no empty arrays
        if (parts.json[key].empty() || (std::string_view(key) == "buffers" && parts.binary.empty()))
            parts.json.erase(key);
}

/// The source as one GLB; as it is, if it is one that names no files.
Bytes packed_glb(cook::Context& context) {
    Bytes source = context.read(context.source(), kMaximumFileBytes);
    GltfParts parts = split(source, context.source().string());
    const auto names_file = [&](const char* key) {
        const nlohmann::json& array = parts.json.value(key, nlohmann::json::array());
        return std::ranges::any_of(array, [](const nlohmann::json& element) {
            return element.contains("uri") && !element["uri"].get_ref<const std::string&>().starts_with("data:");
        });
    };
    if (parts.is_glb && !names_file("buffers") && !names_file("images")) return source;
    embed_files(context, parts);
    const std::string text = parts.json.dump();
    Bytes json(text.size());
    std::memcpy(json.data(), text.data(), text.size());
    pad(json, std::byte{' '});
    pad(parts.binary, std::byte{0});
    ByteWriter writer;
    const std::size_t chunks = parts.binary.empty() ? 1 : 2;
    const std::size_t size = 12 + 8 * chunks + json.size() + parts.binary.size();
    for (const std::size_t value : {std::size_t{kGlbMagic}, std::size_t{2}, size})
        writer.value(static_cast<std::uint32_t>(value));
    const auto write_chunk = [&](std::uint32_t type, const Bytes& bytes) {
        writer.value(static_cast<std::uint32_t>(bytes.size()));
        writer.value(type);
        for (const std::byte byte : bytes) writer.value(static_cast<std::uint8_t>(byte));
    };
    write_chunk(kJsonChunk, json);
    if (!parts.binary.empty()) write_chunk(kBinaryChunk, parts.binary);
    return writer.take();
}

/// The tables of a scene's extensions, each stored once.
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

/// Calls `visit` for each extension of a material that is registered.
template <typename Visit>
void for_each_extension(const ImportedScene& scene, std::span<const cook::GltfExtension> extensions,
                        const Visit& visit) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        for (const cook::GltfExtension& extension : extensions)
            if (const auto found = scene.materials[i].extensions.find(extension.name);
                found != scene.materials[i].extensions.end())
                visit(i, extension, found->second);
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
                               Bytes table = extension.cook(context, {object, pointer, scene, material});
                               const auto same = std::ranges::find(cooked.tables, table);
                               cooked.uses.push_back(
                                   {material, extension.name, static_cast<std::size_t>(same - cooked.tables.begin())});
                               if (same == cooked.tables.end()) cooked.tables.push_back(std::move(table));
                           }
                           progress.advance();
                       });
    return cooked;
}

Bytes write_payload(const Bytes& glb, const SceneTables& cooked) {
    ByteWriter writer;
    writer.array(std::span<const std::byte>(glb));
    writer.value(static_cast<std::uint32_t>(cooked.tables.size()));
    for (const Bytes& table : cooked.tables) writer.array(std::span<const std::byte>(table));
    writer.value(static_cast<std::uint32_t>(cooked.uses.size()));
    for (const SceneTables::Use& use : cooked.uses) {
        writer.value(static_cast<std::uint32_t>(use.material));
        writer.text(use.extension);
        writer.value(static_cast<std::uint32_t>(use.table));
    }
    return writer.take();
}

/// As the engine loads it; refuses an extension that its module refuses.
ImportedScene load_source(cook::Context& context, std::span<const cook::GltfExtension> extensions,
                          std::span<const std::string> names) {
    std::vector<std::filesystem::path> files;
    ImportedScene scene = load_gltf(context.source(), names, &files);
    for (const std::filesystem::path& file : files) context.depend_on(file);
    for_each_extension(scene, extensions,
                       [&](std::size_t material, const cook::GltfExtension& extension, const nlohmann::json& object) {
                           extension.describe(object, context.source().string(), pointer_of(material, extension.name));
                       });
    return scene;
}

std::string describe_scene(const ImportedScene& scene, const std::string& file,
                           std::span<const cook::GltfExtension> extensions) {
    const Mesh merged = merge_instances(scene);
    const Bounds box = bounds(merged);
    std::string text = fmt::format(
        "format: glTF 2.0\nvertices: {}\ntriangles: {}\nminimum: {} {} {}\nmaximum: {} {} {}\nnodes: {}\nmeshes: {}\n"
        "materials: {}\ntextures: {}\nskins: {}\nanimations: {}\nlights: {}\n",
        merged.positions.size(), merged.indices.size() / 3, box.minimum.x, box.minimum.y, box.minimum.z, box.maximum.x,
        box.maximum.y, box.maximum.z, scene.nodes.size(), scene.meshes.size(), scene.materials.size(),
        scene.textures.size(), scene.skins.size(), scene.animations.size(), scene.lights.size());
    for_each_extension(
        scene, extensions, [&](std::size_t i, const cook::GltfExtension& extension, const nlohmann::json& object) {
            const std::string pointer = pointer_of(i, extension.name);
            text += fmt::format("\nmaterial: {} \"{}\"\nextension: {}\n", i, scene.materials[i].name, extension.name);
            const auto tables = scene.materials[i].tables.find(extension.name);
            if (tables ==
                scene.materials[i].tables.end())  // only a source has the files that an object names beside it
                text += fmt::format("object: {}\n", extension.describe(object, file, pointer));
            else
                text += fmt::format("bytes: {}\n{}", tables->second->size(),
                                    extension.describe_tables(*tables->second, file + ": " + pointer));
        });
    return text;
}

}  // namespace

ImportedScene read_cooked_scene(std::span<const std::byte> payload, const std::string& file,
                                std::span<const std::string> handled_extensions) {
    ByteReader reader(payload, file);
    const auto glb_size = reader.value<std::uint64_t>();
    ImportedScene scene = load_glb(reader.take(glb_size), file, handled_extensions);
    std::vector<std::shared_ptr<const Bytes>> tables;
    const auto count = reader.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i)
        tables.push_back(std::make_shared<const Bytes>(reader.array<std::byte>()));
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
        std::string extension = source.extension().string();
        for (char& c : extension)
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        return extension == ".gltf" || extension == ".glb";
    };
    type.cook = [extensions, names](cook::Context& context) {
        const ImportedScene scene = load_source(context, extensions, names);
        const Bytes glb = packed_glb(context);
        return write_payload(glb, cook_tables(context, scene, extensions));
    };
    type.check = [extensions, names](cook::Context& context) {
        merge_instances(load_source(context, extensions, names));
    };
    type.describe = [extensions, names](std::span<const std::byte> payload, const std::string& file) {
        return describe_scene(read_cooked_scene(payload, file, names), file, extensions);
    };
    type.describe_source = [extensions, names](cook::Context& context) {
        return describe_scene(load_source(context, extensions, names), context.source().string(), extensions);
    };
    registry.add(std::move(type));
}

}  // namespace rowland::scene
