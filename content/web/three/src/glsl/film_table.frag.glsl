// The table of a film, which film.frag.glsl and @rowland/babylon read.
#include "engine/gpu/shaders/dialect.glsl"
#include "modules/thin_film/shaders/film_lookup.glsl"
uniform float film_rough;  // 1 if the table is for the material's roughness, whatever the engine adds to it
