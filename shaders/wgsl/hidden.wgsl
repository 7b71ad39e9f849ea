// Parts of a picture that no lens of a headset shows: nearer than all else, and black.

// Middle of the picture's tangents, and half of their extent.
@group(0) @binding(0) var<uniform> picture: vec4<f32>;

@vertex
fn vertex(@location(0) tangents: vec2<f32>) -> @builtin(position) vec4<f32> {
    return vec4((tangents - picture.xy) / picture.zw, 1.0, 1.0);
}

@fragment
fn fragment() -> @location(0) vec4<f32> {
    return vec4(0.0);
}
