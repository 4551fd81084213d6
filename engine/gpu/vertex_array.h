#pragma once

#include <initializer_list>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/handle.h"

namespace rowland::gpu {

enum class VertexNumber {
    Float,
    UInt16,  ///< an integer in GLSL too: uvec4 and the like
};

/// One attribute of a vertex: `layout(location = location)` in GLSL.
struct VertexAttribute {
    unsigned location = 0;
    int components = 3;   ///< 1 to 4
    unsigned offset = 0;  ///< bytes from the start of the vertex
    VertexNumber number = VertexNumber::Float;
};

/// How vertices are read from buffers. The buffers must outlive it.
class VertexArray {
 public:
    /// With nothing attached it draws vertices made from gl_VertexID alone.
    VertexArray();

    /// Reads the attributes from `buffer`, one vertex every `stride` bytes; per instance if `per_instance`.
    void attach(const Buffer& buffer, int stride, std::initializer_list<VertexAttribute> attributes,
                bool per_instance = false);
    /// 32-bit indices.
    void attach_indices(const Buffer& buffer);

    /// Triangles from `count` vertices.
    void draw(int count, int instances = 1) const;
    /// Triangles from `count` indices, the first of them at `first`.
    void draw_indexed(int count, int first = 0, int instances = 1) const;

    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    Handle<Release> handle_;
    unsigned bindings_ = 0;
    std::size_t indices_ = 0;
};

}  // namespace rowland::gpu
