#include "engine/scene/editable_gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/image/byte_image.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

namespace {

using OrderedJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::array<std::pair<const char*, std::size_t>, 4> kTransformParts = {
    {{"translation", 3}, {"rotation", 4}, {"scale", 3}, {"matrix", 16}}};

/// The file as an outline; also checks the types of all that EditableGltf edits. Throws Error (input).
GltfOutline read_outline(const nlohmann::json& gltf, const std::string& file) {
    JsonReader root(gltf, file);
    check_gltf_version(root.object("asset"));
    GltfOutline outline;
    for (JsonReader& material : root.objects_if_there("materials")) {
        outline.materials.push_back(material.text_or("name", ""));
        material.object_if_there("extensions");
    }
    const auto last_material = static_cast<std::int64_t>(outline.materials.size()) - 1;
    for (JsonReader& mesh : root.objects_if_there("meshes")) {
        GltfMeshOutline& to = outline.meshes.emplace_back(GltfMeshOutline{mesh.text_or("name", ""), {}});
        for (JsonReader& primitive : mesh.objects("primitives")) {
            std::optional<std::size_t>& material = to.materials.emplace_back();
            if (primitive.has("material"))
                material = static_cast<std::size_t>(primitive.integer("material", 0, last_material));
        }
    }
    for (JsonReader& node : root.objects_if_there("nodes")) {
        node.text_or("name", "");
        node.object_if_there("extensions");
        for (const auto& [key, size] : kTransformParts)
            if (node.has(key)) node.numbers(key, size, {});
    }
    std::int64_t last_scene = -1;
    for (JsonReader& scene : root.objects_if_there("scenes")) {
        ++last_scene;
        if (scene.has("nodes") && !scene.raw("nodes").is_array())
            scene.fail("nodes", scene.raw("nodes").type_name(), "an array of indices");
    }
    root.integer_or("scene", 0, 0, std::max<std::int64_t>(last_scene, 0));
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        if (!root.has(key)) continue;
        const nlohmann::json& names = root.raw(key);
        if (!names.is_array() || !std::ranges::all_of(names, [](const auto& name) { return name.is_string(); }))
            root.fail(key, names.is_array() ? "an element of another type" : names.type_name(), "an array of names");
    }
    for (const char* array : {"buffers", "bufferViews", "images", "samplers", "textures"})
        for (JsonReader& object : root.objects_if_there(array)) {
            object.text_or("uri", "");
            for (const char* number : {"buffer", "bufferView", "byteLength", "byteOffset", "sampler", "source"})
                object.integer_or(number, 0, 0, std::int64_t{1} << 32);
        }
    return outline;
}

/// The numbers of an array member as a vector; `fallback` if it is missing.
template <typename Vector>
Vector vector_or(const OrderedJson& object, const char* key, Vector fallback) {
    if (!object.contains(key)) return fallback;
    for (int i = 0; i < Vector::length(); ++i) fallback[i] = object[key][static_cast<std::size_t>(i)].get<double>();
    return fallback;
}

OrderedJson array_of(const auto& vector) {
    OrderedJson array = OrderedJson::array();
    for (int i = 0; i < vector.length(); ++i) array.push_back(vector[i]);
    return array;
}

ExtendedNode extended_node(const OrderedJson& json, std::size_t index, const std::string& extension) {
    ExtendedNode node{.index = index, .name = json.value("name", ""), .extension = json["extensions"][extension]};
    if (json.contains("matrix")) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = json["matrix"][static_cast<std::size_t>(i)].get<double>();
        const Transform parts = decompose(matrix).transform;
        node.translation = glm::dvec3(matrix[3]);
        node.rotation = glm::dquat(parts.rotation);
        node.scale = parts.scale;
    } else {
        node.translation = vector_or(json, "translation", node.translation);
        const glm::dvec4 rotation = vector_or(json, "rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0));
        node.rotation = {rotation.w, rotation.x, rotation.y, rotation.z};
        node.scale = vector_or(json, "scale", node.scale);
    }
    return node;
}

