// Images and textures that are added to an EditableGltf.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "engine/scene/editable_gltf.h"

namespace rowland::scene {

namespace {

bool is_jpeg(std::span<const std::byte> image) {
    return !image.empty() && image[0] == std::byte{0xFF};
}

/// A file name without what URIs and file systems treat specially.
std::string plain_name(const std::string& name) {
    std::string plain;
    for (const char c : name.substr(0, 100))
        plain += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
    return plain.empty() ? "image" : plain;
}

}  // namespace

nlohmann::ordered_json EditableGltf::array_of(const std::string& name) const {
    const auto text = json_.find({name});
    return text ? OrderedJson::parse(*text) : OrderedJson::array();
}

std::size_t EditableGltf::add_texture(std::vector<std::byte> image, const std::string& name,
                                      const OrderedJson& sampler) {
    image::byte_image_size(image, name);  // throws what loading it would
    const std::optional<std::size_t> known = find_image(image);
    const std::size_t source = known ? *known : add_image(std::move(image), name);
    const auto index_of = [&](const char* array, const OrderedJson& object) {
        const OrderedJson all = array_of(array);
        const auto found = std::ranges::find(all, object);
        const auto index = static_cast<std::size_t>(found - all.begin());
        if (found == all.end()) json_.append(array, object);
        return index;
    };
    OrderedJson texture;
    if (!sampler.is_null()) texture["sampler"] = index_of("samplers", sampler);
    texture["source"] = source;
    return index_of("textures", texture);
}

bool EditableGltf::file_holds(const std::string& uri, std::span<const std::byte> image) const {
    for (const AddedFile& added : added_files_)
        if (added.name == uri) return std::ranges::equal(*added.bytes, image);
    std::error_code none;
    const std::filesystem::path file = path().parent_path() / uri;
    return uri == file.filename() && std::filesystem::file_size(file, none) == image.size() &&
           std::ranges::equal(read_file(file, image.size()), image);
}

/// A view of the binary chunk, as opened or as appended; empty for any other view.
std::span<const std::byte> EditableGltf::view_of_binary(const OrderedJson& view) const {
    const auto begin = view.value("byteOffset", std::size_t{0});
    const auto size = view.value("byteLength", std::size_t{0});
    if (!is_binary_ || view.value("buffer", 1) != 0) return {};
    const auto within = [&](std::span<const std::byte> bytes, std::size_t from) {
        return from <= bytes.size() && size <= bytes.size() - from ? bytes.subspan(from, size)
                                                                   : std::span<const std::byte>();
    };
    if (begin < binary_size_) return within(binary(), begin);
    return appended_ ? within(*appended_, begin - binary_size_) : std::span<const std::byte>();
}

std::optional<std::size_t> EditableGltf::find_image(std::span<const std::byte> image) const {
    const OrderedJson images = array_of("images");
    const OrderedJson views = array_of("bufferViews");
    for (std::size_t i = 0; i < images.size(); ++i) {
        const OrderedJson& entry = images[i];
        const std::size_t view = entry.value("bufferView", views.size());
        if (entry.contains("uri") ? file_holds(entry["uri"], image)
                                  : view < views.size() && std::ranges::equal(view_of_binary(views[view]), image))
            return i;
    }
    return std::nullopt;
}

std::size_t EditableGltf::add_image(std::vector<std::byte> image, const std::string& name) {
    const OrderedJson buffers = array_of("buffers");
    // The chunk is the first buffer's, unless that names a file.
    const bool has_chunk = binary_begin_ > 0 || appended_;
    const bool to_binary = is_binary_ && (buffers.empty() ? !has_chunk : has_chunk && !buffers[0].contains("uri"));
    OrderedJson entry{{"name", name}, {"mimeType", is_jpeg(image) ? "image/jpeg" : "image/png"}};
    if (to_binary)
        entry["bufferView"] = add_to_binary(std::move(image));
    else
        entry["uri"] = add_file(std::move(image), name);
    json_.append("images", entry);
    return array_of("images").size() - 1;
}

/// Returns the index of the buffer view.
std::size_t EditableGltf::add_to_binary(std::vector<std::byte> image) {
    std::vector<std::byte> appended = appended_ ? *appended_ : std::vector<std::byte>();
    appended.resize(appended.size() + (4 - (binary_size_ + appended.size()) % 4) % 4);
    const std::size_t offset = binary_size_ + appended.size();
    appended.insert(appended.end(), image.begin(), image.end());
    appended_ = std::make_shared<const std::vector<std::byte>>(std::move(appended));
    json_.append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", image.size()}});
    if (json_.find({"buffers"}))
        json_.set({"buffers", "0", "byteLength"}, offset + image.size());
    else
        json_.append("buffers", {{"byteLength", offset + image.size()}});
    return array_of("bufferViews").size() - 1;
}

/// Returns the file's name.
std::string EditableGltf::add_file(std::vector<std::byte> image, const std::string& name) {
    for (int number = 1;; ++number) {
        const std::string file = fmt::format("{}{}{}", plain_name(name), number > 1 ? fmt::format("_{}", number) : "",
                                             is_jpeg(image) ? ".jpg" : ".png");
        std::error_code none;
        const bool is_taken = std::ranges::find(added_files_, file, &AddedFile::name) != added_files_.end() ||
                              std::filesystem::exists(path().parent_path() / file, none);
        if (is_taken && !file_holds(file, image)) continue;
        added_files_.push_back({file, std::make_shared<const std::vector<std::byte>>(std::move(image))});
        return file;
    }
}

}  // namespace rowland::scene
