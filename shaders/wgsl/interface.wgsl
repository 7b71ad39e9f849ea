// Draws the triangles of the interface: places in points, colours sRGB times their opacity.

struct InterfaceUniforms {
    // Size of the picture, points.
    size: vec2<f32>,
}

@group(0) @binding(0) var<uniform> interface_view: InterfaceUniforms;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var filtered: sampler;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>,
    @location(1) colour: vec4<f32>,
}

@vertex
fn vertex(@location(0) at: vec2<f32>, @location(1) place: vec2<f32>, @location(2) colour: vec4<f32>) -> Corner {
    let share = at / interface_view.size;
    return Corner(vec4(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y, 0.0, 1.0), place, colour);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let encoded = corner.colour * textureSample(picture, filtered, corner.place);
    if (ENCODE) {
        return encoded;
    }
    return vec4(linear_of(encoded.rgb), encoded.a);
}
