// Encodes linear light for a screen.

@group(0) @binding(0) var linear: texture_2d<f32>;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let light = clamp(textureLoad(linear, vec2<i32>(at.xy), 0).rgb, vec3(0.0), vec3(1.0));
    if (ENCODE) {
        return vec4(srgb(light), 1.0);
    }
    return vec4(light, 1.0);
}
