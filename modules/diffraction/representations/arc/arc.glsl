// The pixel's part of arc_table.h: a sum over the ranks of the products from the vertices. The program defines LAYERS and
// VIEW_MAPPING; PITCH_AXIS for a table over pitches; and TURNS, the light's bands, where the products are a series over
// the azimuth of g.
#include "modules/diffraction/shaders/view_table.glsl"

const int PRODUCTS = 3 * SHOWN_LAYERS;

#ifdef TURNS
// The constant, then cos and sin of each multiple of the azimuth: runtime/vertex_light.h.
STORAGE(4, ArcTurns, vec4, turn_terms);
uniform vec3 arc_e1;  // the azimuth's axes in the world
uniform vec3 arc_e2;

// Grooves that vary within the pixel lessen each term: PHYSICS (11.4).
vec4[PRODUCTS] products_at(vec3 g, float fade) {
    vec2 once = fade * vec2(dot(g, arc_e1), dot(g, arc_e2));
    vec2 turn = vec2(1.0, 0.0);
    vec4 products[PRODUCTS];
    for (int i = 0; i < PRODUCTS; ++i) products[i] = STORED_VEC4(turn_terms, i);
    for (int m = 1; m < TURNS; ++m) {
        turn = vec2(turn.x * once.x - turn.y * once.y, turn.x * once.y + turn.y * once.x);
        int at = (2 * m - 1) * PRODUCTS;
        for (int i = 0; i < PRODUCTS; ++i)
            products[i] += turn.x * STORED_VEC4(turn_terms, at + i) +
                           turn.y * STORED_VEC4(turn_terms, at + PRODUCTS + i);
        once *= fade * fade;
    }
    return products;
}
#else
in vec4 arc_products[PRODUCTS];
vec4[PRODUCTS] products_at(vec3 g, float fade) { return arc_products; }
#endif

#ifdef PITCH_AXIS
uniform vec2 pitch_scale_bias;  // from the logarithm of the pitch factor to the table's second coordinate
#endif

vec3 arc_radiance(GrooveView view) {
#ifdef GROOVE_MAP
    float fade = view.fade;
#else
    const float fade = 1.0;
#endif
    vec2 coordinates = table_coordinates(vec3(fade * view.direction.x, view.direction.yz));
#ifdef PITCH_AXIS
    coordinates.y = log(view.pitch) * pitch_scale_bias.x + pitch_scale_bias.y;
#endif
    vec4 products[PRODUCTS] = products_at(view.axes[0], fade);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < SHOWN_LAYERS; ++j) {
        vec4 weights = table_entries(coordinates, j);
        sum += vec3(dot(weights, products[3 * j]), dot(weights, products[3 * j + 1]),
                    dot(weights, products[3 * j + 2]));
    }
    return sum;
}

#ifndef STREAK
vec3 diffracted_radiance(GrooveView view) { return arc_radiance(view); }
#endif
