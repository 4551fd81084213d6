#include "engine/core/file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/system.h"
#include "engine/core/system_file.h"
#include "engine/core/text.h"

namespace rowland {

std::string Hash128::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

Hasher::Hasher() : state_(XXH3_createState(), [](XXH3_state_s* state) { XXH3_freeState(state); }) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
}

Hasher& Hasher::bytes(std::span<const std::byte> data) {
    XXH3_128bits_update(state_.get(), data.data(), data.size());
    return *this;
}

Hasher& Hasher::text(std::string_view data) {
    const std::uint64_t size = data.size();
    XXH3_128bits_update(state_.get(), &size, sizeof size);
    XXH3_128bits_update(state_.get(), data.data(), data.size());
    return *this;
}

Hash128 Hasher::digest() const {
    const XXH128_hash_t value = XXH3_128bits_digest(state_.get());
    return {value.low64, value.high64};
}

namespace {

/// A regular file that is open for reading, and its size in bytes.
struct SourceFile {
    /// Throws Error (input) for what is no readable file, and for a file larger than `max_bytes`.
    SourceFile(const std::filesystem::path& path, std::uint64_t max_bytes, const std::string& remedy = "")
        : file(OpenFile::for_reading(path)) {
        const std::optional<std::uint64_t> regular = file.regular_size();
        if (!regular) refuse_input(path.string(), "", "not a regular file", "a readable file");
        if (*regular > max_bytes)
            refuse_input(path.string(), "", fmt::format("{} bytes", *regular),
                         fmt::format("at most {} bytes", max_bytes), remedy);
        size = static_cast<std::size_t>(*regular);
    }

    OpenFile file;
    std::size_t size = 0;
};

template <typename Buffer>
Buffer read_whole(const std::filesystem::path& path, std::uint64_t max_bytes, const std::string& remedy = "") {
    const SourceFile source(path, max_bytes, remedy);
    Buffer data(source.size, {});
    data.resize(source.file.read(std::as_writable_bytes(std::span(data))));  // the file may be truncated while we read
    return data;
}

}  // namespace

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

std::filesystem::path temporary_name(const std::filesystem::path& target) {
    std::random_device random;
    return folder_of(target) / fmt::format(".rowland-{:08x}{:08x}", random(), random());
}

void refuse_unreadable(const std::filesystem::path& path, const std::error_code& reason) {
    refuse_input(path.string(), "", fmt::format("cannot be opened: {}", reason.message()), "a readable file");
}

void fail_action(const std::filesystem::path& path, const char* action, const std::error_code& reason) {
    fail_system(path.string(), fmt::format("{} failed: {}", action, reason.message()),
                "check permissions and free space");
}

std::uint64_t memory_limit(const char* name, std::uint64_t least, std::uint64_t most) {
    const std::optional<std::string> value = environment_variable(name);
    std::uint64_t mebibytes = least;
    if (value) {
        const char* const end = value->data() + value->size();
        const auto [read, code] = std::from_chars(value->data(), end, mebibytes);
        if (code != std::errc() || read != end || mebibytes < least || mebibytes > most)
            refuse_input(name, "", fmt::format("\"{:.40}\"", *value),
                         fmt::format("a number of MiB from {} to {}", least, most));
    }
    return mebibytes << 20;
}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes,
                                 const std::string& remedy) {
    return read_whole<std::vector<std::byte>>(path, max_bytes, remedy);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::string>(path, max_bytes);
}

std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::size_t size) {
    std::vector<std::byte> buffer(size);
    buffer.resize(SourceFile(path, std::numeric_limits<std::uint64_t>::max()).file.read(buffer));
    if (buffer.empty()) refuse_input(path.string(), "", "an empty file", "a readable file");
    return buffer;
}

std::optional<Hash128> hash_file(const std::filesystem::path& path) {
    try {
        const SourceFile source(path, kMaximumHashedBytes);
        Hasher hasher;
        std::vector<std::byte> buffer(1 << 20);
        std::uint64_t total = 0;
        while (const std::size_t count = source.file.read(buffer)) {
            hasher.bytes(std::span(buffer).first(count));
            total += count;
            if (total > kMaximumHashedBytes) return std::nullopt;  // it grows while we read
        }
        return hasher.digest();
    } catch (const Error&) {
        return std::nullopt;
    }
}

void create_folder(const std::filesystem::path& path) {
    std::error_code code;
    std::filesystem::create_directories(path, code);
    if (code) fail_action(path, "creating the folder", code);
}

void write_file_atomic(const std::filesystem::path& path, std::span<const std::span<const std::byte>> parts) {
    require_no_device(path);
    if (path.has_parent_path()) create_folder(path.parent_path());
    Replacement replacement(path);
    for (const std::span<const std::byte> part : parts) replacement.write(part);
    replacement.replace_target();
}

void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> data) {
    write_file_atomic(path, std::span(&data, 1));
}

void write_file_atomic(const std::filesystem::path& path, std::string_view text) {
    write_file_atomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

FileLock::FileLock(std::unique_ptr<OpenFile> file) : file_(std::move(file)) {}

FileLock::FileLock(FileLock&& other) noexcept = default;

FileLock::~FileLock() = default;

std::optional<FileLock> FileLock::try_take(const std::filesystem::path& file) {
    auto opened = std::make_unique<OpenFile>(OpenFile::for_appending(file));
    if (!opened->try_lock()) return std::nullopt;
    return FileLock(std::move(opened));
}

void FileLock::append(std::string_view text) {
    file_->write(std::as_bytes(std::span(text.data(), text.size())));
}

void FileLock::cut(std::uint64_t size) {
    file_->cut(size);
}

namespace {

/// Two paths lead to one file exactly if they have a key in common: the path without links, or the identity.
std::vector<std::string> keys_of(const std::filesystem::path& path) {
    std::error_code code;
    const std::filesystem::path canonical =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, code), code);
    std::vector<std::string> keys{code ? path.string() : canonical.string()};
    if (const auto identity = file_identity(path)) keys.push_back(*identity);
    return keys;
}

/// Throws the Error with which write_file_atomic(path, ...) would fail before writing. It tries with a file in the
/// nearest folder that exists, and removes it.
void require_writable(const std::filesystem::path& path) {
    require_no_device(path);
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(path, ignored).parent_path();
    while (!std::filesystem::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
    const Replacement attempt(folder / "file");
}

}  // namespace

void check_outputs(std::span<const std::filesystem::path> inputs, std::span<const Output> outputs) {
    std::map<std::string, std::string> users;  // what uses the file with each key
    for (const std::filesystem::path& input : inputs)
        for (const std::string& key : keys_of(input)) users.emplace(key, "an input");
    for (const auto& [option, path, extension] : outputs) {
        const std::string file = fmt::format("{} {}", option, path.string());
        if (!extension.empty() && lower_case(path.extension().string()) != lower_case(extension))
            refuse_input(file, {}, fmt::format("the extension \"{}\"", path.extension().string()), extension,
                         "name the file by its format");
        const std::vector<std::string> keys = keys_of(path);
        for (const std::string& key : keys)
            if (const auto user = users.find(key); user != users.end())
                refuse_input(file, {}, "the same file as " + user->second, "a file of its own", "name another file");
        for (const std::string& key : keys) users.emplace(key, "the output of " + option);
        try {
            require_writable(path);
        } catch (const Error& error) {
            refuse_input(file, {}, error.info().found, "a file that can be written", "name another file");
        }
    }
}

}  // namespace rowland
