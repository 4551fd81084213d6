// Texture coordinates of a tangent-frame view in a table, as bake/view_mapping.h lays views out. VIEW_MAPPING is defined
// by the program.
#define SPHERICAL 0
#define PARABOLIC 1
#define ONE_DIMENSIONAL 2

// Views below the horizon are clamped to it: such vertices are visible only in triangles that cross the silhouette.
// `nodes`: the texture's size.
vec2 view_coordinates(vec3 view, vec2 nodes) {
    const float HALF_PI = 1.57079632679490;
#if VIEW_MAPPING == SPHERICAL
    float theta = min(atan(length(view.xy), view.z), HALF_PI);
    float phi = view.x == 0.0 && view.y == 0.0 ? 0.0 : atan(view.y, view.x);
    return vec2(phi / (4.0 * HALF_PI), theta / HALF_PI * (1.0 - 1.0 / nodes.y)) + 0.5 / nodes;
#elif VIEW_MAPPING == PARABOLIC
    vec2 p = view.xy / (1.0 + max(view.z, 0.0));
    return 0.5 + p * (0.5 - 0.5 / nodes);
#else
    return vec2(0.5 + view.x * (0.5 - 0.5 / nodes.x), 0.5);
#endif
}

// The view table of a material: bake/packed_texels.h. The program defines its TABLE_COLUMNS and TABLE_ROWS.

TEXTURE_UNIT(8) uniform sampler2DArray packed_table;
// Scale and bias of each layer of the table, one after the other.
STORAGE(5, TableRange, vec4, table_range);

vec2 table_coordinates(vec3 view) { return view_coordinates(view, vec2(TABLE_COLUMNS, TABLE_ROWS)); }

vec4 table_entries(vec2 coordinates, int layer) {
    vec4 stored = textureLod(packed_table, vec3(coordinates, layer), 0.0);
    return stored * STORED_VEC4(table_range, 2 * layer) + STORED_VEC4(table_range, 2 * layer + 1);
}
