// The content of an EditableGltf as bytes and on the disk.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/editable_gltf.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

namespace {

constexpr std::size_t kGlbFileHeader = 12;
constexpr std::size_t kGlbChunkHeader = 8;
constexpr std::size_t kGlbLengthOffset = 8;  // of the header
constexpr std::uint32_t kGlbJson = 0x4E4F534A;
constexpr std::uint32_t kGlbBinary = 0x004E4942;

std::uint32_t read_glb_number(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.subspan(offset, sizeof(value)).data(), sizeof(value));
    return value;
}

void put_glb_number(std::vector<std::byte>& bytes, std::size_t value) {
    const auto number = std::bit_cast<std::array<std::byte, 4>>(static_cast<std::uint32_t>(value));
    bytes.insert(bytes.end(), number.begin(), number.end());
}

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// A chunk's length must be a multiple of 4. A longer text gets spaces, a shorter one loses them, so that removing what
/// was added before gives the first text again.
std::string padded_json(std::string text, std::size_t opened_size) {
    const std::size_t over = text.size() % 4;
    const std::size_t spaces = text.size() - std::min(text.find_last_not_of(' ') + 1, text.size());
    const bool shorten = over == 0 || (text.size() < opened_size && over <= spaces);
    text.resize(shorten ? text.size() - over : text.size() - over + 4, ' ');
    return text;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path());
}

/// Of a file that exists.
Hash128 hash_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> buffer(1 << 20);
    Hasher hasher;
    while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
        hasher.bytes(bytes_of({buffer.data(), static_cast<std::size_t>(file.gcount())}));
    return hasher.digest();
}

}  // namespace

std::span<const std::byte> EditableGltf::binary() const {
    return opened_ ? std::span(*opened_).subspan(binary_begin_, binary_size_) : std::span<const std::byte>();
}

EditableGltf::Parts EditableGltf::parts(std::vector<std::byte>& owned) const {
    if (!is_binary_) return {bytes_of(json_.text())};
    const std::size_t opened_size = read_glb_number(*opened_, kGlbFileHeader);
    const std::string json = padded_json(json_.text(), opened_size);
    const std::span<const std::byte> appended = appended_ ? *appended_ : std::span<const std::byte>();
    const std::size_t padding = appended.empty() ? 0 : (4 - (binary_size_ + appended.size()) % 4) % 4;
    const std::size_t binary_size = binary_size_ + appended.size() + padding;
    const bool has_binary = binary_begin_ > 0 || binary_size > 0;
    // Behind the chunk that was the last one read there may be others, and bytes that the header does not count.
    const std::size_t json_end = kGlbFileHeader + kGlbChunkHeader + opened_size;
    const auto rest = std::span(*opened_).subspan(binary_begin_ > 0 ? binary_begin_ + binary_size_ : json_end);
    const std::size_t uncounted = opened_->size() - read_glb_number(*opened_, kGlbLengthOffset);
    const std::size_t counted = rest.size() - std::min(rest.size(), uncounted);
    const std::size_t total =
        kGlbFileHeader + kGlbChunkHeader + json.size() + (has_binary ? kGlbChunkHeader + binary_size : 0) + counted;
    if (total > std::numeric_limits<std::uint32_t>::max())
        refuse_input(path().string(), "", fmt::format("{} bytes with what was added", total),
                     "at most 4 GiB, the most that a .glb can hold");

    owned.assign(opened_->begin(), opened_->begin() + kGlbLengthOffset);
    put_glb_number(owned, total);
    put_glb_number(owned, json.size());
    put_glb_number(owned, kGlbJson);
    const auto text = bytes_of(json);
    owned.insert(owned.end(), text.begin(), text.end());
    if (has_binary) {
        put_glb_number(owned, binary_size);
        put_glb_number(owned, kGlbBinary);
    }
    const std::size_t before = owned.size();
    owned.resize(before + padding);
    return {std::span(owned).first(before), binary(), appended, std::span(owned).subspan(before), rest};
}

std::vector<std::byte> EditableGltf::bytes() const {
    std::vector<std::byte> owned;
    std::vector<std::byte> all;
    for (const auto part : parts(owned)) all.insert(all.end(), part.begin(), part.end());
    return all;
}

bool EditableGltf::changed_on_disk() const {
    std::error_code none;
    return std::filesystem::exists(path(), none) && hash_of(path()) != on_disk_->hash;
}

void EditableGltf::require_files_beside(const std::filesystem::path& target) const {
    if (folder_of(target) == folder_of(path())) return;
    for (const std::string& file : named_files(OrderedJson::parse(json_.text())))
        if (std::ranges::find(added_files_, file, &AddedFile::name) == added_files_.end())
            refuse_input(target.string(), "",
                         fmt::format("another folder than that of {:.60}, which the glTF names", file),
                         fmt::format("a file in {}", folder_of(path()).string()),
                         "copy the glTF with its files first, or make it a .glb");
}

void EditableGltf::write_added_files(const std::filesystem::path& folder) const {
    for (const AddedFile& added : added_files_) {
        const std::filesystem::path file = folder / added.name;
        if (std::error_code none; !std::filesystem::exists(file, none))
            write_file_atomic(file, *added.bytes);
        else if (read_file(file, MemoryBudget::kDefaultLimit) != *added.bytes)
            refuse_input(file.string(), "", "a file with other content", "none, or the image that was added",
                         "rename it");
    }
}

void EditableGltf::save(const std::filesystem::path& to, IfChanged if_changed) {
    std::error_code none;
    const std::filesystem::path target = std::filesystem::is_symlink(to, none) ? std::filesystem::canonical(to) : to;
    require_files_beside(target);
    if (if_changed == IfChanged::Refuse && std::filesystem::equivalent(target, path(), none) && changed_on_disk())
        fail_system(path().string(), "changed since it was opened", "open it again");
    std::vector<std::byte> owned;
    const Parts all = parts(owned);
    Hasher hasher;
    for (const auto part : all) hasher.bytes(part);
    write_added_files(folder_of(target));
    write_file_atomic(target, std::span<const std::span<const std::byte>>(all));
    *on_disk_ = {to, hasher.digest()};
}

bool operator==(const EditableGltf& a, const EditableGltf& b) {
    return a.opened_ == b.opened_ && a.json_.text() == b.json_.text();
}

}  // namespace rowland::scene
