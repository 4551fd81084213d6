#pragma once

#include <engine/cook/registry.h>
#include <engine/render/renderer.h>

#include <functional>

/// The arguments SCENE PROBE PICTURE: draws a glTF scene through its first camera under a light probe (.hdr or .exr,
/// equirectangular) and writes it as PNG. `registry` cooks the scene, `register_modules` adds material types. Returns
/// the exit code.
int draw_scene(int argc, char** argv, const rowland::cook::Registry& registry,
               const std::function<void(rowland::render::Renderer&)>& register_modules);
