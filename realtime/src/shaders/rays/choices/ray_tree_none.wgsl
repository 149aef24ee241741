// needs: ray_crossings ray_spot
// No body has triangles. The twin of ray_tree.wgsl.

fn meet_triangles() {}

fn spot_on_triangle(hit: Hit) -> Spot {
    return Spot(line.origin_lc, vec3f(0.0), -line.d_ws, -line.d_ws, vec2f(0.0));
}
