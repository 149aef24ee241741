// needs: frame varyings
// Counts the interfaces of each pixel: the depth complexity of the view.

@group(0) @binding(12) var<storage, read_write> slot_counts: array<atomic<u32>>;

fn store_interface(v: Varyings) -> vec4f {
    let pixel = vec2u(v.clip.xy);
    atomicAdd(&slot_counts[pixel.y * u32(frame.resolution_px.x) + pixel.x], 1u);
    return vec4f(0.0);
}