/// Adds the names of the extensions in a JSON value: the keys of all "extensions" below it, but for those in "extras".
void collect_extensions(const OrderedJson& value, std::set<std::string>& names) {
    if (!value.is_structured()) return;
    for (const auto& [key, member] : value.items()) {
        if (value.is_object() && key == "extras") continue;
        if (value.is_object() && key == "extensions" && member.is_object())
            for (const auto& [name, ignored] : member.items()) names.insert(name);
        collect_extensions(member, names);
    }
}

/// Makes `old` equal to `now`; members of objects that both have keep their position.
void assign_members(OrderedJson& old, const OrderedJson& now) {
    if (!old.is_object() || !now.is_object()) {
        old = now;
        return;
    }
    std::vector<std::string> removed;
    for (const auto& [key, ignored] : old.items())
        if (!now.contains(key)) removed.push_back(key);
    for (const std::string& key : removed) old.erase(key);
    for (const auto& [key, value] : now.items()) assign_members(old[key], value);
}

/// Sets the extension of a material or a node, or removes it if `value` is null.
void set_extension(OrderedJson& owner, const std::string& extension, const OrderedJson& value) {
    if (!value.is_null()) {
        assign_members(owner["extensions"][extension], value);
    } else if (owner.contains("extensions")) {
        owner["extensions"].erase(extension);
        if (owner["extensions"].empty()) owner.erase("extensions");
    }
}

/// A file name without what URIs and file systems treat specially.
std::string plain_name(const std::string& name) {
    std::string plain;
    for (const char c : name.substr(0, 100))
        plain += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
    return plain.empty() ? "image" : plain;
}

fs::path folder_of(const fs::path& file) {
    return fs::weakly_canonical(fs::absolute(file).parent_path());
}

}  // namespace

std::size_t GltfOutline::uses(std::size_t material) const {
    std::size_t count = 0;
    for (const GltfMeshOutline& mesh : meshes)
        count += static_cast<std::size_t>(std::ranges::count(mesh.materials, std::optional(material)));
    return count;
}

EditableGltf EditableGltf::open(const fs::path& path) {
    return {read_file(path, MemoryBudget::scene_limit(), MemoryBudget::kRemedy), path};
}

EditableGltf::EditableGltf(std::vector<std::byte> bytes, fs::path path)
    : on_disk_(std::make_shared<OnDisk>(std::move(path), Hasher().bytes(bytes).digest())) {
    GltfSource source = split_gltf(std::move(bytes), on_disk_->path.string(), std::nullopt);
    outline_ = read_outline(source.json, source.file);
    const std::string_view text(reinterpret_cast<const char*>(source.json_text().data()), source.json_text().size());
    json_ = std::make_shared<OrderedJson>(OrderedJson::parse(text));
    in_lines_ = text.find('\n') != std::string_view::npos;
    source.json = nullptr;
    opened_ = std::make_shared<const GltfSource>(std::move(source));
}

OrderedJson& EditableGltf::edit() {
    if (json_.use_count() > 1) json_ = std::make_shared<OrderedJson>(*json_);
    return *json_;
}

const OrderedJson& EditableGltf::array(const char* name) const {
    static const OrderedJson none = OrderedJson::array();
    return json_->contains(name) ? std::as_const(*json_)[name] : none;
}

OrderedJson EditableGltf::material_extension(std::size_t material, const std::string& extension) const {
    const OrderedJson& extensions = array("materials").at(material).value("extensions", OrderedJson());
    return extensions.contains(extension) ? extensions[extension] : OrderedJson();
}

void EditableGltf::set_material_extension(std::size_t material, const std::string& extension,
                                          const OrderedJson& value) {
    ROWLAND_CHECK_OP(material, <, outline_.materials.size());
    const auto names_in = [&](const OrderedJson& member) {
        std::set<std::string> names;
        if (!member.is_null()) names.insert(extension);
        collect_extensions(member, names);
        return names;
    };
    const std::set<std::string> before = names_in(material_extension(material, extension));
    set_extension(edit()["materials"][material], extension, value);
    list_extensions(before, names_in(value));
}

