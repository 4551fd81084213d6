#include "engine/scene/editable_gltf.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/file.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

EditableGltf EditableGltf::open(const std::filesystem::path& path) {
    return {read_file(path, MemoryBudget::kDefaultLimit), path};
}

EditableGltf::EditableGltf(std::vector<std::byte> bytes, std::filesystem::path path)
    : on_disk_(std::make_shared<OnDisk>(std::move(path), Hasher().bytes(bytes).digest())), json_("{}") {
    GltfSource source = split_gltf(std::move(bytes), on_disk_->path.string(), std::nullopt);
    outline_ = read_outline(source.json, source.file);
    const std::span<const std::byte> json = source.json_text();
    json_ = JsonText({reinterpret_cast<const char*>(json.data()), json.size()});
    is_binary_ = source.is_glb();
    if (!is_binary_) return;
    binary_begin_ = source.binary_offset;
    binary_size_ = source.binary_size;
    opened_ = std::make_shared<const std::vector<std::byte>>(std::move(source.bytes));
}

const std::filesystem::path& EditableGltf::path() const {
    return on_disk_->path;
}

nlohmann::ordered_json EditableGltf::material_extension(std::size_t material, const std::string& extension) const {
    const auto text = json_.find({"materials", std::to_string(material), "extensions", extension});
    return text ? OrderedJson::parse(*text) : OrderedJson();
}

void EditableGltf::set_material_extension(std::size_t material, const std::string& extension,
                                          const OrderedJson& value) {
    ROWLAND_CHECK_OP(material, <, outline_.materials.size());
    const JsonPath extensions{"materials", std::to_string(material), "extensions"};
    const JsonPath at{extensions[0], extensions[1], extensions[2], extension};
    const OrderedJson before = material_extension(material, extension);
    if (value.is_null()) {
        json_.remove(at);
        if (const auto left = json_.find(extensions); left && OrderedJson::parse(*left).empty())
            json_.remove(extensions);
    } else {
        json_.set(at, value);
    }
    const auto owner = [&](const OrderedJson& member) {
        return member.is_null() ? OrderedJson() : OrderedJson{{"extensions", {{extension, member}}}};
    };
    use_extensions(owner(before), owner(value));
}

void EditableGltf::use_extensions(const OrderedJson& before, const OrderedJson& now) {
    const auto listed = [&](const char* array) {
        const auto text = json_.find({array});
        return text ? OrderedJson::parse(*text).get<std::vector<std::string>>() : std::vector<std::string>();
    };
    std::set<std::string> dropped = extensions_in(before);
    for (const std::string& name : extensions_in(now)) {
        dropped.erase(name);
        if (const auto used = listed("extensionsUsed"); std::ranges::find(used, name) == used.end())
            json_.append("extensionsUsed", name);
    }
    if (dropped.empty()) return;
    const std::set<std::string> used = extensions_in(OrderedJson::parse(json_.text()));
    for (const std::string& name : dropped) {
        if (used.contains(name)) continue;
        for (const char* array : {"extensionsUsed", "extensionsRequired"}) {
            const std::vector<std::string> names = listed(array);
            const auto found = std::ranges::find(names, name);
            if (found == names.end()) continue;
            json_.remove(names.size() == 1 ? JsonPath{array} : JsonPath{array, std::to_string(found - names.begin())});
        }
    }
}

std::size_t EditableGltf::own_material(PrimitiveId primitive) {
    GltfMeshOutline& mesh = outline_.meshes.at(primitive.mesh);
    std::optional<std::size_t>& used = mesh.materials.at(primitive.primitive);
    if (used && outline_.uses(*used) == 1) return *used;
    const std::size_t added = outline_.materials.size();
    if (used) {
        json_.append_text("materials", std::string(*json_.find({"materials", std::to_string(*used)})));
        outline_.materials.push_back(outline_.materials[*used]);
        rename_copy(added, *used);
    } else {
        outline_.materials.push_back(mesh.name);
        json_.append("materials", mesh.name.empty() ? OrderedJson::object() : OrderedJson{{"name", mesh.name}});
    }
    used = added;
    json_.set({"meshes", std::to_string(primitive.mesh), "primitives", std::to_string(primitive.primitive), "material"},
              added);
    return added;
}

/// As Blender does: "gold" becomes "gold.001".
void EditableGltf::rename_copy(std::size_t material, std::size_t original) {
    const std::string& first = outline_.materials[original];
    if (first.empty()) return;
    std::string name;
    for (int number = 1; name.empty() || std::ranges::count(outline_.materials, name) > 0; ++number)
        name = fmt::format("{}.{:03}", first, number);
    outline_.materials[material] = name;
    json_.set({"materials", std::to_string(material), "name"}, name);
}

}  // namespace rowland::scene
