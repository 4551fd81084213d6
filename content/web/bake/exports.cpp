// Memory and refusals, for every module of the bake.
#include "content/web/bake/exports.h"

#include <cstdlib>
#include <exception>
#include <typeinfo>

#include "engine/core/check.h"

/// Throws in the worker; memory of the call is not released.
extern "C" [[noreturn]] ROWLAND_IMPORT(refused) void worker_refused(const char* message);

namespace rowland::web {

ROWLAND_EXPORT(room) void* room(std::size_t bytes) {
    return std::malloc(bytes);
}

ROWLAND_EXPORT(give_back) void give_back(void* memory) {
    std::free(memory);
}

ROWLAND_EXPORT(numbers_begin) const float* numbers_begin(const Numbers* numbers) {
    return numbers->data();
}

ROWLAND_EXPORT(numbers_count) std::size_t numbers_count(const Numbers* numbers) {
    return numbers->size();
}

ROWLAND_EXPORT(release_numbers) void release_numbers(const Numbers* numbers) {
    delete numbers;
}

}  // namespace rowland::web

namespace rowland {

void check_failed(const char*, int line, std::string_view message) {
    worker_refused(fmt::format("{}: {}", line, message).c_str());
}

}  // namespace rowland

// All exceptions of the engine are Error; nothing in the bake catches them.
extern "C" void* __cxa_allocate_exception(std::size_t bytes) {
    return std::malloc(bytes);
}

extern "C" [[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
    worker_refused(static_cast<const std::exception*>(thrown)->what());
}
