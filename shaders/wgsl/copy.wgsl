// Copies a texture into another format.

@group(0) @binding(0) var radiance: texture_2d<f32>;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(radiance, vec2<i32>(at.xy), 0);
}
