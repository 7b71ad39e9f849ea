// Adds one sample to the sum of the samples before it.

struct AccumulateUniforms {
    weight: f32,
}

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var sum_so_far: texture_2d<f32>;
@group(0) @binding(2) var<uniform> accumulate: AccumulateUniforms;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    return textureLoad(sum_so_far, pixel, 0) + accumulate.weight * textureLoad(radiance, pixel, 0);
}
