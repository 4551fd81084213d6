// The table of modules/thin_film/bake/film_table.h: three stacks of layers, one for each column of M. With FILM_LINE, of
// one thickness and one roughness: the mirror's row, then the lobe's, of each column, one after another.
#ifdef FILM_LINE
TEXTURE_UNIT(8) uniform SAMPLER_LINE film_table;
#else
TEXTURE_UNIT(8) uniform sampler3D film_table;
#endif
uniform vec4 film_path;  // x: n^2 - 1 of the outermost layer; y, z: scale and bias from the path difference in nm to rows;
                         // w: the last layer
uniform vec4 film_axes;  // x, y: scale and bias from sqrt(cosine) to columns; z: layers per unit of roughness, with
                         // FILM_LINE from one row to the next; w: a slice's width, with FILM_LINE from one column of M
                         // to the next

// Light in the working space to what a film reflects of it.
#ifdef FILM_LINE
mat3 film_matrix(float cosine, float thickness_nm, float roughness) {
    float at = sqrt(cosine) * film_axes.x + film_axes.y + (roughness > 0.0 ? film_axes.z : 0.0);
    return mat3(LINE_LOD(film_table, at, 0.0).rgb, LINE_LOD(film_table, at + film_axes.w, 0.0).rgb,
                LINE_LOD(film_table, at + 2.0 * film_axes.w, 0.0).rgb);
}
#else
mat3 film_matrix(float cosine, float thickness_nm, float roughness) {
    float path_nm = 2.0 * thickness_nm * sqrt(film_path.x + cosine * cosine);
    float layer = min(roughness * film_axes.z, film_path.w) + 0.5;
    vec3 at = vec3(sqrt(cosine) * film_axes.x + film_axes.y, path_nm * film_path.y + film_path.z, layer * film_axes.w);
    const vec3 next = vec3(0.0, 0.0, 1.0 / 3.0);
    return mat3(textureLod(film_table, at, 0.0).rgb, textureLod(film_table, at + next, 0.0).rgb,
                textureLod(film_table, at + 2.0 * next, 0.0).rgb);
}
#endif
