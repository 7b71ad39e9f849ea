// Enlarges a finished picture to the size of its window.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;
@group(0) @binding(2) var<uniform> screen: vec4<f32>;

// `screen.xy`: reciprocals of the window's width and height, pixels.
@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    return textureSampleLevel(picture, picture_sampler, at.xy * screen.xy, 0.0);
}
