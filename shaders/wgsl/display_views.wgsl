// Turns the radiance of two views into the two layers of their target, in one pass.

@group(0) @binding(0) var first: texture_2d<f32>;
@group(0) @binding(3) var<uniform> of_first: PlacementUniforms;
@group(0) @binding(4) var second: texture_2d<f32>;
@group(0) @binding(5) var<uniform> of_second: PlacementUniforms;

@fragment
fn fragment(@builtin(position) at: vec4<f32>, @builtin(view_index) view: u32) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    var linear: vec3<f32>;
    if (view == 0u) {
        linear = developed(textureLoad(first, pixel, 0), of_first.exposure);
    } else {
        linear = developed(textureLoad(second, pixel, 0), of_second.exposure);
    }
    if (ENCODE) {
        return vec4(srgb(linear), 1.0);
    }
    return vec4(linear, 1.0);
}