std::vector<ExtendedNode> EditableGltf::nodes_with(const std::string& extension) const {
    std::vector<ExtendedNode> found;
    const OrderedJson& nodes = array("nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].contains("extensions") && nodes[i]["extensions"].contains(extension))
            found.push_back(extended_node(nodes[i], i, extension));
    return found;
}

void EditableGltf::set_nodes_with(const std::string& extension, std::span<const ExtendedNode> nodes) {
    const std::vector<ExtendedNode> before = nodes_with(extension);
    OrderedJson& root = edit();
    for (const ExtendedNode& old : before)
        if (std::ranges::find(nodes, old.index, &ExtendedNode::index) == nodes.end())
            set_extension(root["nodes"][*old.index], extension, nullptr);
    for (const ExtendedNode& node : nodes) {
        const auto old = std::ranges::find(before, node.index, &ExtendedNode::index);
        if (!node.index || old == before.end()) {
            add_node(extension, node);
            continue;
        }
        OrderedJson& owner = root["nodes"][*node.index];
        set_extension(owner, extension, node.extension);
        if (node.translation == old->translation && node.rotation == old->rotation) continue;
        if (owner.erase("matrix") > 0) owner["scale"] = array_of(node.scale);
        owner["translation"] = array_of(node.translation);
        owner["rotation"] = {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
    }
    const auto names = [&](bool any) { return any ? std::set<std::string>{extension} : std::set<std::string>(); };
    list_extensions(names(!before.empty()), names(!nodes.empty()));
}

void EditableGltf::add_node(const std::string& extension, const ExtendedNode& node) {
    OrderedJson& root = edit();
    if (root.contains("scenes") && !root["scenes"].empty())
        root["scenes"][root.value("scene", std::size_t{0})]["nodes"].push_back(array("nodes").size());
    root["nodes"].push_back({{"name", node.name},
                             {"translation", array_of(node.translation)},
                             {"rotation", {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w}},
                             {"extensions", {{extension, node.extension}}}});
}

/// Updates "extensionsUsed" and "extensionsRequired".
void EditableGltf::list_extensions(const std::set<std::string>& before, const std::set<std::string>& now) {
    OrderedJson& root = *json_;
    for (const std::string& name : now)
        if (const OrderedJson& used = array("extensionsUsed"); std::find(used.begin(), used.end(), name) == used.end())
            root["extensionsUsed"].push_back(name);
    if (std::ranges::includes(now, before)) return;
    std::set<std::string> used;
    collect_extensions(root, used);
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (!root.contains(list)) continue;
        OrderedJson left = OrderedJson::array();
        for (const OrderedJson& name : root[list])
            if (!before.contains(name.get<std::string>()) || used.contains(name.get<std::string>()))
                left.push_back(name);
        if (left.empty())
            root.erase(list);
        else
            root[list] = std::move(left);
    }
}

std::size_t EditableGltf::own_material(PrimitiveId primitive) {
    GltfMeshOutline& mesh = outline_.meshes.at(primitive.mesh);
    std::optional<std::size_t>& used = mesh.materials.at(primitive.primitive);
    if (used && outline_.uses(*used) == 1) return *used;
    const std::size_t added = outline_.materials.size();
    OrderedJson& root = edit();
    OrderedJson material = used ? root["materials"][*used] : OrderedJson::object();
    if (used)
        rename_copy(material, outline_.materials[*used]);
    else if (!mesh.name.empty())
        material["name"] = mesh.name;
    outline_.materials.push_back(material.value("name", ""));
    root["materials"].push_back(std::move(material));
    root["meshes"][primitive.mesh]["primitives"][primitive.primitive]["material"] = added;
    used = added;
    return added;
}

/// Names the copy as Blender does: "gold" becomes "gold.001".
void EditableGltf::rename_copy(OrderedJson& copy, const std::string& original) {
    if (original.empty()) return;
    std::string name;
    for (int number = 1; name.empty() || std::ranges::count(outline_.materials, name) > 0; ++number)
        name = fmt::format("{}.{:03}", original, number);
    copy["name"] = name;
}

/// The index of an object in an array of the root, to which it is added if it is missing.
std::size_t EditableGltf::index_of(const char* name, const OrderedJson& object) {
    const OrderedJson& all = array(name);
    const auto index = static_cast<std::size_t>(std::ranges::find(all, object) - all.begin());
    if (index == all.size()) edit()[name].push_back(object);
    return index;
}

std::size_t EditableGltf::add_texture(std::vector<std::byte> image, const std::string& name,
                                      const OrderedJson& sampler) {
    image::byte_image_size(image, name);  // throws what loading it would
    const std::optional<std::size_t> known = find_image(image);
    const std::size_t source = known ? *known : add_image(std::move(image), name);
    OrderedJson texture;
    if (!sampler.is_null()) texture["sampler"] = index_of("samplers", sampler);
    texture["source"] = source;
    return index_of("textures", texture);
}

bool EditableGltf::file_holds(const std::string& uri, std::span<const std::byte> image) const {
    for (const AddedFile& added : added_files_)
        if (added.name == uri) return std::ranges::equal(*added.bytes, image);
    std::error_code none;
    const fs::path file = path().parent_path() / uri;
    return uri == file.filename() && fs::file_size(file, none) == image.size() &&
           std::ranges::equal(read_file(file, image.size()), image);
}

std::optional<std::size_t> EditableGltf::find_image(std::span<const std::byte> image) const {
    const OrderedJson& images = array("images");
    const OrderedJson& views = array("bufferViews");
    // Whether a view into the opened or the appended part of the binary chunk holds the image.
    const auto view_holds = [&](const OrderedJson& view) {
        auto begin = view.value("byteOffset", std::size_t{0});
        const bool in_appended = begin >= opened_->binary_size;
        const std::span<const std::byte> bytes = in_appended ? appended() : opened_->binary();
        if (in_appended) begin -= opened_->binary_size;
        const auto size = view.value("byteLength", std::size_t{0});
        return view.value("buffer", 1) == 0 && begin <= bytes.size() && size <= bytes.size() - begin &&
               std::ranges::equal(bytes.subspan(begin, size), image);
    };
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::size_t view = images[i].value("bufferView", views.size());
        if (images[i].contains("uri") ? file_holds(images[i]["uri"], image)
                                      : view < views.size() && view_holds(views[view]))
            return i;
    }
    return std::nullopt;
}

