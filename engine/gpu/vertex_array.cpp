#include "engine/gpu/vertex_array.h"

#include "engine/core/check.h"
#include "engine/gpu/bound_state.h"

namespace rowland::gpu {

void VertexArray::Release::operator()(GLuint name) const {
    glDeleteVertexArrays(1, &name);
    bound_state().forget(BoundState::Slot::VertexArray, name);
}

VertexArray::VertexArray() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    handle_ = Handle<Release>(name);
}

void VertexArray::attach(const Buffer& buffer, int stride, std::initializer_list<VertexAttribute> attributes) {
    const unsigned binding = bindings_++;
    glVertexArrayVertexBuffer(id(), binding, buffer.id(), 0, stride);
    for (const VertexAttribute& attribute : attributes) {
        glEnableVertexArrayAttrib(id(), attribute.location);
        if (attribute.number == VertexNumber::UInt16) {
            glVertexArrayAttribIFormat(id(), attribute.location, attribute.components, GL_UNSIGNED_SHORT,
                                       attribute.offset);
        } else {
            glVertexArrayAttribFormat(id(), attribute.location, attribute.components, GL_FLOAT, GL_FALSE,
                                      attribute.offset);
        }
        glVertexArrayAttribBinding(id(), attribute.location, binding);
    }
}

void VertexArray::attach_indices(const Buffer& buffer) {
    glVertexArrayElementBuffer(id(), buffer.id());
    indices_ = buffer.size() / sizeof(std::uint32_t);
}

void VertexArray::bind() const {
    if (bound_state().changes(BoundState::Slot::VertexArray, 0, {id()})) glBindVertexArray(id());
}

void VertexArray::draw(int count, int instances) const {
    bind();
    glDrawArraysInstanced(GL_TRIANGLES, 0, count, instances);
}

void VertexArray::draw_indexed(int count) const {
    ROWLAND_CHECK_OP(count, >=, 0);
    ROWLAND_CHECK_OP(static_cast<std::size_t>(count), <=, indices_);
    bind();
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace rowland::gpu
