// From linear radiance to a pixel: the weighted sum over samples, then the sRGB curve (IEC 61966-2-1).

struct Resolve {
    weight: f32,
    encode: f32,
    padding: vec2<f32>,
}

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var sum_so_far: texture_2d<f32>;
@group(0) @binding(2) var<uniform> resolve: Resolve;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(vec2(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

// Adds one sample to the sum of those before it.
@fragment
fn accumulate(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    return textureLoad(sum_so_far, pixel, 0) + resolve.weight * textureLoad(radiance, pixel, 0);
}

fn srgb(linear: vec3<f32>) -> vec3<f32> {
    let clamped = clamp(linear, vec3(0.0), vec3(1.0));
    let curve = 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * clamped, clamped <= vec3(0.0031308));
}

// The screen's value.
@fragment
fn display(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let linear = textureLoad(radiance, vec2<i32>(at.xy), 0).rgb;
    return vec4(select(linear, srgb(linear), resolve.encode == 1.0), 1.0);
}
