#include "tests/unit/engine/cook/tile_type.h"

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "engine/core/parallel.h"

namespace rowland::test {

namespace {

constexpr std::uint64_t kMaximumBytes = 1 << 20;

std::string read_text(cook::Context& context, const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = context.read(path, kMaximumBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& word) {
    throw Error({.file = path.string(), .location = {}, .found = word, .expected = "size, include", .remedy = {}});
}

void hold(const std::filesystem::path& gate) {
    if (!std::filesystem::exists(gate)) return;
    std::ofstream(gate.string() + ".reached") << " ";
    while (std::filesystem::exists(gate)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Everything the source says, its includes in place.
struct Tiles {
    std::string text;
    std::size_t size = 0;
};

Tiles read_tiles(cook::Context& context) {
    Tiles tiles;
    tiles.text = read_text(context, context.source());
    std::istringstream lines(tiles.text);
    std::string word;
    std::string name;
    while (lines >> word) {
        if (word == "size") {
            lines >> tiles.size;
        } else if (word == "include") {
            std::getline(lines >> std::ws, name);
            tiles.text += read_text(context, context.beside_source(name));
        } else if (word == "crash") {
            throw std::runtime_error("library failed");
        } else if (word == "exhaust") {
            throw std::bad_alloc();
        } else if (word == "change") {
            lines >> name;
            std::ofstream(context.beside_source(name), std::ios::app) << " ";
        } else if (word == "hold") {
            lines >> name;
            hold(context.beside_source(name));
        } else {
            refuse(context.source(), word);
        }
    }
    return tiles;
}

std::vector<std::byte> cook_tiles(cook::Context& context) {
    const Tiles tiles = read_tiles(context);
    std::vector<std::byte> payload(tiles.size);
    parallel_for(tiles.size, [&](std::size_t i) {
        payload[i] = static_cast<std::byte>(Hasher().text(tiles.text).text(std::to_string(i)).digest().low);
    });
    return payload;
}

}  // namespace

void register_tile_types(cook::Registry& registry) {
    cook::GltfExtension in_gltf;
    in_gltf.name = "TEST_tiles";
    in_gltf.describe = [](const nlohmann::json& object, const std::string&, const std::string&) {
        return object["text"].get<std::string>();
    };
    in_gltf.source_type = "tiles";
    in_gltf.from_source = [](cook::Context& context) {
        return nlohmann::ordered_json{{"text", read_tiles(context).text}};
    };
    registry.add_gltf_extension(std::move(in_gltf));
    const auto has_extension = [](std::string extension) {
        return [extension = std::move(extension)](const std::filesystem::path& source, const nlohmann::json*) {
            return source.extension() == extension;
        };
    };
    registry.add({.name = "tiles",
                  .version = 2,
                  .extension = ".cooked",
                  .recognises = has_extension(".tiles"),
                  .cook = cook_tiles,
                  .check = [](cook::Context& context) { read_tiles(context); },
                  .describe =
                      [](std::span<const std::byte> payload, const std::string& file) {
                          if (payload.size() == 13) refuse(file, "13 tiles");
                          return "tiles: " + std::to_string(payload.size());
                      }});
    registry.add({.name = "notes",
                  .extension = {},
                  .recognises = has_extension(".notes"),
                  .cook = {},
                  .check = [](cook::Context&) {},
                  .describe = {}});
    registry.add({.name = "plain",
                  .extension = ".flat",
                  .in_container = false,
                  .recognises =
                      [](const std::filesystem::path& source, const nlohmann::json*) {
                          return source.extension() == ".plain" || source.extension() == ".flat";
                      },
                  .cook = [](cook::Context& context) { return context.read(context.source(), kMaximumBytes); },
                  .check = [](cook::Context&) {},
                  .describe = [](std::span<const std::byte> payload,
                                 const std::string&) { return "letters: " + std::to_string(payload.size()) + "\n"; }});
}

}  // namespace rowland::test
