// The only file that uses tinygltf, and only for the base64 of data URIs. The rest of the library is not used because
// it does not check indices, types and Draco streams of hostile files; our checks would read every member a second
// time.

#include "engine/scene/gltf_buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>  // tinygltf uses it even with TINYGLTF_NO_FS
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/file.h"

// Draco's shared library exports another build of tinygltf under the same names.
#define tinygltf rowland_tinygltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace rowland::scene {

namespace {

constexpr const char* kRemedy = "put it beside the glTF file";

std::string percent_decode(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        text += uri[i];
        if (uri[i] != '%' || i + 2 >= uri.size()) continue;
        const char* const end = uri.data() + i + 3;
        unsigned code = 0;
        if (std::from_chars(uri.data() + i + 1, end, code, 16).ptr != end) continue;
        text.back() = static_cast<char>(code);
        i += 2;
    }
    return text;
}

/// The path of the file that a URI names. Throws if it is not in the glTF's folder or below it: a hostile glTF must not
/// read other files, nor probe for them by the error messages.
std::filesystem::path resolve(const GltfSource& source, const std::string& uri, const std::string& pointer) {
    const std::string expected = "the name of a file in the glTF's folder, or base64 data";
    if (!source.folder)
        refuse_input(source.file, pointer, fmt::format("an external file \"{:.60}\"", uri), "embedded data");
    const std::string name = percent_decode(uri);
    if (name.empty() || name.find('\0') != std::string::npos || name.find(':') != std::string::npos ||
        name.find('\\') != std::string::npos)
        refuse_input(source.file, pointer, fmt::format("URI \"{:.60}\"", uri), expected, kRemedy);
    const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
    if (path.is_absolute() || *path.begin() == "..")
        refuse_input(source.file, pointer, fmt::format("URI \"{:.60}\", outside the glTF's folder", uri), expected,
                     kRemedy);
    return *source.folder / path;
}

std::vector<std::byte> decode_base64(std::string_view base64) {
    // tinygltf decodes data URIs of a few media types only, so the real type is replaced by a known one.
    std::vector<unsigned char> data;
    std::string media_type;
    const std::string known = "data:application/octet-stream;base64," + std::string(base64);
    if (!tinygltf::DecodeDataURI(&data, media_type, known, 0, false)) return {};
    const auto bytes = std::as_bytes(std::span(data));
    return {bytes.begin(), bytes.end()};
}

/// data:<media type>;base64,<data>
GltfBuffer load_data_uri(const GltfSource& source, const std::string& uri, const std::string& pointer,
                         MemoryBudget& budget) {
    budget.spend(uri.size() / 4 + 1, 3, pointer);
    const std::size_t comma = std::min(uri.find(','), uri.size());
    GltfBuffer buffer;
    if (uri.substr(0, comma).ends_with(";base64") && comma < uri.size())
        buffer.owned = decode_base64(std::string_view(uri).substr(comma + 1));
    if (buffer.owned.empty()) refuse_input(source.file, pointer, "a data URI without base64 data", "data:…;base64,…");
    buffer.bytes = buffer.owned;
    return buffer;
}

GltfBuffer load_file(const GltfSource& source, const std::string& uri, const std::string& pointer, MemoryBudget& budget,
                     std::vector<std::filesystem::path>* read_files) {
    const std::filesystem::path path = resolve(source, uri, pointer);
    if (read_files) read_files->push_back(path);
    GltfBuffer buffer;
    try {
        buffer.owned = read_file(path, MemoryBudget::kDefaultLimit);
    } catch (const Error& error) {
        // The message names the glTF, which is the file that the user named.
        ErrorInfo info = error.info();
        info.file = source.file;
        info.location = pointer;
        info.found = fmt::format("{:.200} {}", uri, info.found);
        info.remedy = kRemedy;
        throw Error(std::move(info));
    }
    budget.spend(buffer.owned.size(), 1, pointer);
    buffer.bytes = buffer.owned;
    return buffer;
}

}  // namespace

GltfBuffer load_uri(const GltfSource& source, const std::string& uri, const std::string& pointer, MemoryBudget& budget,
                    std::vector<std::filesystem::path>* read_files) {
    return uri.starts_with("data:") ? load_data_uri(source, uri, pointer, budget)
                                    : load_file(source, uri, pointer, budget, read_files);
}

std::vector<GltfBuffer> load_buffers(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                                     std::vector<std::filesystem::path>* read_files) {
    std::vector<GltfBuffer> buffers;
    const nlohmann::json none = nlohmann::json::array();
    for (const nlohmann::json& entry : source.json.contains("buffers") ? source.json["buffers"] : none) {
        const std::size_t index = buffers.size();
        const std::string pointer = fmt::format("/buffers/{}", index);
        GltfBuffer& buffer = buffers.emplace_back();
        if (entry.contains("uri"))
            buffer = load_uri(source, entry["uri"].get_ref<const std::string&>(), pointer, budget, read_files);
        else if (index == 0)
            buffer.bytes = source.binary();
        const auto length = entry["byteLength"].get<std::size_t>();
        // A buffer without data may stand in the file if nothing uses it.
        if (buffer.bytes.empty() &&
            std::ranges::find(document.views, index, &GltfBufferView::buffer) == document.views.end())
            continue;
        if (buffer.bytes.size() < length)
            refuse_input(source.file, pointer, fmt::format("{} bytes of data", buffer.bytes.size()),
                         fmt::format("the {} bytes of byteLength", length), "the file was cut, or byteLength is wrong");
        buffer.bytes = buffer.bytes.first(length);
    }
    return buffers;
}

}  // namespace rowland::scene
