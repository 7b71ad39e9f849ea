// Value of a table that is coarser than the picture, mixed from its four nearest. `share`: part of the picture's size.
fn mixed_at(table: texture_2d<f32>, share: vec2<f32>) -> vec4<f32> {
    let size = vec2<f32>(textureDimensions(table));
    let scaled = clamp(share * size - 0.5, vec2(0.0), size - 1.0);
    let first = vec2<i32>(scaled);
    let last = min(first + 1, vec2<i32>(size) - 1);
    let between = fract(scaled);
    let above = mix(textureLoad(table, first, 0), textureLoad(table, vec2(last.x, first.y), 0), between.x);
    let below = mix(textureLoad(table, vec2(first.x, last.y), 0), textureLoad(table, last, 0), between.x);
    return mix(above, below, between.y);
}