std::size_t EditableGltf::add_image(std::vector<std::byte> image, const std::string& name) {
    const OrderedJson& buffers = array("buffers");
    // The chunk is the first buffer's, unless that names a file.
    const bool to_binary =
        opened_->is_glb() && (buffers.empty() ? !has_binary() : has_binary() && !buffers[0].contains("uri"));
    OrderedJson entry{{"name", name}, {"mimeType", image::is_jpeg(image) ? "image/jpeg" : "image/png"}};
    if (to_binary)
        entry["bufferView"] = add_to_binary(std::move(image));
    else
        entry["uri"] = add_file(std::move(image), name);
    edit()["images"].push_back(std::move(entry));
    return array("images").size() - 1;
}

std::span<const std::byte> EditableGltf::appended() const {
    return appended_ ? *appended_ : std::span<const std::byte>();
}

bool EditableGltf::has_binary() const {
    return opened_->binary_offset > 0 || appended_;
}

/// Returns the index of the buffer view.
std::size_t EditableGltf::add_to_binary(std::vector<std::byte> image) {
    std::vector<std::byte> added(appended().begin(), appended().end());
    added.resize(padded_chunk(opened_->binary_size + added.size()) - opened_->binary_size);
    const std::size_t offset = opened_->binary_size + added.size();
    added.insert(added.end(), image.begin(), image.end());
    appended_ = std::make_shared<const std::vector<std::byte>>(std::move(added));
    OrderedJson& root = edit();
    root["buffers"][0]["byteLength"] = offset + image.size();
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", image.size()}});
    return root["bufferViews"].size() - 1;
}

