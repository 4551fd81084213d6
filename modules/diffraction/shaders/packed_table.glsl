// The view table of a material: bake/packed_texels.h. The program defines its TABLE_COLUMNS and TABLE_ROWS.
#include "modules/diffraction/shaders/view_lookup.glsl"

TEXTURE_UNIT(8) uniform sampler2DArray packed_table;
// Scale and bias of each layer of the table, one after the other.
STORAGE(5, TableRange, vec4, table_range);

vec2 table_coordinates(vec3 view) { return view_coordinates(view, vec2(TABLE_COLUMNS, TABLE_ROWS)); }

vec4 table_entries(vec2 coordinates, int layer) {
    vec4 stored = textureLod(packed_table, vec3(coordinates, layer), 0.0);
    return stored * STORED_VEC4(table_range, 2 * layer) + STORED_VEC4(table_range, 2 * layer + 1);
}
