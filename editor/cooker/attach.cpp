#include "editor/cooker/attach.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numbers>

#include "engine/cook/cook_source.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/core/text.h"
#include "engine/scene/editable_gltf.h"

namespace rowland::editor {

namespace {

using OrderedJson = nlohmann::ordered_json;
using Path = std::filesystem::path;

constexpr std::uint64_t kMostImageBytes = std::uint64_t{256} << 20;

/// Text on one line: control characters as in JSON.
std::string on_one_line(const std::string& text) {
    const std::string quoted = OrderedJson(text).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    return quoted.substr(1, quoted.size() - 2);
}

std::optional<std::size_t> number_after_hash(const std::string& text) {
    std::size_t number = 0;
    const char* const end = text.data() + text.size();
    if (!text.starts_with('#')) return std::nullopt;
    const auto [read, code] = std::from_chars(text.data() + 1, end, number);
    if (code != std::errc() || read != end) return std::nullopt;
    return number;
}

/// The index of the material that the user named.
std::size_t find_material(const std::vector<std::string>& names, const std::string& named, const Path& scene) {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == named) found.push_back(fmt::format("#{}", i));
    const std::optional<std::size_t> number = number_after_hash(found.size() == 1 ? found[0] : named);
    if (number && *number < names.size()) return *number;
    const std::string remedy = fmt::format("see rowland-cook list {}", scene.string());
    if (found.size() > 1)
        refuse_input(scene.string(), "--material", fmt::format("{} materials called \"{}\"", found.size(), named),
                     fmt::format("one of {}", fmt::join(found, ", ")), remedy);
    const auto near = nearest_word(named, names);
    refuse_input(scene.string(), "--material", fmt::format("no material \"{}\"", named),
                 names.empty() ? "a glTF with materials" : fmt::format("one of its {} materials", names.size()),
                 near ? fmt::format("is \"{}\" meant?", *near) : remedy);
}

/// One run of `attach`.
class Attachment {
 public:
    Attachment(const cook::Registry& registry, const AttachOptions& options)
        : registry_(registry),
          options_(options),
          output_(options.output.value_or(options.scene)),
          folder_(output_.parent_path()) {
        check_files();
        gltf_ = scene::EditableGltf::open(options.scene);
        names_ = gltf_->outline().materials;
    }

    void run() {
        move_files();
        for (const std::string& name : options_.removed) {
            const std::size_t material = find_material(names_, name, options_.scene);
            remove_all_but(material, {});
        }
        for (const auto& [name, source] : options_.attached)
            attach(find_material(names_, name, options_.scene), source);
        // Made before anything is written, since it may refuse a name.
        const std::string depfile = options_.depfile ? cook::depfile_text(output_, dependencies_) : std::string();
        gltf_->save(output_);
        if (options_.depfile) write_file_atomic(*options_.depfile, depfile);
    }

 private:
    void check_files() {
        std::error_code none;
        std::vector<Path> inputs;
        for (const auto& [name, source] : options_.attached) inputs.push_back(source);
        if (options_.texture) inputs.push_back(*options_.texture);
        if (!std::filesystem::equivalent(options_.scene, output_, none)) inputs.push_back(options_.scene);
        std::vector<Output> outputs = {{"--output", output_, options_.scene.extension().string()}};
        if (options_.depfile) outputs.push_back({"--depfile", *options_.depfile});
        check_outputs(inputs, outputs);
        dependencies_ = {options_.scene};
    }

    /// Adapts the paths of files that materials name already, when the glTF is written to another folder.
    void move_files() {
        for (std::size_t i = 0; i < names_.size(); ++i)
            for (const cook::GltfExtension& extension : registry_.gltf_extensions()) {
                OrderedJson object = gltf_->material_extension(i, extension.name);
                if (object.is_null() || !extension.move || folder_ == options_.scene.parent_path()) continue;
                extension.move(object, options_.scene.parent_path(), folder_);
                gltf_->set_material_extension(i, extension.name, object);
            }
    }

    /// Removes what attach() sets, but not extensions that describe the material's own surface.
    void remove_all_but(std::size_t material, const std::string& kept) {
        for (const cook::GltfExtension& extension : registry_.gltf_extensions())
            if (extension.from_source && extension.name != kept)
                gltf_->set_material_extension(material, extension.name, nullptr);
    }

