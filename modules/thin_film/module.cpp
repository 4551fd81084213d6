#include "modules/thin_film/module.h"

#include <memory>

#include "modules/thin_film/runtime/film_surface.h"

namespace rowland::thin_film {

void register_module(render::Renderer& renderer) {
    renderer.add_material_type(std::make_unique<FilmSurfaceType>(renderer.xyz_to_working()));
}

}  // namespace rowland::thin_film
