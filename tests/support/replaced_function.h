#pragma once

#include <epoxy/gl.h>

#include <string>
#include <type_traits>
#include <utility>

#include "engine/core/check.h"
#include "tests/support/environment.h"

namespace rowland::test {

/// While it lives, the program calls another function in the driver's stead. `Pointer`: where libepoxy keeps the
/// function, as &epoxy_glFinish. One at a time for each function.
template <auto Pointer>
class ReplacedFunction {
 public:
    using Function = std::remove_reference_t<decltype(*Pointer)>;

    /// `name`: the function's, as "glFinish". A context is current.
    ReplacedFunction(const char* name, Function replacement) {
        driver = reinterpret_cast<Function>(driver_function(name));
        ROWLAND_CHECK(driver != nullptr, "a driver of OpenGL 4.5");
        before_ = std::exchange(*Pointer, replacement);
    }
    ~ReplacedFunction() { *Pointer = before_; }
    ReplacedFunction(const ReplacedFunction&) = delete;
    ReplacedFunction& operator=(const ReplacedFunction&) = delete;

    /// The driver's own.
    static inline Function driver = nullptr;

 private:
    Function before_ = nullptr;
};

/// The text that a call of glShaderSource gives.
inline std::string whole_source(GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    std::string whole;
    for (GLsizei i = 0; i < count; ++i) {
        const bool has_length = lengths != nullptr && lengths[i] >= 0;
        whole += has_length ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : std::string(texts[i]);
    }
    return whole;
}

}  // namespace rowland::test