/// Returns the file's name.
std::string EditableGltf::add_file(std::vector<std::byte> image, const std::string& name) {
    for (int number = 1;; ++number) {
        std::string file = fmt::format("{}{}{}", plain_name(name), number > 1 ? fmt::format("_{}", number) : "",
                                       image::is_jpeg(image) ? ".jpg" : ".png");
        std::error_code none;
        const bool is_taken = std::ranges::find(added_files_, file, &AddedFile::name) != added_files_.end() ||
                              fs::exists(path().parent_path() / file, none);
        if (is_taken && !file_holds(file, image)) continue;
        added_files_.push_back({file, std::make_shared<const std::vector<std::byte>>(std::move(image))});
        return file;
    }
}

std::vector<std::span<const std::byte>> EditableGltf::parts(std::vector<std::byte>& owned) const {
    const bool in_lines = in_lines_ && !opened_->is_glb();
    std::string json = json_->dump(in_lines ? 2 : -1);
    if (in_lines) json += '\n';
    if (!opened_->is_glb()) {
        const auto text = std::as_bytes(std::span(json));
        owned.assign(text.begin(), text.end());
        return {owned};
    }
    const std::size_t binary_size = opened_->binary_size + appended().size();
    owned = glb_beginning(std::move(json), has_binary() ? std::optional(binary_size) : std::nullopt,
                          opened_->other_chunks().size(), path().string());
    if (!has_binary()) return {owned, opened_->other_chunks()};
    const std::size_t before = owned.size();
    owned.resize(before + padded_chunk(binary_size) - binary_size);
    return {std::span(owned).first(before), opened_->binary(), appended(), std::span(owned).subspan(before),
            opened_->other_chunks()};
}

std::vector<std::byte> EditableGltf::bytes() const {
    std::vector<std::byte> owned;
    std::vector<std::byte> all;
    for (const auto part : parts(owned)) all.insert(all.end(), part.begin(), part.end());
    return all;
}

bool EditableGltf::changed_on_disk() const {
    std::error_code none;
    return fs::exists(path(), none) && hash_file(path()) != on_disk_->hash;
}

void EditableGltf::require_files_beside(const fs::path& target) const {
    if (folder_of(target) == folder_of(path())) return;
    for (const char* name : {"buffers", "images"})
        for (const OrderedJson& object : array(name)) {
            const std::string file = object.value("uri", "data:");
            if (file.starts_with("data:") ||
                std::ranges::find(added_files_, file, &AddedFile::name) != added_files_.end())
                continue;
            refuse_input(target.string(), "",
                         fmt::format("another folder than that of {:.60}, which the glTF names", file),
                         fmt::format("a file in {}", folder_of(path()).string()),
                         "copy the glTF with its files first, or make it a .glb");
        }
}

void EditableGltf::write_added_files(const fs::path& folder) const {
    for (const AddedFile& added : added_files_) {
        const fs::path file = folder / added.name;
        if (std::error_code none; !fs::exists(file, none))
            write_file_atomic(file, *added.bytes);
        else if (read_file(file, MemoryBudget::scene_limit()) != *added.bytes)
            refuse_input(file.string(), "", "a file with other content", "none, or the image that was added",
                         "rename it");
    }
}

void EditableGltf::save(const fs::path& to, IfChanged if_changed) {
    std::error_code none;
    const fs::path target = fs::is_symlink(to, none) ? fs::canonical(to) : to;
    require_files_beside(target);
    if (if_changed == IfChanged::Refuse && fs::equivalent(target, path(), none) && changed_on_disk())
        fail_system(path().string(), "changed since it was opened", "open it again");
    std::vector<std::byte> owned;
    const std::vector<std::span<const std::byte>> all = parts(owned);
    Hasher hasher;
    for (const auto part : all) hasher.bytes(part);
    write_added_files(folder_of(target));
    write_file_atomic(target, std::span<const std::span<const std::byte>>(all));
    *on_disk_ = {to, hasher.digest()};
}

bool operator==(const EditableGltf& a, const EditableGltf& b) {
    return a.opened_ == b.opened_ && (a.json_ == b.json_ || *a.json_ == *b.json_);
}

}  // namespace rowland::scene
