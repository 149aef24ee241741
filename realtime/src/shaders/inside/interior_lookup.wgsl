// needs: frame
// The images of the inside may be coarser than the frame.

fn of_inside(image: texture_2d<f32>, pixel: vec2i) -> vec4f {
    let size = vec2f(textureDimensions(image));
    let at = (vec2f(pixel) + 0.5) / frame.resolution_px * size - 0.5;
    let low = floor(at);
    let f = at - low;
    let most = vec2i(size) - 1;
    let i = clamp(vec2i(low), vec2i(0), most);
    let j = clamp(vec2i(low) + 1, vec2i(0), most);
    let top = mix(textureLoad(image, i, 0), textureLoad(image, vec2i(j.x, i.y), 0), f.x);
    let bottom = mix(textureLoad(image, vec2i(i.x, j.y), 0), textureLoad(image, j, 0), f.x);
    return mix(top, bottom, f.y);
}
