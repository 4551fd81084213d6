// The table of modules/thin_film/bake/film_table.h: the layers of the first column of M, then of the second and the
// third. FILM_LINE: one thickness and one roughness, layers end to end. FILM_PLANE: one roughness, layers one upon
// another. Else: a volume.
#if defined(FILM_LINE)
TEXTURE_UNIT(8) uniform SAMPLER_LINE film_table;
#elif defined(FILM_PLANE)
TEXTURE_UNIT(8) uniform sampler2D film_table;
#else
TEXTURE_UNIT(8) uniform sampler3D film_table;
#endif
uniform vec4 film_path;  // x: n^2 - 1 of the outermost layer; y, z: scale and bias from the logarithm of the path
                         // difference to rows; w: the last layer
uniform vec4 film_axes;  // x, y: scale and bias from the root of the cosine to columns; z: from the mirror's layer to the rough
                         // one, in a volume layers per unit of roughness; w: from one column of M to the next, in a
                         // volume a slice's width

// Of a lobe the row is that of its mean square cosine.
float film_row(float cosine, float thickness_nm, float roughness) {
    float spread = 1.0 + 3.1 * roughness * roughness * roughness;
    float path_nm = 2.0 * thickness_nm * sqrt(film_path.x + 0.72 + (cosine * cosine - 0.72) / spread);
    return log2(path_nm + 250.0) * film_path.y + film_path.z;
}

// M: light in the working space to what a film reflects of it. The fourth row is what each component of white becomes.
mat3x4 film_matrix(float cosine, float thickness_nm, float roughness) {
    float column = sqrt(cosine + 0.02) * film_axes.x + film_axes.y;
#if defined(FILM_LINE)
    float at = column + (roughness > 0.0 ? film_axes.z : 0.0);
    return mat3x4(LINE_LOD(film_table, at, 0.0), LINE_LOD(film_table, at + film_axes.w, 0.0),
                  LINE_LOD(film_table, at + 2.0 * film_axes.w, 0.0));
#elif defined(FILM_PLANE)
    float row = film_row(cosine, thickness_nm, roughness) + (roughness > 0.0 ? film_axes.z : 0.0);
    return mat3x4(textureLod(film_table, vec2(column, row), 0.0), textureLod(film_table, vec2(column, row + film_axes.w), 0.0),
                  textureLod(film_table, vec2(column, row + 2.0 * film_axes.w), 0.0));
#else
    float layer = min(roughness * film_axes.z, film_path.w) + 0.5;
    vec3 at = vec3(column, film_row(cosine, thickness_nm, roughness), layer * film_axes.w);
    const vec3 next = vec3(0.0, 0.0, 1.0 / 3.0);
    return mat3x4(textureLod(film_table, at, 0.0), textureLod(film_table, at + next, 0.0),
                  textureLod(film_table, at + 2.0 * next, 0.0));
#endif
}