    void attach(std::size_t material, const Path& source) {
        const std::string& type = cook::as_refusal_of(
                                      source, [&]() -> const auto& { return registry_.type_of_source(source); })
                                      .name;
        const std::vector<cook::GltfExtension>& extensions = registry_.gltf_extensions();
        const auto extension = std::ranges::find(extensions, type, &cook::GltfExtension::source_type);
        if (extension == extensions.end() || !extension->from_source)
            refuse_input(source.string(), {}, fmt::format("a {} source", type),
                         "one that a glTF material can hold, such as a grating or a film", "see content/materials");
        cook::Context context(source);
        OrderedJson object = cook::as_refusal_of(source, [&] { return extension->from_source(context); });
        dependencies_.insert(dependencies_.end(), context.dependencies().begin(), context.dependencies().end());
        if (options_.rotation_deg && extension->rotation_member.empty())
            refuse_input("--groove-rotation-deg", {}, fmt::format("a {} source", type), "a grating",
                         "leave the option out");
        if (options_.rotation_deg)
            object[extension->rotation_member] = *options_.rotation_deg * std::numbers::pi / 180.0;
        if (options_.texture) object[extension->texture_member] = {{"index", add_texture()}};
        extension->describe(nlohmann::json::parse(object.dump()), source.string(), "");
        if (extension->move) extension->move(object, source.parent_path(), folder_);
        remove_all_but(material, extension->name);  // one module draws a surface
        gltf_->set_material_extension(material, extension->name, object);
    }

    std::size_t add_texture() {
        dependencies_.push_back(*options_.texture);
        return gltf_->add_texture(read_file(*options_.texture, kMostImageBytes),
                                  valid_utf8(options_.texture->stem().string()));
    }

    const cook::Registry& registry_;
    const AttachOptions& options_;
    Path output_;
    Path folder_;
    std::optional<scene::EditableGltf> gltf_;
    std::vector<std::string> names_;
    std::vector<Path> dependencies_;
};

/// The names of the meshes that use a material, each once; none: primitives without one.
std::string users(const scene::GltfOutline& outline, std::optional<std::size_t> material) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < outline.meshes.size(); ++i) {
        const scene::GltfMeshOutline& mesh = outline.meshes[i];
        if (std::ranges::find(mesh.materials, material) != mesh.materials.end())
            names.push_back(mesh.name.empty() ? fmt::format("mesh {}", i) : on_one_line(mesh.name));
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void attach(const cook::Registry& registry, const AttachOptions& options) {
    if (options.attached.empty() && options.removed.empty())
        refuse_input("--material, --remove", {}, "neither", "at least one of them", "see rowland-cook attach --help");
    if ((options.rotation_deg || options.texture) && options.attached.size() != 1)
        refuse_input("--groove-rotation-deg, --groove-texture, --thickness-texture", {},
                     fmt::format("{} materials", options.attached.size()), "one --material",
                     "call attach once for each material");
    cook::as_refusal_of(options.scene, [&] { Attachment(registry, options).run(); });
}

int list_materials(const cook::Registry& registry, const Path& scene) {
    const auto gltf = cook::as_refusal_of(scene, [&] { return scene::EditableGltf::open(scene); });
    const scene::GltfOutline& outline = gltf.outline();
    bool refused = false;
    fmt::print("material\tname\tattached\tmeshes\n");
    for (std::size_t i = 0; i < outline.materials.size(); ++i) {
        std::string attached = "none";
        for (const cook::GltfExtension& extension : registry.gltf_extensions()) {
            const OrderedJson object = gltf.material_extension(i, extension.name);
            if (object.is_null()) continue;
            try {
                std::string text = extension.describe(nlohmann::json::parse(object.dump()), scene.string(),
                                                      fmt::format("/materials/{}/extensions/{}", i, extension.name));
                if (extension.from_source || attached == "none") attached = std::move(text);
            } catch (const Error& error) {
                log_error("{}", error.what());
                attached = "refused";
                refused = true;
            }
        }
        fmt::print("#{}\t{}\t{}\t{}\n", i, on_one_line(outline.materials[i]), attached, users(outline, i));
    }
    if (const std::string bare = users(outline, std::nullopt); !bare.empty()) fmt::print("none\t\tnone\t{}\n", bare);
    return refused ? 2 : 0;
}

}  // namespace rowland::editor
