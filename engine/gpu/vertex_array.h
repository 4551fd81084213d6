#pragma once

#include <initializer_list>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/handle.h"

namespace rowland::gpu {

enum class VertexNumber {
    Float,
    UInt16,  ///< an integer in GLSL: uvec4 and so on
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

    /// Reads the attributes from `buffer`, one vertex every `stride` bytes.
    void attach(const Buffer& buffer, int stride, std::initializer_list<VertexAttribute> attributes);
    /// 32-bit indices.
    void attach_indices(const Buffer& buffer);

    /// Triangles from `count` vertices.
    void draw(int count, int instances = 1) const;
    /// Triangles from the first `count` indices.
    void draw_indexed(int count) const;

    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    void bind() const;

    Handle<Release> handle_;
    unsigned bindings_ = 0;
    std::size_t indices_ = 0;
};

}  // namespace rowland::gpu
