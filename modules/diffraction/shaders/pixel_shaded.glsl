// The end of fragment stages that shade pixels. Before it, the program defines
//   vec3 diffracted_radiance(GrooveView view);
// in the working space, of a view above the horizon.
MaterialTerms material_terms() {
    GrooveView view = groove_view();
    vec3 sum = lights_from_vertices();
    if (view.direction.z > 0.0 && view.pitch > 0.0) sum += diffracted_radiance(view) + key_lights_at_pixel(view);
    prepare_lights(view);
    return surface_terms(sum);
}
