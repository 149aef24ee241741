// needs: ray_spot ray_crossings
// Light bends at the surface's own normal. The twin of ray_normals_smooth.wgsl.

const MAY_TRAP: bool = false;

fn shaded(spot: Spot, hit: Hit) -> Spot {
    return spot;
}
